// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "toile/transfer/transfer.h"

namespace toile {

std::string writeTransferReport(const Transfer& transfer) {
  nlohmann::ordered_json json = {{"format", "toile-transfer"}, {"version", 1}};
  json["model"] = transfer.document.model->reference;
  json["curves"] = nlohmann::ordered_json::array();
  for (const TransferredCurve& curve : transfer.curves) {
    json["curves"].push_back({{"id", curve.id},
                              {"fairing", toString(curve.fairing)},
                              {"lengthBeforeMm", curve.lengthBefore.mm()},
                              {"lengthCarriedMm", curve.lengthCarried.mm()},
                              {"lengthAfterMm", curve.lengthAfter.mm()},
                              {"bends",
                               {{"before", curve.bendsBefore},
                                {"carried", curve.bendsCarried},
                                {"after", curve.bendsAfter}}},
                              {"variationPerMm",
                               {{"before", curve.variationBefore},
                                {"carried", curve.variationCarried},
                                {"after", curve.variationAfter}}},
                              {"deviationMm", curve.deviation.mm()}});
  }
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : transfer.findings) {
    json["findings"].push_back({{"code", finding.code}, {"message", finding.message}});
  }
  return json.dump(2) + "\n";
}

}  // namespace toile

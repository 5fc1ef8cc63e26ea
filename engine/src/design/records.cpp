// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "toile/design/design.h"

namespace toile {

const PieceRecord* recordOf(const Design& design, const std::string& id) {
  const auto found = std::find_if(design.pieces.begin(), design.pieces.end(),
                                  [&](const PieceRecord& record) { return record.id == id; });
  return found == design.pieces.end() ? nullptr : &*found;
}

const Fabric* fabricOf(const Design& design, const PieceRecord* record) {
  for (const Fabric& fabric : design.fabrics) {
    if (record == nullptr || record->fabric.empty() || fabric.id == record->fabric) return &fabric;
  }
  return nullptr;
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/piece_edits.h"

#include <algorithm>
#include <cctype>

#include "toile/cut/records.h"

namespace toile::studio {

std::string makePieceId(const std::string& name, const Design& design) {
  std::string id;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      id += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!id.empty() && id.back() != '-') {
      id += '-';
    }
  }
  while (!id.empty() && id.back() == '-') id.pop_back();
  if (id.empty()) id = "part";
  const std::string wanted = id;
  for (int n = 2; recordOf(design, id) != nullptr; ++n) id = wanted + "-" + std::to_string(n);
  return id;
}

std::optional<Document> withPieceRecord(const Document& document, const Pattern& pattern,
                                        const std::string& piece,
                                        const std::function<void(PieceRecord&)>& change) {
  const auto cut =
      std::ranges::find_if(pattern.cut.pieces, [&](const Piece& p) { return p.id == piece; });
  Design design = *document.design;
  const auto known = std::ranges::find_if(
      design.pieces, [&](const PieceRecord& record) { return record.id == piece; });
  if (known != design.pieces.end()) {
    change(*known);
  } else {
    if (cut == pattern.cut.pieces.end()) return std::nullopt;
    PieceRecord record;
    record.anchor = toModelPoint(*document.model->mesh, inmostPoint(*cut, *document.model->mesh));
    record.include = cut->include;
    change(record);
    record.id = makePieceId(record.name.empty() ? piece : record.name, design);
    design.pieces.push_back(std::move(record));
  }
  return Document{std::make_shared<const Design>(std::move(design)), document.model};
}

std::optional<Document> withCurve(const Document& document, const std::string& curve,
                                  const std::function<void(StylingCurve&)>& change) {
  Design design = *document.design;
  const auto found =
      std::ranges::find_if(design.curves, [&](const StylingCurve& c) { return c.id == curve; });
  if (found == design.curves.end()) return std::nullopt;
  change(*found);
  return Document{std::make_shared<const Design>(std::move(design)), document.model};
}

}  // namespace toile::studio

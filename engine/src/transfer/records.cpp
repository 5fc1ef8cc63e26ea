// SPDX-License-Identifier: GPL-3.0-or-later
#include "transfer/records.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "toile/cut/records.h"

namespace toile::detail {

namespace {

using Cycles = std::vector<std::vector<std::string>>;

void finishLoop(std::vector<std::string>& loop, Cycles& cycles) {
  if (loop.empty()) return;
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  // The least of its rotations.
  std::vector<std::string> least = loop;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    least = std::min(least, loop);
  }
  cycles.push_back(std::move(least));
  loop.clear();
}

const Piece* pieceOf(const CutResult& cut, int record) {
  for (const Piece& piece : cut.pieces) {
    const auto& held = piece.recordIndices;
    if (std::find(held.begin(), held.end(), record) != held.end()) return &piece;
  }
  return nullptr;
}

std::set<std::string> idsOf(const Cycles& cycles) {
  std::set<std::string> ids;
  for (const auto& loop : cycles) ids.insert(loop.begin(), loop.end());
  return ids;
}

std::string describe(const Cycles& cycles) {
  std::string text;
  for (const auto& loop : cycles) {
    text += (text.empty() ? "" : "; ") + fmt::format("{}", fmt::join(loop, ", "));
  }
  return text.empty() ? "nothing" : text;
}

}  // namespace

Cycles boundingCycles(const Piece& piece) {
  Cycles cycles;
  std::vector<std::string> loop;
  const Wire* last = nullptr;
  VertexId first;
  for (const Wire& wire : piece.wires) {
    if (!isBoundary(wire.kind)) break;
    if (last == nullptr || last->vertices.back() != wire.vertices.front() ||
        last->vertices.back() == first) {
      finishLoop(loop, cycles);
      first = wire.vertices.front();
    }
    if (loop.empty() || loop.back() != wire.curve) loop.push_back(wire.curve);
    last = &wire;
  }
  finishLoop(loop, cycles);
  std::sort(cycles.begin(), cycles.end());
  return cycles;
}

std::set<std::string> checkRecords(Design& design, const Design& before, const CutResult& cutBefore,
                                   const CutResult& cutAfter, const Mesh& target,
                                   std::vector<Finding>& findings) {
  std::set<std::string> tangled;
  std::vector<Cycles> after;
  for (const Piece& piece : cutAfter.pieces) after.push_back(boundingCycles(piece));
  for (std::size_t r = 0; r < design.pieces.size(); ++r) {
    PieceRecord& record = design.pieces[r];
    const Piece* was = pieceOf(cutBefore, static_cast<int>(r));
    const Piece* is = pieceOf(cutAfter, static_cast<int>(r));
    if (was == nullptr) continue;
    const Cycles wanted = boundingCycles(*was);
    if (is != nullptr && boundingCycles(*is) == wanted) continue;
    std::vector<std::size_t> alike;
    for (std::size_t p = 0; p < after.size(); ++p) {
      if (after[p] == wanted) alike.push_back(p);
    }
    const std::string name = before.pieces[r].name.empty() ? record.id : before.pieces[r].name;
    if (alike.size() == 1) {
      record.anchor = toModelPoint(target, inmostPoint(cutAfter.pieces[alike[0]], target));
      findings.push_back({"piece-moved",
                          fmt::format("piece \"{}\": its anchor came to lie beside its region and "
                                      "was put in the middle of it",
                                      name),
                          {Element::piece(record.id)}});
      continue;
    }
    const std::set<std::string> known = idsOf(wanted);
    const std::set<std::string> now = is == nullptr ? known : idsOf(boundingCycles(*is));
    std::set_difference(now.begin(), now.end(), known.begin(), known.end(),
                        std::inserter(tangled, tangled.end()));
    if (is == nullptr || tangled.empty()) tangled.insert(known.begin(), known.end());
    findings.push_back(
        {"piece-bounded-otherwise",
         fmt::format("piece \"{}\" is bounded by {} on this model, by {} on its own; look at where "
                     "these lines meet",
                     name, is == nullptr ? "nothing" : describe(boundingCycles(*is)),
                     describe(wanted)),
         {Element::piece(record.id)}});
  }
  return tangled;
}

}  // namespace toile::detail

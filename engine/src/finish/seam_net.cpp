// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/seam_net.h"

#include <map>
#include <numeric>
#include <utility>

namespace toile {
namespace {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

SeamNet::SeamNet(const std::vector<PieceInWork>& pieces, const CutResult& cut) : pieces_(pieces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, RunId> runOfWire;
  for (std::uint32_t p = 0; p < pieces.size(); ++p) {
    offset_.push_back(runs_.size());
    const std::vector<OutlineRun>& runs = pieces[p].sew.runs;
    for (std::uint32_t r = 0; r < runs.size(); ++r) {
      runs_.push_back({p, r});
      runOfWire[{pieces[p].index, runs[r].wire}] = {p, r};
    }
  }
  const std::size_t count = runs_.size();
  next_.resize(count);
  previous_.resize(count);
  for (std::uint32_t p = 0; p < pieces.size(); ++p) {
    const std::vector<OutlineRun>& runs = pieces[p].sew.runs;
    for (std::uint32_t r = 0; r < runs.size();) {
      std::uint32_t end = r;
      while (end < runs.size() && runs[end].loop == runs[r].loop) ++end;
      for (std::uint32_t k = r; k < end; ++k) {
        const std::uint32_t after = k + 1 < end ? k + 1 : r;
        next_[flat({p, k})] = after;
        previous_[flat({p, after})] = k;
      }
      r = end;
    }
  }

  mate_.resize(count);
  const auto join = [&](std::uint32_t piece, std::uint32_t wire, std::uint32_t otherPiece,
                        std::uint32_t otherWire) {
    const auto here = runOfWire.find({piece, wire});
    const auto there = runOfWire.find({otherPiece, otherWire});
    if (here != runOfWire.end() && there != runOfWire.end())
      mate_[flat(here->second)] = there->second;
  };
  for (const SeamMates& mates : cut.mates) {
    join(mates.pieceA, mates.wireA, mates.pieceB, mates.wireB);
    join(mates.pieceB, mates.wireB, mates.pieceA, mates.wireA);
  }

  DisjointSets nodes(count);
  DisjointSets seams(count);
  for (const RunId id : runs_) {
    if (const auto other = mate_[flat(id)]) {
      // Mates run in opposite directions: each begins where the other ends.
      nodes.unite(flat(id), flat(next(*other)));
      nodes.unite(flat(next(id)), flat(*other));
      seams.unite(flat(id), flat(*other));
    }
    if (continues(id)) seams.unite(flat(id), flat(previous(id)));
  }
  node_.resize(count);
  seam_.resize(count, 0);
  std::map<std::size_t, int> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    node_[i] = nodes.find(i);
    if (!mate_[i]) continue;
    seam_[i] = numbers.emplace(seams.find(i), static_cast<int>(numbers.size()) + 1).first->second;
  }
}

const OutlineRun& SeamNet::at(RunId id) const {
  return pieces_[id.piece].sew.runs[id.run];
}

std::optional<RunId> SeamNet::mate(RunId id) const {
  return mate_[flat(id)];
}

RunId SeamNet::next(RunId id) const {
  return {id.piece, next_[flat(id)]};
}

RunId SeamNet::previous(RunId id) const {
  return {id.piece, previous_[flat(id)]};
}

bool SeamNet::beginsAtCorner(RunId id) const {
  const OutlineRun& run = at(id);
  return pieces_[id.piece].sew.loops[run.loop][run.first].corner;
}

std::size_t SeamNet::node(RunId id) const {
  return node_[flat(id)];
}

int SeamNet::seam(RunId id) const {
  return seam_[flat(id)];
}

bool SeamNet::continues(RunId id) const {
  const RunId before = previous(id);
  if (before == id || beginsAtCorner(id) || at(id).curve != at(before).curve) return false;
  const auto mateHere = mate(id);
  const auto mateBefore = mate(before);
  return mateHere && mateBefore && mateHere->piece == mateBefore->piece &&
         next(*mateHere) == *mateBefore && !beginsAtCorner(*mateBefore);
}

std::vector<RunId> SeamNet::chain(RunId id) const {
  RunId first = id;
  while (continues(first) && previous(first) != id) first = previous(first);
  std::vector<RunId> runs{first};
  for (RunId r = next(first); r != first && continues(r); r = next(r)) runs.push_back(r);
  return runs;
}

}  // namespace toile

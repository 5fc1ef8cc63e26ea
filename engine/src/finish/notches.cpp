// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/notches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "finish/polygon.h"
#include "toile/design/finish_limits.h"

namespace toile {
namespace {

constexpr double kFromCornerMm = 15;      ///< a notch nearer to a corner would be ambiguous
constexpr double kJunctionCornerMm = 8;   ///< the same for notches that lines dictate
constexpr double kNotchGapMm = 10;        ///< between two notches of different meaning
constexpr double kDoubleGapMm = 8;        ///< between the two of a double notch
constexpr double kSidestepMm = 6;         ///< to get away from a corner or another notch
constexpr double kShortestSeamMm = 80;    ///< shorter ones match by their ends
constexpr double kLeastAsymmetryMm = 12;  ///< by which a seam turned round must miss
constexpr double kNormalChordMm = 1.5;    ///< either way, to take the normal of a dense line
constexpr double kBackNormal = 0.35;      ///< mean normal.y above which a seam is of the back

/// Arc lengths along a loop.
struct LoopMeasure {
  const Outline* loop = nullptr;
  std::vector<double> along;  ///< per point
  double total = 0;

  explicit LoopMeasure(const Outline& outline) : loop(&outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      along.push_back(total);
      total += (outline[(i + 1) % outline.size()].position - outline[i].position).norm();
    }
  }
  [[nodiscard]] Eigen::Vector2d at(double s) const {
    s = std::fmod(s, total);
    if (s < 0) s += total;
    const auto after = std::upper_bound(along.begin(), along.end(), s);
    const std::size_t i = static_cast<std::size_t>(after - along.begin()) - 1;
    const double end = i + 1 < along.size() ? along[i + 1] : total;
    const double t = end > along[i] ? (s - along[i]) / (end - along[i]) : 0;
    const Eigen::Vector2d& a = (*loop)[i].position;
    return a + t * ((*loop)[(i + 1) % loop->size()].position - a);
  }
  /// Unit normal to the outside, of the chord from s - before to s + after.
  [[nodiscard]] Eigen::Vector2d outward(double s, double before, double after) const {
    const Eigen::Vector2d d = at(s + after) - at(s - before);
    return d.norm() > 0 ? Eigen::Vector2d(d.y(), -d.x()).normalized() : Eigen::Vector2d(0, 1);
  }
  /// Along the loop to its nearest corner.
  [[nodiscard]] double toCorner(double s) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < loop->size(); ++i) {
      if (!(*loop)[i].corner) continue;
      const double d = std::abs(s - along[i]);
      nearest = std::min({nearest, d, std::abs(total - d)});
    }
    return nearest;
  }
};

/// A place on the outline of a piece in work.
struct SewPlace {
  RunId run;
  double along = 0;  ///< arc length on the run's loop
};

class NotchChooser {
 public:
  NotchChooser(const SeamNet& net, double spacing)
      : net_(net), spacing_(std::clamp(spacing, kLeastNotchSpacing.mm(), kMostNotchSpacing.mm())) {
    for (const PieceInWork& piece : net.pieces()) {
      measures_.emplace_back();
      for (const Outline& loop : piece.sew.loops) measures_.back().emplace_back(loop);
    }
    used_.resize(net.pieces().size());
  }

  std::vector<SewNotch> choose() {
    chooseAtJunctions();
    chooseAtFeatureEnds();
    chooseAlongSeams();
    return std::move(notches_);
  }

 private:
  [[nodiscard]] const LoopMeasure& measure(RunId id) const {
    return measures_[id.piece][net_.at(id).loop];
  }
  [[nodiscard]] double start(RunId id) const { return measure(id).along[net_.at(id).first]; }
  [[nodiscard]] bool isDartMouth(RunId id) const {
    return (net_.at(id).kind == WireKind::Dart) !=
               (net_.at(net_.previous(id)).kind == WireKind::Dart) &&
           net_.beginsAtCorner(id);
  }

  [[nodiscard]] bool isFree(const SewPlace& place) const {
    const std::size_t loop = net_.at(place.run).loop;
    const double total = measure(place.run).total;
    const auto& used = used_[place.run.piece];
    return std::none_of(used.begin(), used.end(), [&](const auto& other) {
      const double d = std::abs(other.second - place.along);
      return other.first == loop && std::min(d, std::abs(total - d)) < kNotchGapMm;
    });
  }

  /// `before`, `after`: of the chord for the normal; one of them 0 beside a corner.
  /// The mouth of a folded dart: the notch stands where its leg, prolonged, meets the cut line.
  void addAtLeg(RunId owner, RunId leg, double along, double back, int number) {
    const LoopMeasure& loop = measure(leg);
    const Eigen::Vector2d mouth = loop.at(along);
    const Eigen::Vector2d out = mouth - loop.at(along + back);
    const OutlineRun& run = net_.at(owner);
    notches_.push_back({owner.piece, mouth, out.normalized(), run.allowance, run.curve, number});
    used_[owner.piece].emplace_back(run.loop, along);
  }

  void add(const SewPlace& place, int number, double before = kNormalChordMm,
           double after = kNormalChordMm) {
    const OutlineRun& run = net_.at(place.run);
    const LoopMeasure& loop = measure(place.run);
    notches_.push_back({place.run.piece, loop.at(place.along),
                        loop.outward(place.along, before, after), run.allowance, run.curve,
                        number});
    used_[place.run.piece].emplace_back(run.loop, place.along);
  }

  void chooseAtJunctions() {
    std::map<std::size_t, std::vector<RunId>> members;  // by node: runs that begin there
    std::vector<std::size_t> order;
    for (const RunId id : net_.runs()) {
      if (net_.next(id) == id) continue;  // a closed line has no end
      if (net_.beginsAtCorner(id) && !isDartMouth(id)) continue;
      std::vector<RunId>& list = members[net_.node(id)];
      if (list.empty()) order.push_back(net_.node(id));
      list.push_back(id);
    }
    for (const std::size_t node : order) {
      const std::vector<RunId>& list = members[node];
      const bool fits = std::all_of(list.begin(), list.end(), [&](RunId id) {
        return isFree({id, start(id)}) &&
               (isDartMouth(id) || measure(id).toCorner(start(id)) >= kJunctionCornerMm);
      });
      if (!fits) continue;
      const int number = list.size() > 1 ? ++lastNumber_ : 0;
      for (const RunId id : list) {
        const RunId before = net_.previous(id);
        if (!isDartMouth(id)) {
          add({id, start(id)}, number);
        } else if (net_.at(id).folded) {
          addAtLeg(before, id, start(id), kNormalChordMm, number);
        } else if (net_.at(before).folded) {
          addAtLeg(id, before, start(id), -kNormalChordMm, number);
        } else if (net_.at(id).kind == WireKind::Dart) {
          // The dart begins here: the notch belongs to the run that ends here.
          add({net_.previous(id), start(id)}, number, kNormalChordMm, 0);
        } else {
          add({id, start(id)}, number, 0, kNormalChordMm);
        }
      }
    }
  }

  /// Where feature and elastic lines reach the outline within a run.
  void chooseAtFeatureEnds() {
    std::vector<std::set<VertexId>> ends;
    for (const PieceInWork& work : net_.pieces()) {
      ends.emplace_back();
      for (const Wire& wire : work.piece->wires) {
        if (isBoundary(wire.kind) || wire.vertices.size() < 2) continue;
        ends.back().insert(wire.vertices.front());
        ends.back().insert(wire.vertices.back());
      }
    }
    for (const RunId id : net_.runs()) {
      const OutlineRun& run = net_.at(id);
      const std::vector<VertexId>& vertices =
          net_.pieces()[id.piece].piece->wires[run.wire].vertices;
      for (std::size_t k = 1; k < run.edgeCount; ++k) {
        if (!ends[id.piece].contains(vertices[k])) continue;
        const double local = measure(id).along[run.first + k] - start(id);
        const std::vector<SewPlace> places = bothSides({{id}, {run.length}}, local);
        // The mate's own end of the line comes later and finds the place taken.
        const bool fits = std::all_of(places.begin(), places.end(), [&](const SewPlace& place) {
          return isFree(place) && measure(place.run).toCorner(place.along) >= kJunctionCornerMm;
        });
        if (!fits) continue;
        const int number = places.size() > 1 ? ++lastNumber_ : 0;
        for (const SewPlace& place : places) add(place, number);
      }
    }
  }

  /// Height, then nearness to the front, then to the middle: the end that notches count from is
  /// the same one on the left and on the right of the body.
  [[nodiscard]] bool beginsAtItsUpperEnd(const std::vector<RunId>& chain) const {
    const Piece& piece = *net_.pieces()[chain.front().piece].piece;
    const auto place = [&](VertexId v) { return piece.mesh->position(v); };
    const Eigen::Vector3d a = place(piece.wires[net_.at(chain.front()).wire].vertices.front());
    const Eigen::Vector3d b = place(piece.wires[net_.at(chain.back()).wire].vertices.back());
    constexpr double kEqualMm = 1;
    if (std::abs(a.z() - b.z()) > kEqualMm) return a.z() > b.z();
    if (std::abs(a.y() - b.y()) > kEqualMm) return a.y() < b.y();
    return std::abs(a.x()) <= std::abs(b.x());
  }

  /// Length-weighted mean of normal.y beside the run.
  [[nodiscard]] double backwardness(RunId id) const {
    const Piece& piece = *net_.pieces()[id.piece].piece;
    const Wire& wire = piece.wires[net_.at(id).wire];
    double sum = 0;
    double length = 0;
    for (std::size_t i = 0; i + 1 < wire.vertices.size(); ++i) {
      const EdgeId edge = piece.mesh->findEdge(wire.vertices[i], wire.vertices[i + 1]);
      if (!edge.isValid()) continue;
      const double l = piece.mesh->length(edge);
      sum += l * piece.mesh->normal(piece.mesh->face(piece.mesh->halfedge(edge))).y();
      length += l;
    }
    return length > 0 ? sum / length : 0;
  }

  struct Chain {
    std::vector<RunId> runs;
    std::vector<double> ends;  ///< cumulated flat lengths
    [[nodiscard]] double length() const { return ends.back(); }
  };

  /// Both sides of the point `s` of the chain.
  [[nodiscard]] std::vector<SewPlace> bothSides(const Chain& chain, double s) const {
    std::size_t k = 0;
    while (k + 1 < chain.runs.size() && s > chain.ends[k]) ++k;
    const double local = s - (k == 0 ? 0 : chain.ends[k - 1]);
    const RunId here = chain.runs[k];
    std::vector<SewPlace> places{{here, start(here) + local}};
    if (const auto there = net_.mate(here))
      places.push_back({*there, start(*there) + (net_.at(*there).length - local)});
    return places;
  }

  /// Lengths along the chain at which notches stand already, the ends included.
  [[nodiscard]] std::vector<double> takenAlong(const Chain& chain) const {
    constexpr double kSamePlaceMm = 1e-3;  // a notch at the end of one run begins the next
    std::vector<double> taken{0};
    for (std::size_t k = 0; k < chain.runs.size(); ++k) {
      const RunId run = chain.runs[k];
      const double before = k == 0 ? 0 : chain.ends[k - 1];
      for (const auto& [loop, along] : used_[run.piece]) {
        const double local = along - start(run);
        const bool isHere = loop == net_.at(run).loop && local > -kSamePlaceMm &&
                            local < net_.at(run).length - kSamePlaceMm;
        if (isHere && before + local > kSamePlaceMm) taken.push_back(before + local);
      }
    }
    taken.push_back(chain.length());
    std::sort(taken.begin(), taken.end());
    return taken;
  }

  /// Tries the place and, where a corner or another notch is near on either side, places beside;
  /// `away` is +1 or -1: the way from the upper end along the chain.
  void addPaired(const Chain& chain, double s, double away, bool isDouble) {
    for (int step = 0; step <= 10; ++step) {
      const int multiple = (step + 1) / 2;
      const double at = s + away * (step % 2 == 0 ? kSidestepMm : -kSidestepMm) * multiple;
      if (at < 0 || at > chain.length()) continue;
      const std::vector<SewPlace> places = bothSides(chain, at);
      const bool fits = std::all_of(places.begin(), places.end(), [&](const SewPlace& place) {
        return measure(place.run).toCorner(place.along) >= kFromCornerMm && isFree(place);
      });
      if (!fits) continue;
      ++lastNumber_;
      if (!isDouble) {
        for (const SewPlace& place : places) add(place, lastNumber_);
      } else {
        for (const double offset : {-0.5 * kDoubleGapMm, 0.5 * kDoubleGapMm})
          for (const SewPlace& place : bothSides(chain, at + offset)) add(place, lastNumber_);
      }
      return;
    }
  }

  void chooseAlongSeams() {
    std::set<int> done;
    for (const RunId id : net_.runs()) {
      const int seam = net_.seam(id);
      if (seam == 0 || net_.at(id).kind == WireKind::Dart || !done.insert(seam).second) continue;
      Chain chain;
      chain.runs = net_.chain(id);
      double length = 0;
      double back = 0;
      for (const RunId run : chain.runs) {
        chain.ends.push_back(length += net_.at(run).length);
        const auto other = net_.mate(run);
        back += net_.at(run).length * 0.5 *
                (backwardness(run) + (other ? backwardness(*other) : backwardness(run)));
      }
      if (length < kShortestSeamMm) continue;
      const bool isDouble = back / length > kBackNormal;
      const std::vector<double> taken = takenAlong(chain);
      const double away = beginsAtItsUpperEnd(chain.runs) ? 1 : -1;
      const bool isRing = chain.runs.size() == 1 && net_.next(id) == id;
      if (isRing) addPaired(chain, 0, away, isDouble);
      for (std::size_t g = 0; g + 1 < taken.size(); ++g) {
        const double gap = taken[g + 1] - taken[g];
        int count = static_cast<int>(std::lround(gap / spacing_)) - 1;
        if (taken.size() == 2) count = std::max(count, 1);
        count = std::min(count, 20);
        // Off the even division by enough that the seam turned round does not match.
        const double shift = std::max(0.5 * kLeastAsymmetryMm + 2, 0.1 * gap / (count + 1));
        for (int i = 0; i < count; ++i) {
          const double fromUpper = gap * (i + 1) / (count + 1) - shift;
          addPaired(chain, (away > 0 ? taken[g] : taken[g + 1]) + away * fromUpper, away, isDouble);
        }
      }
    }
  }

  const SeamNet& net_;
  double spacing_;
  int lastNumber_ = 0;
  std::vector<std::vector<LoopMeasure>> measures_;                 ///< per piece, per loop
  std::vector<std::vector<std::pair<std::size_t, double>>> used_;  ///< per piece: loop, along
  std::vector<SewNotch> notches_;
};

/// Where the ray from p along d first leaves through the lines.
struct Hit {
  std::size_t loop = 0, edge = 0;
  double onEdge = 0;
  double along = std::numeric_limits<double>::infinity();
};

Hit castRay(const std::vector<Outline>& lines, const Eigen::Vector2d& p, const Eigen::Vector2d& d) {
  // The start may lie on the line itself (no allowance), to either side of it by rounding.
  constexpr double kBehindMm = 0.05;
  Hit best;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const std::size_t count = lines[l].size();
    for (std::size_t e = 0; e < count; ++e) {
      const Eigen::Vector2d& a = lines[l][e].position;
      const Eigen::Vector2d edge = lines[l][(e + 1) % count].position - a;
      const double determinant = cross(d, edge);
      if (std::abs(determinant) < 1e-12) continue;
      const double along = cross(a - p, edge) / determinant;
      const double onEdge = cross(a - p, d) / determinant;
      if (onEdge < -1e-9 || onEdge > 1 + 1e-9 || along < -kBehindMm) continue;
      if (std::abs(along) < std::abs(best.along))
        best = {l, e, std::clamp(onEdge, 0.0, 1.0), along};
    }
  }
  return best;
}

}  // namespace

std::vector<SewNotch> chooseNotches(const SeamNet& net, double spacing) {
  return NotchChooser(net, spacing).choose();
}

std::vector<Notch> placeNotches(const std::vector<SewNotch>& chosen, std::uint32_t piece,
                                const Piece& record, const FinishSettings& finish,
                                std::vector<Outline>& cutLines, std::vector<Finding>& findings) {
  constexpr double kSnapMm = 0.05;       // nearer to a vertex, that vertex serves
  constexpr double kLeastDepthMm = 2;    // where there is no allowance to cut into
  constexpr double kFarthestFactor = 2;  // of the allowance; farther is another part of the line
  std::vector<Notch> notches;
  struct Insertion {
    std::size_t loop, edge;
    double onEdge;
    std::size_t notch;
  };
  std::vector<Insertion> insertions;
  for (const SewNotch& sew : chosen) {
    if (sew.piece != piece) continue;
    const Hit hit = castRay(cutLines, sew.position, sew.outward);
    if (hit.along > kFarthestFactor * sew.allowance + 1) {
      findings.push_back(
          {"notch-left-out",
           fmt::format("piece \"{}\": a notch on {} has no place on the cut line; mark it by hand",
                       record.name, sew.seam),
           {Element::piece(record.id), Element::curve(sew.seam)}});
      continue;
    }
    Notch notch;
    const Outline& loop = cutLines[hit.loop];
    const Eigen::Vector2d& a = loop[hit.edge].position;
    const Eigen::Vector2d& b = loop[(hit.edge + 1) % loop.size()].position;
    notch.position = a + hit.onEdge * (b - a);
    notch.onSewLine = sew.position;
    notch.direction = -sew.outward;
    // Less than half the allowance, so that sewing hides it.
    notch.depth =
        std::min(finish.notchDepth.mm(), sew.allowance > 0 ? 0.5 * sew.allowance : kLeastDepthMm);
    notch.kind = finish.notchKind;
    if (notch.kind != NotchKind::Slit) notch.width = finish.notchWidth.mm();
    notch.seam = sew.seam;
    notch.number = sew.number;
    if ((notch.position - a).norm() < kSnapMm) {
      notch.position = a;
    } else if ((notch.position - b).norm() < kSnapMm) {
      notch.position = b;
    } else {
      insertions.push_back({hit.loop, hit.edge, hit.onEdge, notches.size()});
    }
    notches.push_back(notch);
  }
  // From the end, so that the indices before stay right.
  std::sort(insertions.begin(), insertions.end(), [](const Insertion& x, const Insertion& y) {
    return std::tie(x.loop, x.edge, x.onEdge, x.notch) >
           std::tie(y.loop, y.edge, y.onEdge, y.notch);
  });
  for (const Insertion& in : insertions) {
    Outline& loop = cutLines[in.loop];
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(in.edge) + 1,
                {notches[in.notch].position, false});
  }
  return notches;
}

}  // namespace toile

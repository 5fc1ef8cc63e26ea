// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/transfer/transfer.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "support/meshes.h"
#include "support/sample_designs.h"
#include "support/test_data.h"
#include "toile/model/guiding_map.h"
#include "toile/shape/builtin.h"
#include "transfer/records.h"

namespace toile {
namespace {

using test::exampleDesign;

std::shared_ptr<const ReferenceModel> builtin(const std::string& reference) {
  Result<ReferenceModel> model = makeBuiltinModel(reference);
  EXPECT_TRUE(model) << model.error();
  return std::make_shared<const ReferenceModel>(*std::move(model));
}

Document wetsuit() {
  Result<Document> document = openDocument(exampleDesign("wetsuit-full.toile"));
  EXPECT_TRUE(document) << document.error();
  return *document;
}

Transfer carried(const Document& document, const std::shared_ptr<const ReferenceModel>& target,
                 const TransferOptions& options = {}) {
  const auto map = Correspondence::onOneConnectivity(document.model->index, target->index);
  EXPECT_TRUE(map) << map.error();
  Result<Transfer> transfer = transferDesign(document, target, *map, options);
  EXPECT_TRUE(transfer) << transfer.error();
  return *std::move(transfer);
}

double farthestPoint(const Document& a, const Document& b) {
  const auto left = placeCurves(*a.design, *a.model), right = placeCurves(*b.design, *b.model);
  EXPECT_TRUE(left) << left.error();
  EXPECT_TRUE(right) << right.error();
  double farthest = 0;
  for (std::size_t c = 0; c < left->size(); ++c) {
    for (int i = 0; i <= 50; ++i) {
      const auto at = [&](const Document& d, const PlacedCurve& curve) {
        return position(*d.model->mesh, pointAtFraction(*d.model->mesh, curve.path, i / 50.0));
      };
      farthest = std::max(farthest, (at(a, (*left)[c]) - at(b, (*right)[c])).norm());
    }
  }
  return farthest;
}

const TransferredCurve& curveOf(const Transfer& transfer, const std::string& id) {
  const auto found = std::find_if(transfer.curves.begin(), transfer.curves.end(),
                                  [&](const TransferredCurve& curve) { return curve.id == id; });
  EXPECT_NE(found, transfer.curves.end()) << id;
  return *found;
}

TEST(Transfer, ThereAndBackIsTheIdentityOnOneConnectivity) {
  const Document own = wetsuit();
  const auto other = builtin("builtin:body@1?size=EU62M");
  const Transfer there = carried(own, other, {.fair = false});
  const Transfer back = carried(there.document, own.model, {.fair = false});
  EXPECT_LE(farthestPoint(own, back.document), 1e-9 * 1000);  // positions are around 1000 mm
  EXPECT_TRUE(there.findings.empty());
  EXPECT_TRUE(back.findings.empty());
  // The far side is no copy of the near one.
  EXPECT_GT(curveOf(there, "neck-seam-l").lengthAfter.mm(),
            curveOf(there, "neck-seam-l").lengthBefore.mm() + 20);
}

/// How far the points of one flat piece lie from those of another, after the rigid motion that
/// brings them closest.
double farthestFromCongruent(const FlatPiece& a, const FlatPiece& b) {
  if (a.position.size() != b.position.size()) return std::numeric_limits<double>::infinity();
  const auto count = static_cast<double>(a.position.size());
  Eigen::Vector2d middleA = Eigen::Vector2d::Zero(), middleB = middleA;
  for (std::size_t v = 0; v < a.position.size(); ++v) {
    middleA += a.position[VertexId(v)] / count;
    middleB += b.position[VertexId(v)] / count;
  }
  double cosine = 0, sine = 0;
  for (std::size_t v = 0; v < a.position.size(); ++v) {
    const Eigen::Vector2d p = a.position[VertexId(v)] - middleA,
                          q = b.position[VertexId(v)] - middleB;
    cosine += p.dot(q);
    sine += p.x() * q.y() - p.y() * q.x();
  }
  const Eigen::Rotation2Dd turn(std::atan2(sine, cosine));
  double farthest = 0;
  for (std::size_t v = 0; v < a.position.size(); ++v) {
    const Eigen::Vector2d moved = turn * (a.position[VertexId(v)] - middleA) + middleB;
    farthest = std::max(farthest, (moved - b.position[VertexId(v)]).norm());
  }
  return farthest;
}

// Also with fairing: what is as calm as before is left alone. Any rotation, head down included.
TEST(Transfer, RigidlyMovedBodyGivesTheCongruentPattern) {
  const Document own = wetsuit();
  const Result<Pattern> before = makePattern(own);
  ASSERT_TRUE(before) << before.error();
  std::size_t compared = 0;
  for (const auto& [angle, axis] : {std::pair{0.7, Eigen::Vector3d(1, 2, -1)},
                                    {std::numbers::pi, Eigen::Vector3d(1, 0, 0)},
                                    {2.4, Eigen::Vector3d(-1, 0.4, 3)}}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    Result<ReferenceModel> model =
        withMesh(*own.model, "moved",
                 test::transformed(*own.model->mesh, turn, Eigen::Vector3d(120, -340, 55)));
    ASSERT_TRUE(model) << model.error();
    const Transfer transfer = carried(own, std::make_shared<const ReferenceModel>(*model));
    EXPECT_TRUE(transfer.findings.empty());
    const Result<Pattern> after = makePattern(transfer.document);
    ASSERT_TRUE(after) << after.error();
    ASSERT_TRUE(after->isComplete());
    ASSERT_EQ(before->cut.pieces.size(), after->cut.pieces.size());
    for (std::size_t p = 0; p < before->cut.pieces.size(); ++p) {
      if (!before->flats[p]) continue;
      const std::string& id = before->cut.pieces[p].id;
      EXPECT_EQ(id, after->cut.pieces[p].id);
      // Each linked point is found anew on the moved triangles; the solvers end within 1e-9 mm.
      EXPECT_LT(farthestFromCongruent(*before->flats[p], *after->flats[p]), 1e-4)
          << id << ", turned by " << angle;
      ++compared;
    }
  }
  EXPECT_GE(compared, 3 * 20U);
}

TEST(Transfer, EveryPieceIsMadeOnVeryDifferentBodies) {
  const Document own = wetsuit();
  for (const std::string body : {"builtin:body@1?size=EU104C", "builtin:body@1?size=EU62M",
                                 "builtin:body@1?posture=seated"}) {
    const Transfer transfer = carried(own, builtin(body));
    EXPECT_TRUE(transfer.findings.empty()) << body;
    const Result<Pattern> pattern = makePattern(transfer.document);
    ASSERT_TRUE(pattern) << pattern.error();
    EXPECT_TRUE(pattern->isComplete()) << body;
    EXPECT_EQ(pattern->pieces.size(), 20U) << body;
    for (const Finding& finding : pattern->findings) {
      EXPECT_NE(finding.code, "open-cut-end") << body << ": " << finding.message;
      EXPECT_NE(finding.code, "unnamed-piece") << body << ": " << finding.message;
    }
  }
}

TEST(Transfer, MirrorImagesStayLiveWhereVerticesArePaired) {
  const Document own = wetsuit();
  const Transfer transfer = carried(own, builtin("builtin:body@1?size=EU50M"));
  std::size_t images = 0;
  for (const StylingCurve& curve : transfer.document.design->curves) {
    if (!curve.mirrorOf) continue;
    ++images;
    EXPECT_TRUE(curve.dataPoints.empty()) << curve.id;
  }
  EXPECT_GT(images, 10U);
  // On a symmetric body the pattern is symmetric.
  const auto placed = placeCurves(*transfer.document.design, *transfer.document.model);
  ASSERT_TRUE(placed) << placed.error();
  std::map<std::string, double> lengths;
  for (const PlacedCurve& curve : *placed) {
    lengths[curve.id] = length(*transfer.document.model->mesh, curve.path);
  }
  EXPECT_NEAR(lengths.at("side-back-l"), lengths.at("side-back-r"), 1e-9 * 1000);
}

// Everything that the design and its model say goes along.
TEST(Transfer, NamesRecordsGrainAndMapGoAlong) {
  Document own = wetsuit();
  // A guiding map of the model's own, grain lines and a hand's placement.
  ReferenceModel mapped = *own.model;
  mapped.map = std::make_shared<GuidingMapSlot>(makeGuidingMap(*own.model));
  Design design = *own.design;
  design.pieces[0].grain = Grain{Grain::Axis::X, Angle::degrees(12), {}};
  design.pieces[1].grain = Grain{Grain::Axis::Y, Angle::degrees(-3), {}};
  design.layout.push_back({design.pieces[0].id, {30, -12}, Angle::degrees(5)});
  own = {std::make_shared<const Design>(design), std::make_shared<const ReferenceModel>(mapped)};

  // Of the target nothing is known but its triangles.
  const auto body = builtin("builtin:body@1?size=EU50M");
  const auto bare = std::make_shared<const ReferenceModel>(makeReferenceModel("bare", *body->mesh));
  const Transfer transfer = carried(own, bare);
  EXPECT_TRUE(transfer.findings.empty());
  const ReferenceModel& model = *transfer.document.model;

  EXPECT_EQ(model.landmarks, own.model->landmarks);
  ASSERT_EQ(model.curves.size(), own.model->curves.size());
  for (const auto& [name, path] : own.model->curves) {
    EXPECT_EQ(model.curves.at(name).points, path.points) << name;
  }
  ASSERT_TRUE(model.symmetry.has_value());
  EXPECT_EQ(model.symmetry->partner, own.model->symmetry->partner);
  ASSERT_TRUE(model.map && model.map->isGiven());
  const auto map = guidingMap(model), ownMap = guidingMap(*own.model);
  EXPECT_EQ(map->charts, ownMap->charts);
  EXPECT_EQ(map->chartOf, ownMap->chartOf);
  EXPECT_NE(map->corners, ownMap->corners);  // its places are those of the other shape

  const Design& after = *transfer.document.design;
  EXPECT_EQ(after.layout, design.layout);
  ASSERT_EQ(after.pieces.size(), design.pieces.size());
  for (std::size_t p = 0; p < design.pieces.size(); ++p) {
    PieceRecord same = after.pieces[p];
    same.anchor = design.pieces[p].anchor;  // stands on the target as a surface point
    EXPECT_EQ(same, design.pieces[p]) << design.pieces[p].id;
  }
  for (std::size_t c = 0; c < design.curves.size(); ++c) {
    EXPECT_EQ(after.curves[c].id, design.curves[c].id);
    EXPECT_EQ(after.curves[c].kind, design.curves[c].kind);
    EXPECT_EQ(after.curves[c].closed, design.curves[c].closed);
    EXPECT_EQ(after.curves[c].mirrorOf, design.curves[c].mirrorOf);
  }
  // Each seed lies in its own region: no piece is lost, none is new.
  const auto placed = placeCurves(after, model);
  ASSERT_TRUE(placed) << placed.error();
  const Result<CutResult> pieces = cut(transfer.document, *placed);
  ASSERT_TRUE(pieces) << pieces.error();
  for (const PieceRecord& record : design.pieces) {
    const auto found = std::find_if(pieces->pieces.begin(), pieces->pieces.end(),
                                    [&](const Piece& piece) { return piece.id == record.id; });
    ASSERT_NE(found, pieces->pieces.end()) << record.id;
    EXPECT_EQ(found->recordIndices.size(), 1U) << record.id;
  }
}

// A line drawn on the one side changes its image on the other, after the transfer as before.
TEST(Transfer, LinkedLinesStayLinkedWhenTheyAreChanged) {
  const Document own = wetsuit();
  const Transfer transfer = carried(own, builtin("builtin:body@1?size=EU44F"));
  Design changed = *transfer.document.design;
  const auto image = std::find_if(changed.curves.begin(), changed.curves.end(),
                                  [](const StylingCurve& curve) { return curve.mirrorOf; });
  ASSERT_NE(image, changed.curves.end());
  const std::string imageId = image->id, originalId = *image->mirrorOf;
  const auto original =
      std::find_if(changed.curves.begin(), changed.curves.end(),
                   [&](const StylingCurve& curve) { return curve.id == originalId; });
  ASSERT_NE(original, changed.curves.end());
  ASSERT_GE(original->dataPoints.size(), 3U);
  original->dataPoints.erase(original->dataPoints.begin() + 1);
  const Mesh& mesh = *transfer.document.model->mesh;
  const auto lengthOf = [&](const Design& design, const std::string& id) {
    const auto placed = placeCurves(design, *transfer.document.model);
    EXPECT_TRUE(placed) << placed.error();
    for (const PlacedCurve& curve : *placed) {
      if (curve.id == id) return length(mesh, curve.path);
    }
    return 0.0;
  };
  EXPECT_NEAR(lengthOf(changed, imageId), lengthOf(changed, originalId), 1e-6);
  EXPECT_NE(lengthOf(changed, imageId), lengthOf(*transfer.document.design, imageId));
}

TEST(Transfer, CurvesToBeKeptAndAnatomicalOnesAreNotFaired) {
  const Document own = wetsuit();
  const auto target = builtin("builtin:body@1?size=EU62M");
  const Transfer raw = carried(own, target, {.fair = false});
  const Transfer kept = carried(own, target, {.keep = {"side-front-l"}});
  EXPECT_EQ(curveOf(kept, "side-front-l").fairing, TransferredCurve::Fairing::Kept);
  EXPECT_EQ(curveOf(kept, "centre-front").fairing, TransferredCurve::Fairing::Anatomical);
  EXPECT_EQ(curveOf(kept, "side-back-l").fairing, TransferredCurve::Fairing::Faired);
  EXPECT_EQ(curveOf(kept, "side-front-l").deviation, Length());
  EXPECT_EQ(curveOf(raw, "side-back-l").fairing, TransferredCurve::Fairing::None);
  const auto map = Correspondence::onOneConnectivity(own.model->index, target->index);
  const Result<Transfer> refused = transferDesign(own, target, *map, {.keep = {"no-such"}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::NameNotFound);
}

// The article's figure 12: a smooth line becomes S-shaped on a body of very different shape.
TEST(Transfer, TakesTheWobbleOutOfALineOnAVeryDifferentBody) {
  TOILE_TEST_DATA_OR_SKIP(heavy, "bodies/male_heavy.ply");
  const std::string design = std::string(TOILE_SOURCE_DIR) + "/tests/designs/wetsuit.toile";
  const Result<Document> own = openDocument(design);
  ASSERT_TRUE(own) << own.error();
  const Result<Document> body = openDocument(design, heavy.string(), *parseFileUnit("mm"));
  ASSERT_TRUE(body) << body.error();
  const Transfer transfer = carried(*own, body->model);
  const TransferredCurve& line = curveOf(transfer, "princess-front-l");
  EXPECT_EQ(line.fairing, TransferredCurve::Fairing::Faired);
  EXPECT_GE(line.bendsCarried, line.bendsBefore + 4) << "the wobble is not reproduced";
  EXPECT_LE(line.bendsAfter, line.bendsBefore);
  EXPECT_LT(line.variationAfter, 0.3 * line.variationCarried);
  EXPECT_LT(line.deviation.mm(), 10);
  int carriedBends = 0, bends = 0;
  for (const TransferredCurve& curve : transfer.curves) {
    if (curve.fairing != TransferredCurve::Fairing::Faired) continue;
    carriedBends += curve.bendsCarried - curve.bendsBefore;
    bends += std::max(0, curve.bendsAfter - curve.bendsBefore);
  }
  EXPECT_GT(carriedBends, 50);
  EXPECT_LT(bends, 0.1 * carriedBends);
  EXPECT_TRUE(transfer.findings.empty());
}

// Smooth lines that share a sharp fold (crotch, bent knee) must not be led across each other.
TEST(Transfer, NoLineIsFairedIntoALessCalmOne) {
  const Transfer transfer = carried(wetsuit(), builtin("builtin:body@1?size=EU62M"));
  std::size_t faired = 0;
  for (const TransferredCurve& curve : transfer.curves) {
    if (curve.fairing != TransferredCurve::Fairing::Faired) continue;
    ++faired;
    EXPECT_LE(curve.variationAfter, curve.variationCarried) << curve.id;
  }
  EXPECT_GE(faired, 5U);
  // Level all round the ankle, with two bends too small to see: fairing tilted it by 17 mm.
  const TransferredCurve& ankle = curveOf(transfer, "ankle-l");
  EXPECT_EQ(ankle.fairing, TransferredCurve::Fairing::Calm);
  EXPECT_EQ(ankle.deviation, Length());
}

TEST(Transfer, LeavesLinesAloneThatFairingWouldEntangle) {
  TOILE_TEST_DATA_OR_SKIP(bent, "bodies/male_average_knee_bent.ply");
  const std::string design = std::string(TOILE_SOURCE_DIR) + "/tests/designs/wetsuit.toile";
  const Result<Document> own = openDocument(design);
  ASSERT_TRUE(own) << own.error();
  const Result<Document> body = openDocument(design, bent.string(), *parseFileUnit("mm"));
  ASSERT_TRUE(body) << body.error();
  const Transfer transfer = carried(*own, body->model);
  EXPECT_TRUE(transfer.findings.empty());
  const Result<Pattern> pattern = makePattern(transfer.document);
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_TRUE(pattern->isComplete());
  EXPECT_EQ(pattern->pieces.size(), 24U);
}

TEST(Transfer, GoesToAModelOfOtherConnectivity) {
  TOILE_TEST_DATA_OR_SKIP(fine, "bodies/female_average_fine.ply");
  const Result<Document> own =
      openDocument(std::string(TOILE_SOURCE_DIR) + "/tests/designs/wetsuit.toile");
  ASSERT_TRUE(own) << own.error();
  const Result<ReferenceModel> read = readModel(fine, *parseFileUnit("mm"));
  ASSERT_TRUE(read) << read.error();
  const auto target = std::make_shared<const ReferenceModel>(*read);
  const auto map = Correspondence::throughFit(own->model->index, own->model->index, target->index);
  ASSERT_TRUE(map) << map.error();
  const Result<Transfer> transfer = transferDesign(*own, target, *map, {});
  ASSERT_TRUE(transfer) << transfer.error();
  EXPECT_TRUE(transfer->findings.empty());
  const ReferenceModel& named = *transfer->document.model;
  EXPECT_EQ(named.landmarks.size(), own->model->landmarks.size());
  EXPECT_EQ(named.curves.size(), own->model->curves.size());
  ASSERT_TRUE(named.symmetry.has_value());
  EXPECT_NEAR(std::abs(named.symmetry->normal.x()), 1, 1e-3);
  // The same body: girths differ by what the smooth surface bulges over flat triangles.
  for (const TransferredCurve& curve : transfer->curves) {
    EXPECT_NEAR(curve.lengthAfter.mm(), curve.lengthBefore.mm(), 0.03 * curve.lengthBefore.mm() + 1)
        << curve.id;
  }
  const Result<Pattern> pattern = makePattern(transfer->document);
  ASSERT_TRUE(pattern) << pattern.error();
  EXPECT_TRUE(pattern->isComplete());
  EXPECT_EQ(pattern->pieces.size(), 24U);
}

TEST(TransferRecords, AnchorBesideItsRegionIsMovedThere) {
  const Document own = test::sleeveDocument();
  const auto placed = placeCurves(*own.design, *own.model);
  ASSERT_TRUE(placed) << placed.error();
  const Result<CutResult> before = cut(own, *placed);
  ASSERT_TRUE(before) << before.error();
  ASSERT_EQ(own.design->pieces.size(), 2U);
  Design swapped = *own.design;
  swapped.pieces[0].anchor = own.design->pieces[1].anchor;
  const Result<CutResult> after = cut(test::withDesign(own, swapped), *placed);
  ASSERT_TRUE(after) << after.error();
  std::vector<Finding> findings;
  const auto tangled =
      detail::checkRecords(swapped, *own.design, *before, *after, *own.model->mesh, findings);
  // Both halves of a sleeve are bounded by the same curves; the cycles tell them apart or not at
  // all, and what cannot be told apart is reported rather than guessed.
  ASSERT_FALSE(detail::boundingCycles(before->pieces[0]).empty());
  if (detail::boundingCycles(before->pieces[0]) == detail::boundingCycles(before->pieces[1])) {
    EXPECT_TRUE(tangled.empty());
  } else {
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].code, "piece-moved");
    const Result<CutResult> mended = cut(test::withDesign(own, swapped), *placed);
    ASSERT_TRUE(mended) << mended.error();
    EXPECT_EQ(mended->pieces[0].id, before->pieces[0].id);
    EXPECT_EQ(detail::boundingCycles(mended->pieces[0]), detail::boundingCycles(before->pieces[0]));
  }
}

TEST(Transfer, ReportNamesEveryCurveOnce) {
  const Document own = wetsuit();
  const Transfer transfer = carried(own, own.model);
  const auto json = nlohmann::json::parse(writeTransferReport(transfer));
  EXPECT_EQ(json["format"], "toile-transfer");
  std::size_t originals = 0;
  for (const StylingCurve& curve : own.design->curves) originals += curve.mirrorOf ? 0 : 1;
  EXPECT_EQ(json["curves"].size(), originals);
  for (const auto& curve : json["curves"]) {
    EXPECT_NEAR(curve["lengthAfterMm"].get<double>(), curve["lengthBeforeMm"].get<double>(), 1e-6);
  }
}

}  // namespace
}  // namespace toile

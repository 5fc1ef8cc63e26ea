// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>
#include <vector>

#include "design/design_names.h"
#include "design/json_text.h"
#include "toile/design/design_file.h"

namespace toile {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

/// Members of an object, each with its JSON text.
class Members {
 public:
  Members& add(std::string_view key, std::string text) {
    list_.emplace_back(quoteJson(key), std::move(text));
    return *this;
  }
  Members& addText(std::string_view key, std::string_view text) {
    return text.empty() ? *this : add(key, quoteJson(text));
  }
  Members& addUnknown(const UnknownKeys& unknown) {
    for (const auto& [key, text] : unknown) add(key, text);
    return *this;
  }
  [[nodiscard]] bool empty() const { return list_.empty(); }

  /// On one line.
  [[nodiscard]] std::string row() const {
    std::string out = "{";
    for (const auto& [key, text] : list_) out += (out.size() > 1 ? ", " : "") + key + ": " + text;
    return out + "}";
  }
  /// A member a line, for an object whose brace stands at `indent`.
  [[nodiscard]] std::string block(int indent) const {
    const std::string margin(static_cast<std::size_t>(indent) + 2, ' ');
    std::string out = "{";
    for (const auto& [key, text] : list_) {
      out += (out.size() > 1 ? ",\n" : "\n") + margin + key + ": " + text;
    }
    return out + "\n" + std::string(static_cast<std::size_t>(indent), ' ') + "}";
  }

 private:
  std::vector<std::pair<std::string, std::string>> list_;
};

std::string row(const std::vector<std::string>& items) {
  std::string out = "[";
  for (const std::string& item : items) out += (out.size() > 1 ? ", " : "") + item;
  return out + "]";
}

/// An item a line, for an array whose bracket closes at `indent`.
std::string block(const std::vector<std::string>& items, int indent) {
  if (items.empty()) return "[]";
  const std::string margin(static_cast<std::size_t>(indent) + 2, ' ');
  std::string out = "[";
  for (const std::string& item : items) out += (out.size() > 1 ? ",\n" : "\n") + margin + item;
  return out + "\n" + std::string(static_cast<std::size_t>(indent), ' ') + "]";
}

template <class Range, class Function>
std::vector<std::string> each(const Range& range, Function function) {
  std::vector<std::string> out;
  for (const auto& item : range) out.push_back(function(item));
  return out;
}

std::string number(std::uint32_t index) {
  return std::to_string(index);
}
std::string truth(bool value) {
  return value ? "true" : "false";
}
template <class Vector>
std::string numbers(const Vector& vector) {
  std::vector<std::string> items;
  for (Eigen::Index i = 0; i < vector.size(); ++i) items.push_back(formatExact(vector[i]));
  return row(items);
}
template <class Quantity>
std::string quantity(const Quantity& value) {
  return quoteJson(toString(value));
}

Members members(const ModelPoint& point) {
  return std::visit(
      Overloaded{
          [](VertexId vertex) { return Members().add("vertex", number(vertex.index())); },
          [](const ModelPoint::OnEdge& p) {
            return Members()
                .add("edge", row({number(p.tail.index()), number(p.head.index())}))
                .add("t", formatExact(p.t));
          },
          [](const SurfacePoint::InFace& p) {
            return Members()
                .add("face", number(p.face.index()))
                .add("weights", numbers(p.barycentric));
          },
      },
      point.at);
}

std::string text(const SectionPlane& plane) {
  Members out;
  out.add("normal", numbers(plane.normal));
  if (const auto* landmark = std::get_if<AtLandmark>(&plane.through)) {
    out.add("through", quoteJson(landmark->name));
  } else if (const auto* point = std::get_if<ModelPoint>(&plane.through)) {
    out.add("point", members(*point).row());
  } else {
    out.add("offset", quantity(std::get<Length>(plane.through)));
  }
  return out.addUnknown(plane.unknown).row();
}

struct PlaceMembers {
  Members operator()(const ModelPoint& point) const { return members(point); }
  Members operator()(const AtLandmark& p) const {
    return Members().add("landmark", quoteJson(p.name)).addUnknown(p.unknown);
  }
  Members operator()(const OnModelCurve& p) const {
    return Members()
        .add("curve", quoteJson(p.name))
        .add("at", formatExact(p.fraction))
        .addUnknown(p.unknown);
  }
  Members operator()(const OnStylingCurve& p) const {
    return Members()
        .add("line", quoteJson(p.id))
        .add("at", formatExact(p.fraction))
        .addUnknown(p.unknown);
  }
  Members operator()(const OnSection& p) const {
    return Members()
        .add("section", text(p.plane))
        .add("direction", numbers(p.direction))
        .addUnknown(p.unknown);
  }
  Members operator()(const NearPosition& p) const {
    return Members().add("near", numbers(p.position)).addUnknown(p.unknown);
  }
  Members operator()(const BetweenPlaces& p) const {
    const auto end = [this](const SinglePlace& place) { return std::visit(*this, place).row(); };
    return Members()
        .add("between", row(each(p.ends, end)))
        .add("at", formatExact(p.fraction))
        .addUnknown(p.unknown);
  }
};

std::string text(const Place& place) {
  return std::visit(PlaceMembers(), place).row();
}

std::string places(const std::vector<Place>& list, int indent) {
  return block(each(list, [](const Place& place) { return text(place); }), indent);
}

void addRule(Members& out, SubdivisionRule rule) {
  if (rule != SubdivisionRule::Auto) out.add("rule", quoteJson(nameOf(kRuleNames, rule)));
}

void addCorners(Members& out, const std::vector<std::size_t>& corners) {
  if (corners.empty()) return;
  out.add("corners", row(each(corners, [](std::size_t i) { return std::to_string(i); })));
}

std::string text(const View& view, const UnknownKeys& unknown) {
  return Members()
      .add("eye", numbers(view.eye))
      .add("target", numbers(view.target))
      .add("up", numbers(view.up))
      .add("height", quantity(Length::mm(view.height)))
      .add("perspective", truth(view.perspective))
      .addUnknown(unknown)
      .row();
}

/// The way of a curve whose brace stands at `indent`.
std::string text(const CurveWay& way, int indent) {
  const int inner = indent + 2;
  return std::visit(
      Overloaded{
          [&](const SmoothWay& w) {
            Members out;
            out.add("smooth", places(w.controls, inner));
            addRule(out, w.rule);
            addCorners(out, w.corners);
            return out.addUnknown(w.unknown).block(indent);
          },
          [&](const ViewWay& w) {
            Members out;
            out.add("view", text(w.view, w.unknownOfView));
            out.add(
                "controls",
                block(each(w.controls, [](const auto& point) { return numbers(point); }), inner));
            addRule(out, w.rule);
            addCorners(out, w.corners);
            return out.addUnknown(w.unknown).block(indent);
          },
          [](const AlongModelCurve& w) {
            Members out;
            out.add("curve", quoteJson(w.name));
            out.add("from", formatExact(w.from)).add("to", formatExact(w.to));
            return out.addUnknown(w.unknown).row();
          },
          [](const AlongVertices& w) {
            return Members()
                .add("vertices",
                     row(each(w.vertices, [](VertexId v) { return number(v.index()); })))
                .addUnknown(w.unknown)
                .row();
          },
          [](const AlongSection& w) {
            return Members().add("section", text(w.plane)).addUnknown(w.unknown).row();
          },
          [&](const ShortestWay& w) {
            return Members()
                .add("shortest", places(w.controls, inner))
                .addUnknown(w.unknown)
                .block(indent);
          },
      },
      way);
}

void addSide(Members& out, std::string_view key, const SeamSide& side) {
  Members members;
  if (side.allowance) members.add("allowance", quantity(*side.allowance));
  if (side.kind != SeamKind::Butt) {
    members.add("kind", quoteJson(nameOf(kSeamKindNames, side.kind)));
  }
  if (side.corner) members.add("corner", quoteJson(nameOf(kCornerStyleNames, *side.corner)));
  members.addUnknown(side.unknown);
  if (!members.empty()) out.add(key, members.row());
}

/// False for a curve that is data points or a mirror image alone: its way is the empty one.
bool hasWay(const StylingCurve& curve) {
  const auto* way = std::get_if<SmoothWay>(&curve.way);
  return way == nullptr || !way->controls.empty() || way->rule != SubdivisionRule::Auto ||
         !way->unknown.empty();
}

std::string text(const StylingCurve& curve, int indent) {
  Members out;
  out.add("id", quoteJson(curve.id));
  out.addText("name", curve.name);
  out.add("kind", quoteJson(toString(curve.kind)));
  if (curve.closed) out.add("closed", "true");
  if (curve.mirrorOf) out.add("mirrorOf", quoteJson(*curve.mirrorOf));
  if (hasWay(curve)) out.add("way", text(curve.way, indent + 2));
  if (!curve.dataPoints.empty()) {
    const auto point = [](const ModelPoint& p) { return members(p).row(); };
    out.add("points", block(each(curve.dataPoints, point), indent + 2));
  }
  if (curve.elasticRange) out.add("elasticRange", quantity(*curve.elasticRange));
  addSide(out, "left", curve.left);
  addSide(out, "right", curve.right);
  return out.addUnknown(curve.unknown).block(indent);
}

/// As one ratio where it is the same in all directions.
std::string text(const Ease& ease) {
  if (ease.girth == ease.length && ease.along == Ease().along && ease.unknown.empty()) {
    return quantity(ease.girth);
  }
  return Members()
      .add("girth", quantity(ease.girth))
      .add("length", quantity(ease.length))
      .add("along", quoteJson(ease.along))
      .addUnknown(ease.unknown)
      .row();
}

std::string text(const DevelopSetting& develop) {
  Members out;
  if (develop.amount) out.add("amount", quantity(*develop.amount));
  if (develop.maxAreaError) out.add("maxAreaError", quantity(*develop.maxAreaError));
  if (develop.gap) out.add("gap", quantity(*develop.gap));
  return out.addUnknown(develop.unknown).row();
}

std::string text(const Grain& grain) {
  Members out;
  if (grain.along != Grain().along)
    out.add("along", quoteJson(nameOf(kGrainAxisNames, grain.along)));
  if (grain.turn != Angle()) out.add("turn", quantity(grain.turn));
  return out.addUnknown(grain.unknown).row();
}

std::string text(const Twin& twin) {
  Members out;
  out.add("of", quoteJson(twin.of));
  if (twin.mode != Twin().mode) out.add("mode", quoteJson(nameOf(kTwinModeNames, twin.mode)));
  return out.addUnknown(twin.unknown).row();
}

std::string text(const ClothWeights& weights) {
  return Members()
      .add("along", formatExact(weights.along))
      .add("across", formatExact(weights.across))
      .add("shear", formatExact(weights.shear))
      .addUnknown(weights.unknown)
      .row();
}

std::string text(const PieceRecord& piece, int indent) {
  Members out;
  out.add("id", quoteJson(piece.id));
  out.addText("name", piece.name);
  out.add("anchor", text(piece.anchor));
  if (!piece.include) out.add("include", "false");
  if (piece.count != 1) out.add("count", std::to_string(piece.count));
  out.addText("fabric", piece.fabric);
  if (piece.ease) out.add("ease", text(*piece.ease));
  if (piece.develop) out.add("develop", text(*piece.develop));
  if (piece.grain) out.add("grain", text(*piece.grain));
  if (piece.twin) out.add("twin", text(*piece.twin));
  if (!piece.boundary.empty()) out.add("boundary", row(each(piece.boundary, quoteJson)));
  return out.addUnknown(piece.unknown).block(indent);
}

std::string text(const Fabric& fabric, int indent) {
  Members out;
  out.add("id", quoteJson(fabric.id));
  out.addText("name", fabric.name);
  out.addText("colour", fabric.colour);
  if (fabric.stretchAlong) out.add("stretchAlong", quantity(*fabric.stretchAlong));
  if (fabric.stretchAcross) out.add("stretchAcross", quantity(*fabric.stretchAcross));
  if (fabric.shear) out.add("shear", quantity(*fabric.shear));
  if (fabric.weights) out.add("weights", text(*fabric.weights));
  out.add("thickness", quantity(fabric.thickness));
  if (fabric.thicknessOffset != Ratio()) {
    out.add("thicknessOffset", quantity(fabric.thicknessOffset));
  }
  if (fabric.rollWidth) out.add("rollWidth", quantity(*fabric.rollWidth));
  if (fabric.allowance) out.add("allowance", quantity(*fabric.allowance));
  if (fabric.turns != Turns::TwoWay) {
    out.add("turns", quoteJson(nameOf(kTurnsNames, fabric.turns)));
  }
  out.add("ease", text(fabric.ease));
  return out.addUnknown(fabric.unknown).block(indent);
}

std::string text(const ModelReference& model) {
  Members out;
  out.add("model", quoteJson(model.reference));
  if (model.unit) out.add("unit", quantity(*model.unit));
  if (model.connectivityHash) out.add("connectivity", quoteJson(model.connectivityHash->hex()));
  return out.addUnknown(model.unknown).row();
}

std::string text(const FinishSettings& finish) {
  const FinishSettings usual;
  Members out;
  out.add("allowance", quantity(finish.allowance))
      .add("notchDepth", quantity(finish.notchDepth))
      .add("notchSpacing", quantity(finish.notchSpacing));
  if (finish.hemAllowance) out.add("hemAllowance", quantity(*finish.hemAllowance));
  if (finish.lappedAllowance) out.add("lappedAllowance", quantity(*finish.lappedAllowance));
  if (finish.openingAllowance) out.add("openingAllowance", quantity(*finish.openingAllowance));
  if (finish.corner != usual.corner) {
    out.add("corner", quoteJson(nameOf(kCornerStyleNames, finish.corner)));
  }
  if (finish.notchKind != usual.notchKind) {
    out.add("notchKind", quoteJson(nameOf(kNotchKindNames, finish.notchKind)));
  }
  if (finish.notchWidth != usual.notchWidth) {
    out.add("notchWidth", quantity(finish.notchWidth));
  }
  if (finish.halfOnFold) out.add("halfOnFold", "true");
  return out.addUnknown(finish.unknown).block(2);
}

std::string text(const HandPlacement& placement) {
  Members out;
  out.add("piece", quoteJson(placement.piece));
  if (placement.move != Eigen::Vector2d::Zero()) out.add("move", numbers(placement.move));
  if (placement.turn != Angle()) out.add("turn", quantity(placement.turn));
  return out.addUnknown(placement.unknown).row();
}

template <class Item>
std::string blocks(const std::vector<Item>& list) {
  return block(each(list, [](const Item& item) { return text(item, 4); }), 2);
}

}  // namespace

std::string writeDesign(const Design& design) {
  Members out;
  out.add("toile", std::to_string(kDesignFormatVersion));
  out.addText("name", design.name);
  out.add("models", block(each(design.models, [](const ModelReference& m) { return text(m); }), 2));
  out.add("curves", blocks(design.curves));
  out.add("pieces", blocks(design.pieces));
  if (!design.fabrics.empty()) out.add("fabrics", blocks(design.fabrics));
  if (design.order != Order()) {
    Members order;
    order.addText("style", design.order.style).addText("size", design.order.size);
    order.addText("customer", design.order.customer).addText("date", design.order.date);
    out.add("order", order.addUnknown(design.order.unknown).block(2));
  }
  out.add("finish", text(design.finish));
  if (!design.layout.empty()) {
    out.add("layout",
            block(each(design.layout, [](const HandPlacement& p) { return text(p); }), 2));
  }
  return out.addUnknown(design.unknown).block(0) + "\n";
}

}  // namespace toile

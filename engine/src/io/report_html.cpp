// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "io/markup.h"
#include "io/report_data.h"
#include "render/strain_map.h"
#include "toile/core/version.h"
#include "toile/io/report.h"

namespace toile {
namespace {

constexpr const char* kStyle = R"(
:root{color:#1f2124;background:#fbfaf8;font:15px/1.5 Inter,"Segoe UI","Noto Sans","DejaVu Sans",sans-serif}
body{max-width:68rem;margin:2.5rem auto;padding:0 1.5rem}
h1{font-size:1.7rem;line-height:1.25;margin:0 0 .2rem}
h2{font-size:1.15rem;margin:2.4rem 0 .6rem}
p{max-width:44rem;margin:.4rem 0}
.second{color:#55585e}
.state{display:inline-block;margin:.9rem 0 .2rem;padding:.25rem .7rem;border-radius:6px;border:1px solid;font-weight:600}
.order{color:#1f7a3d}.trouble{color:#a8320b}
dl{display:flex;flex-wrap:wrap;margin:1rem 0}dl div{margin:.2rem 2.4rem .2rem 0}
dt{color:#55585e;font-size:.85rem}dd{margin:0;font-size:1.15rem;font-variant-numeric:tabular-nums}
.pieces{display:grid;grid-template-columns:repeat(auto-fill,minmax(13rem,1fr));gap:1rem}
figure{margin:0;padding:.8rem;background:#fff;border:1px solid #dad7d1;border-radius:9px;break-inside:avoid;display:flex;flex-direction:column}
figure svg{width:100%;height:15rem;flex:none}
figcaption{margin-top:.6rem;font-size:.87rem;line-height:1.45}
figcaption b{font-size:1rem;display:block}
table{border-collapse:collapse;width:100%;font-size:.92rem;font-variant-numeric:tabular-nums}
th{text-align:left;font-weight:600;color:#55585e;border-bottom:1.5px solid #8b877f;padding:.3rem .6rem .3rem 0;vertical-align:bottom}
td{border-bottom:1px solid #dad7d1;padding:.28rem .6rem .28rem 0}
th.n,td.n{text-align:right;white-space:nowrap;padding-right:0;padding-left:.9rem}
tr{break-inside:avoid}thead{display:table-header-group}
li{margin:.25rem 0;max-width:50rem}
code{font:.85em "DejaVu Sans Mono",monospace;color:#55585e}
.legend{width:20rem;max-width:100%;display:block;margin:.4rem 0 1rem}
sup{font-size:.72em;line-height:0}
@media print{:root{background:#fff;font-size:10.5pt}body{margin:0;max-width:none;padding:0}.pieces{grid-template-columns:repeat(3,1fr)}}
@page{margin:15mm}
)";

constexpr const char* kThinSpace = "\u202f";

std::string mm(double value) {
  return fmt::format("{:.1f}{}mm", value, kThinSpace);
}
std::string squareCm(double value) {
  return fmt::format("{:.1f}{}cm\u00b2", value / 100, kThinSpace);
}

/// A small number as people write it; what is not zero never reads as zero.
std::string powerOfTen(double value) {
  if (value == 0) return "0";
  const int power = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fmt::format("{:.1f}\u202f\u00d7\u202f10<sup>{}{}</sup>", value / std::pow(10.0, power),
                     power < 0 ? "\u2212" : "", std::abs(power));
}

std::string signedMm(double value) {
  if (value == 0) return fmt::format("0{}mm", kThinSpace);
  const char* sign = value < 0 ? "\u2212" : "+";
  const double size = std::abs(value);
  return sign + (size >= 0.05 ? fmt::format("{:.1f}", size) : powerOfTen(size)) + kThinSpace + "mm";
}

std::string signedPercent(double part) {
  return fmt::format("{}{:.1f}{}%", part < 0 ? "\u2212" : "+", 100 * std::abs(part), kThinSpace);
}

class HtmlReport {
 public:
  explicit HtmlReport(const Pattern& pattern) : pattern_(pattern), data_(measure(pattern)) {
    for (const StylingCurve& curve : pattern.document.design->curves) {
      if (!curve.name.empty()) curveNames_[curve.id] = curve.name;
    }
  }

  std::string write() {
    addHead();
    addTrouble();
    addElastics();
    addPieces();
    addSeams();
    addInnerWires();
    addOpenEdges();
    addNotes();
    return out_ + "</body>\n</html>\n";
  }

 private:
  [[nodiscard]] std::string curveName(const std::string& id) const {
    const auto found = curveNames_.find(id);
    if (found != curveNames_.end()) return escaped(found->second);
    return id == "border" ? "border of the model" : escaped(id);
  }
  [[nodiscard]] std::string pieceName(std::size_t index) const {
    const Piece& piece = pattern_.cut.pieces[index];
    return escaped(piece.name.empty() ? piece.id : piece.name);
  }
  [[nodiscard]] bool hasFlat(std::size_t index) const { return pattern_.flats[index] != nullptr; }

  void addHead() {
    const std::string name = escaped(
        pattern_.document.design->name.empty() ? "Pattern" : pattern_.document.design->name);
    out_ += fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
        "<title>{} - pattern report</title>\n<style>{}</style>\n</head>\n<body>\n"
        "<h1>{}</h1>\n<p class=\"second\">Pattern report for the model {}</p>\n",
        name, kStyle, name, escaped(pattern_.document.model->name));
    out_ +=
        pattern_.isComplete()
            ? "<p class=\"state order\">\u2713 All pieces are made and passed their checks</p>\n"
            : "<p class=\"state trouble\">! Not all pieces could be made</p>\n";
    out_ += "<dl>";
    addFact("Pieces", fmt::format("{}", data_.unfolded));
    addFact("Area on the model", squareCm(data_.includedArea));
    addFact("Area of the pieces", squareCm(data_.flatArea));
    addFact("Edges with exact length", fmt::format("{}", data_.wireEdges));
    addFact("Greatest length error", powerOfTen(data_.maxEdgeError));
    out_ += "</dl>\n";
  }

  void addElastics() {
    if (pattern_.elastics.empty()) return;
    out_ += "<h2>Elastic lines</h2>\n<ul>\n";
    for (const ElasticLine& line : pattern_.elastics) {
      out_ += fmt::format("<li><b>{}</b>: {} of its length, {:.3g}{}% allowed either way</li>\n",
                          curveName(line.curve), signedPercent(line.ratio), 100 * line.range,
                          kThinSpace);
    }
    out_ += "</ul>\n";
  }

  void addFact(const char* term, const std::string& value) {
    out_ += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", term, value);
  }

  void addTrouble() {
    bool any = false;
    for (std::size_t i = 0; i < pattern_.failures.size(); ++i) {
      if (!pattern_.failures[i]) continue;
      if (!any) out_ += "<h2>Pieces that could not be made</h2>\n<ul>\n";
      any = true;
      out_ +=
          fmt::format("<li><b>{}</b>: {} <code>{}</code></li>\n", pieceName(i),
                      escaped(pattern_.failures[i]->message), toString(pattern_.failures[i]->code));
    }
    if (any) out_ += "</ul>\n";
    out_ += "<h2>Findings</h2>\n";
    if (pattern_.findings.empty()) {
      out_ += "<p>No findings.</p>\n";
      return;
    }
    out_ += "<ul>\n";
    for (const Finding& finding : pattern_.findings) {
      out_ += fmt::format("<li>{} <code>{}</code></li>\n", escaped(finding.message),
                          escaped(finding.code));
    }
    out_ += "</ul>\n";
  }

  void addPieces() {
    if (data_.unfolded == 0) return;
    const StrainField field(pattern_, StrainMap::Area);
    out_ += fmt::format(
        "<h2>Pieces</h2>\n<p>Colours tell how far the area of the cloth differs from the body: "
        "orange must stretch, blue has cloth to spare.</p>\n{}\n<div class=\"pieces\">\n",
        strainLegendSvg(field));
    for (std::size_t i = 0; i < pattern_.cut.pieces.size(); ++i) {
      if (!hasFlat(i)) continue;
      const PieceReport& report = data_.pieces[i];
      out_ += fmt::format(
          "<figure>{}<figcaption><b>{}</b>{} on the model, {} flat ({})<br>"
          "area differs by {:.1f}{}% on average</figcaption></figure>\n",
          strainMapSvg(field, pattern_, i), pieceName(i), squareCm(report.bodyArea),
          squareCm(report.flatArea),
          signedPercent(report.flatArea / std::max(report.bodyArea, 1e-12) - 1),
          100 * pattern_.flats[i]->meanAreaError, kThinSpace);
    }
    out_ += "</div>\n";
    addWorstPlaces();
  }

  /// Where the cloth must give most, the worst first.
  void addWorstPlaces() {
    constexpr std::size_t kMostPlaces = 10;
    struct Place {
      const StrainSpot* spot;
      std::size_t piece;
    };
    std::vector<Place> places;
    for (std::size_t i = 0; i < data_.pieces.size(); ++i) {
      if (!data_.pieces[i].strain) continue;
      for (const StrainSpot& spot : data_.pieces[i].strain->worst) places.push_back({&spot, i});
    }
    if (places.empty()) return;
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      if (a.spot->isOverLimit() != b.spot->isOverLimit()) return a.spot->isOverLimit();
      return std::abs(a.spot->value) > std::abs(b.spot->value);
    });
    if (places.size() > kMostPlaces) places.resize(kMostPlaces);
    out_ += "<h2>Where the cloth must give most</h2>\n<ul>\n";
    for (const Place& place : places) {
      out_ += fmt::format("<li>{}, {}: {}</li>\n", pieceName(place.piece),
                          escaped(place.spot->place), escaped(describe(*place.spot)));
    }
    out_ += "</ul>\n";
  }

  void beginTable(const char* title, const std::vector<const char*>& words,
                  const std::vector<const char*>& numbers) {
    out_ += fmt::format("<h2>{}</h2>\n<table>\n<thead><tr>", title);
    for (const char* word : words) out_ += fmt::format("<th>{}</th>", word);
    for (const char* number : numbers) out_ += fmt::format("<th class=\"n\">{}</th>", number);
    out_ += "</tr></thead>\n<tbody>\n";
  }
  void addRow(const std::vector<std::string>& words, const std::vector<std::string>& numbers) {
    out_ += "<tr>";
    for (const std::string& word : words) out_ += fmt::format("<td>{}</td>", word);
    for (const std::string& number : numbers) {
      out_ += fmt::format("<td class=\"n\">{}</td>", number);
    }
    out_ += "</tr>\n";
  }
  void endTable() { out_ += "</tbody>\n</table>\n"; }

  /// One row per curve and pair of pieces: features part a seam into many runs.
  void addSeams() {
    struct Sum {
      Lengths a;
      double flatB = 0;
    };
    std::map<std::tuple<std::string, std::uint32_t, std::uint32_t>, std::size_t> rowOf;
    std::vector<std::pair<SeamMates, Sum>> rows;
    for (const SeamMates& mates : pattern_.cut.mates) {
      const std::string& curve = pattern_.cut.pieces[mates.pieceA].wires[mates.wireA].curve;
      const auto [at, isNew] = rowOf.try_emplace({curve, mates.pieceA, mates.pieceB}, rows.size());
      if (isNew) rows.emplace_back(mates, Sum());
      Sum& sum = rows[at->second].second;
      const Lengths& a = data_.pieces[mates.pieceA].wires[mates.wireA].lengths;
      sum.a.body += a.body;
      sum.a.target += a.target;
      sum.a.flat += a.flat;
      sum.flatB += data_.pieces[mates.pieceB].wires[mates.wireB].lengths.flat;
    }
    if (rows.empty()) return;
    beginTable("Seams", {"Seam", "Piece", "sewn to"},
               {"On the model", "Target", "Flat", "Mate's flat", "Difference"});
    for (const auto& [mates, sum] : rows) {
      const bool both = hasFlat(mates.pieceA) && hasFlat(mates.pieceB);
      addRow({curveName(pattern_.cut.pieces[mates.pieceA].wires[mates.wireA].curve),
              pieceName(mates.pieceA), pieceName(mates.pieceB)},
             {mm(sum.a.body), mm(sum.a.target), hasFlat(mates.pieceA) ? mm(sum.a.flat) : "not made",
              hasFlat(mates.pieceB) ? mm(sum.flatB) : "not made",
              both ? signedMm(sum.a.flat - sum.flatB) : ""});
    }
    endTable();
  }

  /// Rows of wires that are alone in their piece, summed per curve and piece.
  template <class Wanted>
  void addWires(const char* title, const Wanted& wanted) {
    bool any = false;
    for (std::size_t i = 0; i < pattern_.cut.pieces.size(); ++i) {
      if (!pattern_.cut.pieces[i].include) continue;
      std::map<std::string, Lengths> sums;
      std::vector<std::string> order;
      for (std::size_t w = 0; w < pattern_.cut.pieces[i].wires.size(); ++w) {
        const Wire& wire = pattern_.cut.pieces[i].wires[w];
        const WireReport& report = data_.pieces[i].wires[w];
        if (!wanted(wire, report)) continue;
        const auto [at, isNew] = sums.try_emplace(wire.curve);
        if (isNew) order.push_back(wire.curve);
        at->second.body += report.lengths.body;
        at->second.target += report.lengths.target;
        at->second.flat += report.lengths.flat;
      }
      for (const std::string& curve : order) {
        if (!any) beginTable(title, {"Line", "Piece"}, {"On the model", "Target", "Flat", "Error"});
        any = true;
        const Lengths& sum = sums[curve];
        addRow({curveName(curve), pieceName(i)},
               {mm(sum.body), mm(sum.target), hasFlat(i) ? mm(sum.flat) : "not made",
                hasFlat(i) ? signedMm(sum.flat - sum.target) : ""});
      }
    }
    if (any) endTable();
  }

  void addInnerWires() {
    addWires("Lines inside the pieces",
             [](const Wire& wire, const WireReport&) { return !isBoundary(wire.kind); });
  }
  void addOpenEdges() {
    addWires("Hems and openings", [](const Wire& wire, const WireReport& report) {
      return isBoundary(wire.kind) && !report.mate;
    });
  }

  void addNotes() {
    out_ += fmt::format(
        "<h2>How to read the lengths</h2>\n"
        "<p class=\"second\"><b>On the model</b> is measured along the line on the surface. "
        "<b>Target</b> is what the flat line must have, after ease. <b>Flat</b> is measured on the "
        "sew line of the piece. The greatest length error is the worst of all edges, divided by "
        "the edge's target (at least 1{0}mm). The same figures for every single stretch are in "
        "report.json; the pieces themselves are in pieces/, to be measured by other programs.</p>\n"
        "<p class=\"second\">Made by Toile {1}</p>\n",
        kThinSpace, version());
  }

  const Pattern& pattern_;
  ReportData data_;
  std::map<std::string, std::string> curveNames_;
  std::string out_;
};

}  // namespace

std::string writeReportHtml(const Pattern& pattern) {
  return HtmlReport(pattern).write();
}

}  // namespace toile

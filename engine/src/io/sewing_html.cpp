// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <glib.h>

#include <cmath>
#include <iterator>
#include <memory>

#include "io/markup.h"
#include "io/sewing_sheet.h"
#include "toile/io/sewing_files.h"

namespace toile {
namespace {

constexpr const char* kStyle = R"(
:root{color:#1f2124;background:#fbfaf8;font:15px/1.5 Inter,"Segoe UI","Noto Sans","DejaVu Sans",sans-serif}
body{max-width:64rem;margin:2.5rem auto;padding:0 1.5rem}
h1{font-size:1.7rem;line-height:1.25;margin:0 0 .6rem}h2{font-size:1.15rem;margin:2.2rem 0 .6rem}
.cover{max-width:100%;border-radius:9px;border:1px solid #dad7d1}
.second{color:#55585e}
dl{display:flex;flex-wrap:wrap;margin:1rem 0}dl div{margin:.2rem 2.4rem .2rem 0}
dt{color:#55585e;font-size:.85rem}dd{margin:0;font-size:1.15rem}
.pieces{display:grid;grid-template-columns:repeat(auto-fill,minmax(10rem,1fr));gap:1rem}
figure{margin:0;padding:.7rem;background:#fff;border:1px solid #dad7d1;border-radius:9px;break-inside:avoid}
figure svg{width:100%;height:11rem}svg path{fill-rule:evenodd}.body{fill:#e8e6e2}
.own{fill:#eda73f;stroke:#3a2c12;stroke-width:3}.shade{fill-opacity:.12}.seams{fill:none;stroke:#55585e;stroke-width:1.2}
figcaption{font-size:.87rem;line-height:1.45}figcaption b{display:block}
table{border-collapse:collapse;width:100%;font-size:.92rem;font-variant-numeric:tabular-nums}
th{text-align:left;font-weight:600;color:#55585e;border-bottom:1.5px solid #8b877f;padding:.3rem .6rem .3rem 0}
td{border-bottom:1px solid #dad7d1;padding:.28rem .6rem .28rem 0}
th.n,td.n{text-align:right;white-space:nowrap;padding:.28rem 0 .28rem .9rem}
.code{font-weight:600;white-space:nowrap}tr{break-inside:avoid}thead{display:table-header-group}
@media print{:root{background:#fff;font-size:10pt}body{margin:0;max-width:none;padding:0}}@page{margin:15mm}
)";

class Writer {
 public:
  Writer(const Pattern& pattern, const SewingSheet& sheet)
      : pattern_(pattern), sheet_(sheet), out_(std::back_inserter(text_)) {}

  std::string write(std::string_view cover) {
    fmt::format_to(out_,
                   "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
                   "<title>Sewing: {0}</title>\n<style>{1}</style></head>\n<body>\n"
                   "<h1>{0}</h1>\n",
                   escaped(sheet_.title), kStyle);
    if (!cover.empty()) addCover(cover);
    addSummary();
    addFabrics();
    addPieces();
    addSteps();
    addContract();
    return std::move(text_) + "</body></html>\n";
  }

 private:
  void addCover(std::string_view png) {
    const std::unique_ptr<char, decltype(&g_free)> text(
        g_base64_encode(reinterpret_cast<const guchar*>(png.data()), png.size()), &g_free);
    fmt::format_to(out_,
                   "<img class=\"cover\" alt=\"The finished thing and its pieces\" "
                   "src=\"data:image/png;base64,{}\">\n",
                   text.get());
  }

  void addSummary() {
    int cut = 0;
    for (const PatternPiece& piece : pattern_.pieces) cut += piece.count;
    fmt::format_to(out_,
                   "<dl><div><dt>Pieces to cut</dt><dd>{}</dd></div><div><dt>Seams</dt>"
                   "<dd>{}</dd></div><div><dt>Length of all seams</dt><dd>{:.2f} m</dd></div>"
                   "<div><dt>Sewing, about</dt><dd>{}</dd></div></dl>\n",
                   cut, sheet_.plan.steps.size(), sheet_.plan.totalLength / 1000,
                   describeMinutes(sheet_.plan.minutes));
  }

  void addFabrics() {
    text_ +=
        "<h2>Fabrics</h2>\n<table><thead><tr><th>Fabric</th><th class=\"n\">Pieces</th>"
        "<th class=\"n\">Area cut</th></tr></thead><tbody>\n";
    for (const FabricUse& use : sheet_.fabrics)
      fmt::format_to(
          out_, "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{:.3f} m\u00b2</td></tr>\n",
          use.name.empty() ? "not named" : escaped(use.name), use.pieces, use.area / 1e6);
    text_ += "</tbody></table>\n";
  }

  /// Areas as one path, y down.
  static std::string way(const BodyView& view, const std::vector<Points2>& loops) {
    std::string path;
    for (const Points2& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i)
        path += fmt::format("{}{} {}",
                            i == 0   ? "M"
                            : i == 1 ? "L"
                                     : " ",
                            std::lround(loop[i].x()), std::lround(view.size.y() - loop[i].y()));
      path += "Z";
    }
    return path;
  }

  /// What all figures of a view share: the model below the piece, shade and lines above it.
  void addView(std::size_t number) {
    const BodyView& view = sheet_.body.views[number];
    fmt::format_to(out_, "<path id=\"body{}\" class=\"body\" d=\"{}\"/>\n<g id=\"over{}\">", number,
                   way(view, view.body), number);
    for (const std::vector<Points2>* shade : {&view.shade, &view.deepShade})
      fmt::format_to(out_, "<path class=\"shade\" d=\"{}\"/>", way(view, *shade));
    text_ += "<path class=\"seams\" d=\"";
    for (const std::vector<Points2>& loops : view.pieces) text_ += way(view, loops);
    text_ += "\"/></g>\n";
  }

  void addPieces() {
    text_ += "<h2>Pieces and where they sit</h2>\n<svg width=\"0\" height=\"0\"><defs>\n";
    for (std::size_t v = 0; v < sheet_.body.views.size(); ++v) addView(v);
    text_ += "</defs></svg>\n<div class=\"pieces\">\n";
    for (std::size_t i = 0; i < pattern_.pieces.size(); ++i) {
      const PatternPiece& piece = pattern_.pieces[i];
      const std::size_t v = sheet_.body.viewOf[i];
      const BodyView& view = sheet_.body.views[v];
      fmt::format_to(out_,
                     "<figure><svg viewBox=\"0 0 {} {}\"><use href=\"#body{}\"/>"
                     "<path class=\"own\" d=\"{}\"/><use href=\"#over{}\"/></svg>",
                     view.size.x(), view.size.y(), v, way(view, view.pieces[i]), v);
      fmt::format_to(out_,
                     "<figcaption><b>{}  {}</b>cut {}{}<br>{:.0f} cm\u00b2, outline {:.0f} "
                     "mm<br><span class=\"second\">seen from {}</span></figcaption></figure>\n",
                     piece.number, escaped(piece.name), piece.count,
                     piece.fabric.empty() ? "" : ", " + escaped(piece.fabric), sheet_.area[i] / 100,
                     sheet_.length[i], view.from);
    }
    text_ += "</div>\n";
  }

  void addSteps() {
    text_ +=
        "<h2>Order of sewing</h2>\n<p class=\"second\">Each edge has its code on the pattern: 3C "
        "is edge C of piece 3. Lay the two edges of a step together, notch on notch, and sew. The "
        "time is an estimate.</p>\n<table><thead><tr><th></th><th>Edges</th><th>Seam</th>"
        "<th>Pieces</th><th>How</th><th class=\"n\">Lengths</th><th class=\"n\">Time</th></tr>"
        "</thead><tbody>\n";
    for (std::size_t s = 0; s < sheet_.plan.steps.size(); ++s) {
      const SewStep& step = sheet_.plan.steps[s];
      const SewEdge& a = sheet_.plan.edges[step.edgeA];
      const SewEdge& b = sheet_.plan.edges[step.edgeB];
      const std::string pieces = a.piece == b.piece
                                     ? escaped(pattern_.pieces[a.piece].name)
                                     : escaped(pattern_.pieces[a.piece].name) + " to " +
                                           escaped(pattern_.pieces[b.piece].name);
      fmt::format_to(out_,
                     "<tr><td class=\"n\">{}</td><td class=\"code\">{} + {}</td><td>{}</td>"
                     "<td>{}</td><td>{}</td><td class=\"n\">{:.1f} + {:.1f} mm</td>"
                     "<td class=\"n\">{:.0f} min</td></tr>\n",
                     s + 1, a.code, b.code, escaped(curveName(pattern_, a.curve)), pieces,
                     describe(step.kind), a.length, b.length, step.minutes);
    }
    text_ += "</tbody></table>\n";
  }

  void addContract() {
    fmt::format_to(
        out_,
        "<h2>Length contract</h2>\n<p class=\"second\">Lengths in mm: on the body, wanted (with "
        "ease), on the pattern, of the mate, and by how much the pattern differs from its mate or "
        "from what is wanted. Inputs {}</p>\n<table><thead><tr><th>Piece</th><th>Edge</th>"
        "<th>Line</th><th>Rule</th><th class=\"n\">Body</th><th class=\"n\">Wanted</th>"
        "<th class=\"n\">Pattern</th><th class=\"n\">Mate</th><th class=\"n\">Difference</th></tr>"
        "</thead><tbody>\n",
        sheet_.inputs);
    for (const LengthLine& line : sheet_.contract) {
      const bool isFree = line.rule == LengthRule::Free;
      const auto length = [](double mm, bool isShown) {
        return isShown ? fmt::format("{:.2f}", mm) : std::string();
      };
      const double difference = std::abs(line.difference) < 5e-4 ? 0 : line.difference;
      fmt::format_to(out_,
                     "<tr><td>{}</td><td class=\"code\">{}</td><td>{}</td><td>{}</td>"
                     "<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
                     "<td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
                     escaped(line.piece), line.edge, escaped(line.name), toString(line.rule),
                     length(line.body, !isFree), length(line.target, !isFree),
                     length(line.pattern, true), length(line.mate, !line.matePiece.empty()),
                     isFree ? "" : fmt::format("{:.3f}", difference));
    }
    text_ += "</tbody></table>\n";
  }

  const Pattern& pattern_;
  const SewingSheet& sheet_;
  std::string text_;
  std::back_insert_iterator<std::string> out_;
};

}  // namespace

std::string writeSewingHtml(const Pattern& pattern, const SewingSheet& sheet,
                            std::string_view coverPng) {
  return Writer(pattern, sheet).write(coverPng);
}

std::string writeSewingHtml(const Pattern& pattern, std::string_view coverPng) {
  return writeSewingHtml(pattern, sewingSheet(pattern), coverPng);
}

}  // namespace toile

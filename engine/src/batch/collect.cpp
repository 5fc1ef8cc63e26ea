// SPDX-License-Identifier: GPL-3.0-or-later
// The overview of a batch: a table for programs, a page for people.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "batch/outcome.h"
#include "io/markup.h"
#include "toile/batch/batch.h"
#include "toile/core/file.h"

namespace toile {

namespace {

namespace fs = std::filesystem;

/// A cell of a comma separated table.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + '"';
}

std::string summaryOf(const std::vector<OrderOutcome>& outcomes) {
  std::set<std::string> names;
  for (const OrderOutcome& outcome : outcomes) {
    for (const auto& [name, mm] : outcome.measures) names.insert(name);
  }
  std::string text =
      "name,status,attention,reason,fit_mean_mm,fit_95_mm,missing_percent,pieces,"
      "worst_area_error_percent,worst_piece,findings";
  for (const std::string& name : names) text += "," + cell(name + "_mm");
  text += "\n";
  const auto out = std::back_inserter(text);
  for (const OrderOutcome& o : outcomes) {
    fmt::format_to(out, "{},{},{:.0f},{},", cell(o.name), o.status, o.attention, cell(o.reason));
    if (o.isFitted) {
      fmt::format_to(out, "{:.2f},{:.2f},{:.1f},", o.fitMean, o.fit95, 100 * o.missingShare);
    } else {
      text += ",,,";
    }
    fmt::format_to(out, "{},{:.2f},{},{}", o.pieces, 100 * o.worstAreaError, cell(o.worstPiece),
                   o.findings.size());
    for (const std::string& name : names) {
      const auto found = o.measures.find(name);
      text += found == o.measures.end() ? "," : fmt::format(",{:.1f}", found->second);
    }
    text += "\n";
  }
  return text;
}

/// A path in a link: what is not plain is written as its bytes.
std::string link(const std::string& path) {
  std::string text;
  for (const char c : path) {
    const bool isPlain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                         (c >= 'A' && c <= 'Z') || c == '-' || c == '_' || c == '.' || c == '/';
    text += isPlain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:1100px;padding:0 1em;color:#222}
h1{font-size:1.5em;font-weight:600} .sum{color:#555}
.order{display:flex;gap:1.2em;border-top:1px solid #ddd;padding:1em 0}
.order img,.none{width:240px;height:150px;object-fit:contain;background:#f4f4f2;flex:none}
.none{display:flex;align-items:center;justify-content:center;color:#999}
h2{font-size:1.1em;margin:0 0 .3em} h2 a{color:inherit}
.mark{font-size:.8em;padding:.1em .5em;border-radius:.6em;margin-left:.6em;color:#fff}
.done{background:#3a7d44}.incomplete{background:#b26a00}.failed{background:#a62b2b}.open{background:#777}
ul{margin:.4em 0;padding-left:1.2em} details{margin-top:.4em} td{padding:0 1em 0 0}
</style>
)";

void writeOrder(std::string& text, const OrderOutcome& o, bool hasFiles) {
  const auto out = std::back_inserter(text);
  text += "<div class=\"order\">";
  if (hasFiles) {
    fmt::format_to(out,
                   "<a href=\"{0}/report.html\"><img src=\"{0}/thumb.png\" loading=\"lazy\" "
                   "alt=\"the pattern\"></a>",
                   link(o.name));
  } else {
    text += "<div class=\"none\">no pattern</div>";
  }
  text += "<div><h2>";
  if (hasFiles) {
    fmt::format_to(out, "<a href=\"{}/report.html\">{}</a>", link(o.name), escaped(o.name));
  } else {
    text += escaped(o.name);
  }
  fmt::format_to(out, "<span class=\"mark {0}\">{0}</span></h2>", o.status);
  if (!o.reason.empty()) fmt::format_to(out, "<p>{}</p>", escaped(o.reason));
  if (o.status == "done" || o.status == "incomplete") {
    fmt::format_to(out, "<div>{} pieces; worst strain {:.1f} % mean area error{}", o.pieces,
                   100 * o.worstAreaError,
                   o.worstPiece.empty() ? "" : " (" + escaped(o.worstPiece) + ")");
    if (o.isFitted) {
      fmt::format_to(out,
                     "; scan to body {:.2f} mm on average, 95 % within {:.2f} mm, {:.1f} % of the "
                     "body not on the scan",
                     o.fitMean, o.fit95, 100 * o.missingShare);
    }
    fmt::format_to(out, "; attention {:.0f}</div>", o.attention);
  }
  if (!o.findings.empty()) {
    text += "<ul>";
    for (const Finding& finding : o.findings) {
      fmt::format_to(out, "<li>{}</li>", escaped(finding.message));
    }
    text += "</ul>";
  }
  if (!o.measures.empty()) {
    text += "<details><summary>measures</summary><table>";
    for (const auto& [name, mm] : o.measures) {
      fmt::format_to(out, "<tr><td>{}</td><td>{:.0f} mm</td></tr>", escaped(name), mm);
    }
    text += "</table></details>";
  }
  text += "</div></div>\n";
}

std::string pageOf(const std::string& design, std::vector<OrderOutcome> outcomes,
                   const fs::path& folder) {
  std::stable_sort(outcomes.begin(), outcomes.end(),
                   [](const auto& a, const auto& b) { return a.attention > b.attention; });
  std::map<std::string, std::size_t> counts;
  for (const OrderOutcome& outcome : outcomes) ++counts[outcome.status];
  std::string text = kHead;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "<title>{0}</title></head><body>\n<h1>{0}</h1>\n<p class=\"sum\">{1} orders",
                 escaped(design), outcomes.size());
  for (const char* status : {"done", "incomplete", "failed", "open"}) {
    if (counts[status] > 0) fmt::format_to(out, ", {} {}", counts[status], status);
  }
  text += ". What needs a look most comes first. <a href=\"summary.csv\">summary.csv</a></p>\n";
  for (const OrderOutcome& outcome : outcomes) {
    std::error_code ignored;
    writeOrder(text, outcome, fs::exists(folder / outcome.name / "thumb.png", ignored));
  }
  text += "</body></html>\n";
  return text;
}

}  // namespace

Result<std::size_t> collectOrders(const fs::path& design, const std::vector<BatchOrder>& orders,
                                  const fs::path& out) {
  std::vector<OrderOutcome> outcomes;
  std::size_t open = 0;
  for (const BatchOrder& order : orders) {
    std::optional<OrderOutcome> outcome = findOutcome(design, order, out);
    if (!outcome) {
      outcome.emplace();
      outcome->name = order.name;
      outcome->status = "open";
      outcome->attention = 95;
    }
    if (outcome->status != "done") ++open;
    outcomes.push_back(*std::move(outcome));
  }
  if (const auto made = makeFolder(out); !made) return made.error();
  if (const auto done = writeFileWhole(out / "summary.csv", summaryOf(outcomes)); !done) {
    return done.error();
  }
  const std::string page = pageOf(design.stem().string(), std::move(outcomes), out);
  if (const auto done = writeFileWhole(out / "index.html", page); !done) return done.error();
  return open;
}

}  // namespace toile

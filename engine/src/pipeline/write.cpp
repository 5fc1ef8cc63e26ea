// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <functional>
#include <iterator>
#include <utility>

#include "io/file_set.h"
#include "toile/core/parallel.h"
#include "toile/io/dxf.h"
#include "toile/io/pdf.h"
#include "toile/io/render.h"
#include "toile/io/report.h"
#include "toile/io/svg.h"
#include "toile/pipeline.h"

namespace toile {
namespace {

struct Product {
  std::string name;  ///< below the folder
  std::string purpose;
  std::function<Result<std::string>()> make;
};

std::vector<Product> productsOf(const Pattern& pattern,
                                const std::vector<std::optional<PieceStrain>>& strains,
                                Progress* progress) {
  std::vector<Product> products = {
      {"preview.png", "picture: the model with its lines, the pieces beside it",
       [&, progress] { return renderPattern(pattern, {}, progress); }},
      {"pattern.pdf", "the pieces at 1:1, to print", [&] { return writePdf(pattern); }},
      {"report.html", "every piece, every seam length, findings, for the browser",
       [&] { return Result<std::string>(writeReportHtml(pattern)); }},
      {"report.json", "the same report for programs",
       [&] { return Result<std::string>(writeReportJson(pattern)); }},
      {"pattern.svg", "the pieces as vector drawing",
       [&] { return Result<std::string>(writeSvg(pattern)); }},
      {"strain.svg", "the same drawing over colours of how much the cloth must give",
       [&] { return Result<std::string>(writeStrainSvg(pattern)); }},
  };
  const std::vector<std::string> names = pieceFileNames(pattern.cut);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!strains[i]) continue;
    products.push_back({"pieces/" + names[i], "this piece in 3D and flat, with its lines", [&, i] {
                          return Result<std::string>(writePieceObj(
                              pattern.cut.pieces[i], *pattern.flats[i], &*strains[i]));
                        }});
    products.push_back(
        {"pieces/" + plyFileName(names[i]), "the same with its strain per face, to plot", [&, i] {
           return Result<std::string>(
               writePiecePly(pattern.cut.pieces[i], *pattern.flats[i], *strains[i]));
         }});
  }
  return products;
}

}  // namespace

Result<WrittenPattern> writePattern(const Pattern& pattern, const std::filesystem::path& folder,
                                    Progress* progress) {
  if (progress != nullptr) progress->step("draw the picture, write the files");
  // What the DXF writer has to say belongs into the reports.
  const DxfFile dxf = writeDxf(pattern);
  Pattern told = pattern;
  told.findings.insert(told.findings.end(), dxf.findings.begin(), dxf.findings.end());

  const std::vector<std::optional<PieceStrain>> strains = measureStrains(told);
  const std::vector<Product> products = productsOf(told, strains, progress);
  std::vector<Result<std::string>> contents(products.size(), std::string());
  parallelFor(products.size(), [&](std::size_t i) { contents[i] = products[i].make(); });
  if (isCancelled(progress)) {
    return Error{ErrorCode::Cancelled, "stopped before the end; nothing was written", {}};
  }

  WrittenPattern written;
  FileSet files;
  files.add("pattern.dxf", dxf.text);
  written.files.push_back({folder / "pattern.dxf", "cutting file for CAD and cutting machines"});
  for (std::size_t i = 0; i < products.size(); ++i) {
    if (!contents[i]) return contents[i].error().during(products[i].name);
    files.add(products[i].name, std::move(*contents[i]));
    written.files.push_back({folder / products[i].name, products[i].purpose});
  }
  const Result<void> done = files.write(folder, reportedFiles(folder / "report.json"));
  if (!done) return done.error();
  written.findings = std::move(told.findings);
  return written;
}

}  // namespace toile

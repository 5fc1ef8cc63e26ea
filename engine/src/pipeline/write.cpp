// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <functional>
#include <iterator>
#include <utility>

#include "io/file_set.h"
#include "io/sewing_sheet.h"
#include "toile/core/parallel.h"
#include "toile/io/dxf.h"
#include "toile/io/pdf.h"
#include "toile/io/report.h"
#include "toile/io/sewing_files.h"
#include "toile/io/svg.h"
#include "toile/pipeline.h"
#include "toile/render/render.h"

namespace toile {
namespace {

struct Product {
  std::string name;  ///< below the folder
  std::string purpose;
  std::function<Result<std::string>()> make;
};

/// The sewing sheet, for the browser and to print.
struct SewingFiles {
  std::string page;
  Result<std::string> print = std::string();
};

/// @param cover  the picture that it begins with, a PNG; empty for none
SewingFiles makeSewing(const Pattern& pattern, const std::string& cover) {
  const SewingSheet sheet = sewingSheet(pattern);
  SewingFiles files;
  parallelFor(2, [&](std::size_t i) {
    if (i == 0) {
      files.print = writeSewingPdf(pattern, sheet, cover);
    } else {
      files.page = writeSewingHtml(pattern, sheet, cover);
    }
  });
  return files;
}

/// The pattern with symmetric pieces as halves on folded cloth where the design wants that.
Pattern asCut(const Pattern& pattern) {
  Pattern cutting = pattern;
  if (!pattern.document.design->finish.halfOnFold) return cutting;
  for (std::size_t i = 0; i < cutting.pieces.size(); ++i) {
    const std::uint32_t index = pattern.pieceIndex[i];
    foldInHalf(cutting.pieces[i], pattern.cut.pieces[index], *pattern.flats[index]);
  }
  return cutting;
}

/// Which of the products is the picture; it takes longest and the sewing sheet waits for it.
constexpr std::size_t kPicture = 0;

std::vector<Product> productsOf(const Pattern& pattern, const Pattern& cutting,
                                const SheetDrawing& sheet,
                                const std::vector<std::optional<PieceStrain>>& strains,
                                const WriteOptions& options, Progress* progress) {
  std::vector<Product> products = {
      {"preview.png", "picture: the model with its lines, the pieces beside it",
       [&, progress] { return renderPattern(pattern, {.trim = true}, progress); }},
      {"pattern.pdf", "the pieces at 1:1, to print", [&] { return writePdf(sheet, options.pdf); }},
      {"report.html", "every piece, every seam length, findings, for the browser",
       [&] { return Result<std::string>(writeReportHtml(pattern)); }},
      {"report.json", "the same report for programs",
       [&] { return Result<std::string>(writeReportJson(pattern)); }},
      {"pattern.svg", "the pieces as vector drawing",
       [&] { return Result<std::string>(writeSvg(sheet)); }},
      {"strain.svg", "the same drawing over colours of how much the cloth must give",
       [&] { return Result<std::string>(writeStrainSvg(pattern)); }},
      {"laser.dxf", "plain lines for a laser: cut red, mark blue, engrave green",
       [&] {
         const bool isWhole = !pattern.document.design->finish.halfOnFold;
         return Result<std::string>(writeLaserDxf(isWhole ? sheet : drawSheet(pattern)));
       }},
      {"pattern.plt", "HPGL for plotters", [&] { return writeHpgl(sheet, options.hpgl); }},
      {"seams.json", "which edge is sewn to which, for programs",
       [&] { return Result<std::string>(writeSeamsJson(cutting)); }},
      {"lengths.csv", "the length contract: every line on the body, the pattern, its mate",
       [&] { return Result<std::string>(writeLengthsCsv(pattern)); }},
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
                                    Progress* progress, const WriteOptions& options) {
  if (progress != nullptr) progress->step("draw the picture, write the files");
  // What is cut may be halves; reports and the sewing sheet tell of whole pieces.
  const Pattern cutting = asCut(pattern);
  // What the DXF writer has to say belongs into the reports.
  const DxfFile dxf = writeDxf(cutting, options.dxf);
  Pattern told = pattern;
  told.findings.insert(told.findings.end(), dxf.findings.begin(), dxf.findings.end());

  const std::vector<std::optional<PieceStrain>> strains = measureStrains(told);
  const SheetDrawing sheet = drawSheet(cutting);
  const std::vector<Product> products =
      productsOf(told, cutting, sheet, strains, options, progress);
  std::vector<Result<std::string>> contents(products.size(), std::string());
  SewingFiles sewing;
  parallelFor(products.size(), [&](std::size_t i) {
    contents[i] = products[i].make();
    if (i != kPicture || isCancelled(progress)) return;
    sewing = makeSewing(told, contents[i] ? *contents[i] : std::string());
  });
  if (isCancelled(progress)) {
    return Error{ErrorCode::Cancelled, "stopped before the end; nothing was written", {}};
  }
  if (!sewing.print) return sewing.print.error().during("sewing.pdf");

  WrittenPattern written;
  FileSet files;
  files.add("pattern.dxf", dxf.text);
  written.files.push_back({folder / "pattern.dxf", "cutting file for CAD and cutting machines"});
  files.add("sewing.html", std::move(sewing.page));
  written.files.push_back({folder / "sewing.html", "what to sew in which order, for the browser"});
  files.add("sewing.pdf", *std::move(sewing.print));
  written.files.push_back({folder / "sewing.pdf", "the same to print"});
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

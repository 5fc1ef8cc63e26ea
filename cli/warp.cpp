// SPDX-License-Identifier: GPL-3.0-or-later
// `toile warp`: what stands around one body, around another.
#include "toile/warp/warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "commands.h"
#include "design_files.h"
#include "terminal_progress.h"
#include "toile/core/file.h"
#include "toile/cut/cut.h"
#include "toile/mesh/mesh_file.h"
#include "toile/pipeline.h"
#include "toile/pipeline/carry.h"
#include "toile/shape/builtin.h"
#include "warp_words.h"

namespace toile::cli {
namespace {

struct Arguments {
  std::string product, from, to;
  std::filesystem::path out;
  std::optional<std::filesystem::path> reportFile;
  std::vector<GirthWord> girths;
  std::vector<RigidWord> rigid;
  Length leastEase;
  CarryOptions carry;
  bool isKept = false;
};

Result<ReferenceModel> loadModel(const std::string& reference, std::optional<FileUnit> unit) {
  return isBuiltin(reference) ? makeBuiltinModel(reference) : readModel(reference, unit);
}

bool isDesign(const std::string& file) {
  return std::filesystem::path(file).extension() == ".toile";
}

/// What is warped: a model, with a design on it or without.
struct Product {
  std::optional<Document> document;
  std::shared_ptr<const ReferenceModel> model;
};

Result<Product> loadProduct(const Arguments& arguments, const Session& session) {
  Product product;
  if (isDesign(arguments.product)) {
    Result<Document> document = openDocument(arguments.product, std::nullopt, session.units);
    if (!document) return document.error();
    product.model = document->model;
    product.document = *std::move(document);
    return product;
  }
  Result<ReferenceModel> model = loadModel(arguments.product, session.units);
  if (!model) return model.error();
  product.model = std::make_shared<const ReferenceModel>(*std::move(model));
  return product;
}

/// The vertices of the faces that lie wholly in a piece of the product's design.
Result<std::vector<VertexId>> verticesOfPiece(const Product& product, const std::string& id) {
  if (!product.document) {
    return Error{ErrorCode::NameNotFound,
                 fmt::format("--rigid {}: the product has no design with pieces; give a design, or "
                             "a part of space such as z<20mm",
                             id),
                 {Element::piece(id)}};
  }
  const auto placed = placeCurves(*product.document->design, *product.document->model);
  if (!placed) return placed.error();
  const Result<CutResult> pieces = cut(*product.document, *placed);
  if (!pieces) return pieces.error();
  for (const Piece& piece : pieces->pieces) {
    if (piece.id != id) continue;
    std::vector<VertexId> vertices;
    for (std::size_t v = 0; v < piece.onModel.size(); ++v) {
      const auto* vertex = std::get_if<VertexId>(&piece.onModel[VertexId(v)].at);
      if (vertex != nullptr) vertices.push_back(*vertex);
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }
  return Error{ErrorCode::NameNotFound,
               fmt::format("--rigid {}: the design has no such piece", id),
               {Element::piece(id)}};
}

Result<WarpOptions> makeOptions(const Arguments& arguments, const Product& product,
                                const ReferenceModel& from) {
  WarpOptions options;
  options.leastEase = arguments.leastEase;
  for (const GirthWord& word : arguments.girths) {
    Result<WarpGirth> girth = findGirth(from, word);
    if (!girth) return girth.error();
    options.girths.push_back(*std::move(girth));
  }
  for (const RigidWord& word : arguments.rigid) {
    Result<std::vector<VertexId>> part = word.piece.empty()
                                             ? Result(verticesWithin(*product.model->mesh, word))
                                             : verticesOfPiece(product, word.piece);
    if (!part) return part.error();
    options.rigid.push_back(*std::move(part));
  }
  return options;
}

void print(const Warp& warp) {
  const WarpReport& r = warp.report;
  fmt::print("{}: {}\n", warp.product.name, r.isOk() ? "ok" : "FAILED");
  fmt::print(
      "  distance to the body changed by {:.2f} mm on average, 95 % by less than {:.2f} mm\n",
      r.meanEaseChange, r.easeChange95);
  fmt::print(
      "  {} folds, {} pairs of faces crossing ({} before), newly inside the body {:.2f} mm\n",
      r.folds, r.crossings, r.crossingsBefore, std::max(0.0, r.deeper));
  if (r.girths.empty()) return;
  fmt::print("{:<20} {:>18} {:>18} {:>16} {:>8}\n", "girth", "body mm", "product mm", "distance mm",
             "error mm");
  for (const WarpedGirth& girth : r.girths) {
    fmt::print("{:<20} {:8.1f} -> {:6.1f} {:8.1f} -> {:6.1f} {:6.1f} -> {:5.1f} {:9.3f}\n",
               girth.name, girth.bodyBefore, girth.bodyAfter, girth.productBefore,
               girth.productAfter, girth.easeBefore, girth.easeAfter, girth.largestError);
  }
}

Result<void> write(const Warp& warp, const Product& product, const Arguments& arguments,
                   std::vector<Finding>& findings) {
  if (product.document) {
    const auto model = std::make_shared<const ReferenceModel>(warp.product);
    Result<CarriedDesign> carried = carryToModel(*product.document, model, arguments.carry);
    if (!carried) return carried.error();
    findings.insert(findings.end(), carried->transfer.findings.begin(),
                    carried->transfer.findings.end());
    return writeDesignAndModel(carried->transfer.document, arguments.out);
  }
  if (arguments.out.string().ends_with(".model.json")) {
    std::filesystem::path base = arguments.out;
    const Result<std::string> written = writeModelBeside(warp.product, base.replace_extension());
    return written ? Result<void>() : written.error();
  }
  if (arguments.out.has_parent_path()) {
    if (auto done = makeFolder(arguments.out.parent_path()); !done) return done;
  }
  return writeFileWhole(arguments.out, arguments.out.extension() == ".obj"
                                           ? writeObj(*warp.product.mesh)
                                           : writePly(*warp.product.mesh));
}

int run(const Arguments& arguments, const Session& session) {
  TerminalProgress progress;
  const Result<Product> product = loadProduct(arguments, session);
  if (!product) return fail(product.error());
  if (product->document && !isDesign(arguments.out.string())) {
    return fail({ErrorCode::InvalidArgument,
                 "the product is a design; -o must name a .toile file, too",
                 {}});
  }
  const Result<ReferenceModel> from = loadModel(arguments.from, session.units);
  if (!from) return fail(from.error());
  const Result<ReferenceModel> to = loadModel(arguments.to, session.units);
  if (!to) return fail(to.error());
  const Result<WarpOptions> options = makeOptions(arguments, *product, *from);
  if (!options) return fail(options.error());
  const Result<MappedModels> mapped = mapToModel(*from, *to, arguments.carry.fit, &progress);
  if (!mapped) return fail(mapped.error());
  Result<Warp> warp = warpProduct(*product->model, *from, *to, mapped->map, *options, &progress);
  if (!warp) return fail(warp.error());

  const bool isGood = warp->report.isOk();
  std::vector<Finding> findings = warp->report.findings;
  if (isGood || arguments.isKept) {
    if (const auto done = write(*warp, *product, arguments, findings); !done) {
      return fail(done.error());
    }
  }
  const std::string reportText = writeWarpReport(*warp);
  if (arguments.reportFile) {
    if (const auto done = writeFileWhole(*arguments.reportFile, reportText); !done) {
      return fail(done.error());
    }
  }
  if (session.json) {
    std::fputs(reportText.c_str(), stdout);
  } else {
    print(*warp);
  }
  for (const Finding& reason : warp->report.reasons) {
    fmt::print(stderr, "toile: {}: {} [{}]\n", arguments.product, reason.message, reason.code);
  }
  const int status = report(findings, session);
  if (isGood) return status;
  if (!arguments.isKept) {
    fmt::print(stderr, "toile: {} is not written; --keep-failed writes it all the same\n",
               arguments.out.string());
  }
  return kFailed;
}

}  // namespace

void addWarp(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(app, session, "warp", "What stands around one body, around another",
                 [arguments, &session] { return run(*arguments, session); });
  command
      ->add_option("PRODUCT", arguments->product,
                   "A last, a dress block: a mesh file, a .model.json, or a design on one")
      ->required();
  command->add_option("--from", arguments->from, "The body that it stands around")
      ->type_name("MODEL")
      ->required();
  command->add_option("--to", arguments->to, "The other body, of any connectivity")
      ->type_name("MODEL")
      ->required();
  command
      ->add_option("-o,--output", arguments->out,
                   "PLY, OBJ or .model.json file for the product; a .toile file for a design")
      ->type_name("FILE")
      ->required();
  command->add_option("--report", arguments->reportFile, "JSON file for the report")
      ->type_name("FILE");
  addParsedList(
      *command, "--girth", arguments->girths, parseGirthWord,
      "A line round the first body at which the distance is kept: NAME of a curve of it, "
      "or NAME:z=900mm, or NAME:through=PLACE/PLACE/PLACE (landmarks or x,y,z in mm); with "
      ":ease=20mm it is set; may be given often")
      ->type_name("GIRTH");
  addParsedList(*command, "--rigid", arguments->rigid, parseRigidWord,
                "A part that keeps its shape: a piece of the product's design, or a part of space "
                "such as z<20mm,y>-60mm; may be given often")
      ->type_name("PART");
  addParsed(*command, "--least-ease", arguments->leastEase, parseLength,
            "The product comes no nearer to the body than this (default 0mm)")
      ->type_name("LENGTH");
  command->add_flag("--keep-failed", arguments->isKept,
                    "Write the product even when something stands against it");
}

}  // namespace toile::cli

// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/model/reference_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/names.h"
#include "toile/core/file.h"
#include "toile/mesh/mesh_file.h"
#include "toile/model/guiding_map.h"

namespace toile {
namespace {

using detail::Json;

constexpr int kModelFormatVersion = 1;
constexpr std::size_t kMaxModelBytes = std::size_t{256} << 20;
/// How far a vertex of a symmetric model may lie beside its partner's mirror image: files with
/// six decimals of a metre and float positions stay below.
constexpr double kMirrorTolerance = 0.01;

/// The mirror plane x = 0 that models stand across (docs/file-format.md), or what landmarks say.
std::optional<Symmetry> findSymmetry(const Mesh& mesh,
                                     const std::map<std::string, SurfacePoint>& landmarks) {
  const Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  if (auto partner = findSymmetryPairing(mesh, normal, 0, kMirrorTolerance)) {
    return Symmetry{normal, 0, std::move(*partner)};
  }
  if (auto partner = findSymmetryPairing(mesh, landmarks)) {
    return makeSymmetry(mesh, std::move(*partner));
  }
  return std::nullopt;
}

class ModelReader {
 public:
  ModelReader(const std::filesystem::path& path, std::optional<FileUnit> unit)
      : path_(path), file_(path.string()), unit_(unit) {}

  Result<ReferenceModel> read() {
    const Result<std::string> text = readFile(path_, kMaxModelBytes);
    if (!text) return text.error();
    Result<Json> json = detail::parseJson(*text, file_);
    if (!json) return json.error();
    json_ = std::move(*json);
    if (Result<void> done = checkVersion(); !done) return done.error();

    Result<std::string> mesh = string("mesh");
    if (!mesh) return mesh.error();
    if (mesh->empty()) return fail("\"mesh\" is missing: the path of the mesh file");
    if (Result<void> done = readUnit(); !done) return done.error();
    Result<MeshFile> read = readMesh(path_.parent_path() / *mesh, {.unit = unit_});
    if (!read) return read.error();

    Result<std::string> name = string("name");
    if (!name) return name.error();
    if (name->empty()) *name = path_.stem().stem().string();
    ReferenceModel model = makeReferenceModel(std::move(*name), std::move(read->mesh));
    model.reference = file_;
    model.findings = std::move(read->findings);
    if (Result<void> done = readNames(model); !done) return done.error();
    if (Result<void> done = readSymmetry(model); !done) return done.error();
    if (const auto map = json_.find("guidingMap"); map != json_.end()) {
      auto given = readPart(*map, "guidingMap", [&](const Json& part, const std::string& file) {
        return detail::readGuidingMap(model, part, file);
      });
      if (!given) return given.error();
      model.map = std::make_shared<GuidingMapSlot>(*std::move(given));
    }
    return model;
  }

 private:
  Error fail(std::string_view what) const {
    return {ErrorCode::FileFormat, fmt::format("{}: {}", file_, what), {}};
  }

  Result<void> checkVersion() const {
    const auto version = json_.is_object() ? json_.find("toile-model") : json_.end();
    if (version == json_.end() || !version->is_number_unsigned()) {
      return fail("this is no model file: \"toile-model\" with its version is missing");
    }
    if (version->get<std::uint64_t>() != kModelFormatVersion) {
      return fail(fmt::format("version {} of the format; this Toile reads version {}",
                              version->dump(), kModelFormatVersion));
    }
    return {};
  }

  /// The text under the key; empty when it is not there.
  Result<std::string> string(const char* key) const {
    const auto value = json_.find(key);
    if (value == json_.end()) return std::string();
    if (!value->is_string()) return fail(fmt::format("\"{}\" is no text", key));
    return value->get<std::string>();
  }

  Result<void> readUnit() {
    const Result<std::string> text = string("units");
    if (!text) return text.error();
    if (text->empty()) return {};
    const Result<FileUnit> unit = parseFileUnit(*text);
    if (!unit) return fail(unit.error().message);
    if (unit_ && *unit_ != *unit) {
      return Error{ErrorCode::InvalidArgument,
                   fmt::format("{}: its unit is {}, --units says {}; leave out --units", file_,
                               toString(*unit), toString(*unit_)),
                   {}};
    }
    unit_ = *unit;
    return {};
  }

  Result<void> readNames(ReferenceModel& model) const {
    const Mesh& mesh = *model.mesh;
    if (const auto curves = json_.find("curves"); curves != json_.end()) {
      auto read = readPart(*curves, "curves", [&](const Json& json, const std::string& file) {
        return detail::readCurves(mesh, json, file);
      });
      if (!read) return read.error();
      model.curves = std::move(*read);
    }
    if (const auto landmarks = json_.find("landmarks"); landmarks != json_.end()) {
      auto read = readPart(*landmarks, "landmarks", [&](const Json& json, const std::string& file) {
        return detail::readLandmarks(mesh, json, file);
      });
      if (!read) return read.error();
      model.landmarks = std::move(*read);
    }
    return {};
  }

  /// A part stands in the model file, or in a file of its own that is named there.
  template <class Read>
  std::invoke_result_t<Read, const Json&, const std::string&> readPart(const Json& part,
                                                                       const char* key,
                                                                       const Read& read) const {
    if (part.is_object()) {
      Json whole = Json::object();
      whole[key] = part;
      return read(whole, file_);
    }
    if (!part.is_string()) {
      return fail(fmt::format("\"{}\" is neither an object nor the path of a file", key));
    }
    const std::filesystem::path path = path_.parent_path() / part.get<std::string>();
    const Result<std::string> text = readFile(path, kMaxModelBytes);
    if (!text) return text.error();
    const Result<Json> json = detail::parseJson(*text, path.string());
    if (!json) return json.error();
    return read(*json, path.string());
  }

  Result<void> readSymmetry(ReferenceModel& model) const {
    const auto symmetry = json_.find("symmetry");
    if (symmetry == json_.end()) {
      model.symmetry = findSymmetry(*model.mesh, model.landmarks);
      return {};
    }
    if (symmetry->is_null()) return {};
    if (!symmetry->is_object()) return fail("\"symmetry\" is neither an object nor null");
    Result<VertexData<VertexId>> pairing = readPairing(*symmetry, model);
    if (!pairing) return pairing.error();
    return readPlane(*symmetry, std::move(*pairing), model);
  }

  /// The list of partners, checked; empty when there is none.
  Result<VertexData<VertexId>> readPairing(const Json& symmetry,
                                           const ReferenceModel& model) const {
    VertexData<VertexId> partner;
    const auto list = symmetry.find("partner");
    if (list == symmetry.end()) return partner;
    const std::size_t count = model.mesh->vertexCount();
    if (!list->is_array() || list->size() != count) {
      return fail(fmt::format("symmetry: \"partner\" needs one vertex for each of the {}", count));
    }
    partner = VertexData<VertexId>(count);
    for (std::size_t v = 0; v < count; ++v) {
      const Json& other = (*list)[v];
      if (!other.is_number_unsigned() || other.get<std::uint64_t>() >= count) {
        return fail(fmt::format("symmetry: the partner of vertex {} is no vertex", v));
      }
      partner[VertexId(v)] = VertexId(other.get<std::uint64_t>());
    }
    for (std::size_t v = 0; v < count; ++v) {
      if (partner[partner[VertexId(v)]] == VertexId(v)) continue;
      return Error{ErrorCode::FileFormat,
                   fmt::format("{}: symmetry: vertex {} is not its partner's partner", file_, v),
                   {Element::vertex(VertexId(v))}};
    }
    return partner;
  }

  Result<void> readPlane(const Json& symmetry, VertexData<VertexId> partner,
                         ReferenceModel& model) const {
    const auto normal = symmetry.find("normal");
    const auto offset = symmetry.find("offset");
    if (normal == symmetry.end() && offset == symmetry.end()) {
      if (partner.empty()) return fail("symmetry: give \"partner\", or \"normal\" and \"offset\"");
      model.symmetry = makeSymmetry(*model.mesh, std::move(partner));
      return {};
    }
    const auto isNumber = [](const Json& value) { return value.is_number(); };
    if (normal == symmetry.end() || !normal->is_array() || normal->size() != 3 ||
        !std::all_of(normal->begin(), normal->end(), isNumber) ||
        (offset != symmetry.end() && !offset->is_number())) {
      return fail("symmetry: \"normal\" needs 3 numbers, \"offset\" one");
    }
    Eigen::Vector3d direction((*normal)[0].get<double>(), (*normal)[1].get<double>(),
                              (*normal)[2].get<double>());
    const double length = direction.norm();
    if (!(length > 0) || !std::isfinite(length)) return fail("symmetry: \"normal\" is zero");
    Symmetry made;
    made.normal = direction / length;
    made.offset = offset == symmetry.end() ? 0.0 : offset->get<double>();
    if (partner.empty()) {
      if (auto found =
              findSymmetryPairing(*model.mesh, made.normal, made.offset, kMirrorTolerance)) {
        partner = std::move(*found);
      } else if (auto named = findSymmetryPairing(*model.mesh, model.landmarks)) {
        partner = std::move(*named);
      }
    }
    made.partner = std::move(partner);
    model.symmetry = std::move(made);
    return {};
  }

  const std::filesystem::path& path_;
  const std::string file_;
  std::optional<FileUnit> unit_;
  Json json_;
};

bool isModelFile(const std::filesystem::path& path) {
  return path.filename().string().ends_with(".json");
}

}  // namespace

ReferenceModel makeReferenceModel(std::string name, Mesh mesh) {
  ReferenceModel model;
  model.name = std::move(name);
  model.reference = model.name;
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.index = std::make_shared<const SurfaceIndex>(model.mesh);
  model.map = std::make_shared<GuidingMapSlot>();
  return model;
}

Result<ReferenceModel> readModel(const std::filesystem::path& path, std::optional<FileUnit> unit) {
  if (isModelFile(path)) return ModelReader(path, unit).read();
  Result<MeshFile> read = readMesh(path, {.unit = unit});
  if (!read) return read.error();
  ReferenceModel model = makeReferenceModel(path.stem().string(), std::move(read->mesh));
  model.reference = path.string();
  model.findings = std::move(read->findings);
  model.symmetry = findSymmetry(*model.mesh, model.landmarks);
  return model;
}

Result<ReferenceModel> withMesh(const ReferenceModel& names, std::string name, Mesh mesh) {
  if (mesh.connectivityHash() != names.mesh->connectivityHash()) {
    return Error{ErrorCode::ModelMismatch,
                 fmt::format("{} has {} vertices and {} triangles, joined otherwise than those of "
                             "{} ({} and {}); its curves and landmarks do not fit",
                             name, mesh.vertexCount(), mesh.faceCount(), names.name,
                             names.mesh->vertexCount(), names.mesh->faceCount()),
                 {}};
  }
  ReferenceModel model = makeReferenceModel(std::move(name), std::move(mesh));
  model.curves = names.curves;
  model.landmarks = names.landmarks;
  if (names.symmetry) {
    // The pairing belongs to the connectivity; the plane to the shape.
    model.symmetry = names.symmetry->partner.empty()
                         ? names.symmetry
                         : makeSymmetry(*model.mesh, names.symmetry->partner);
  }
  if (names.map && names.map->isGiven()) {
    FaceData<FaceId> same(model.mesh->faceCount());
    for (std::size_t i = 0; i < same.size(); ++i) same[FaceId(i)] = FaceId(i);
    model.map = std::make_shared<GuidingMapSlot>(carryGuidingMap(*guidingMap(names), model, same));
  }
  return model;
}

}  // namespace toile

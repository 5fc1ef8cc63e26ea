// SPDX-License-Identifier: GPL-3.0-or-later
// Curves and landmarks of a model from JSON (docs/file-format.md, "Models").
#include "model/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace toile::detail {
namespace {

// Files keep a few decimals; a point may be that far off the edge that it should lie on.
constexpr double kWeightTolerance = 1e-4;
// Points this near to a corner or side are on it: otherwise cutting meets needles.
constexpr double kSnap = 1e-6;

class CurveReader {
 public:
  CurveReader(const Mesh& mesh, const Json& json, const std::string& curve, const std::string& file)
      : mesh_(mesh), json_(json), curve_(curve), file_(file) {}

  Result<SurfacePath> read() {
    if (!json_.is_object()) return fail("is no object with \"tri\" and \"bary\"");
    SurfacePath path;
    if (const auto closed = json_.find("closed"); closed != json_.end()) {
      if (!closed->is_boolean()) return fail("\"closed\" is neither true nor false");
      path.closed = closed->get<bool>();
    }
    if (Result<void> done = readPoints(); !done) return done.error();
    const std::size_t count = faces_.size();
    const std::size_t segments = path.closed ? count : count - 1;
    for (std::size_t i = 0; i < segments; ++i) {
      if (Result<void> done = bringOnto(faces_[i], (i + 1) % count); !done) return done.error();
    }
    build(path);
    if (!isValid(mesh_, path)) return fail("has too few different points");
    return path;
  }

 private:
  Error fail(std::string_view what) const {
    return {ErrorCode::FileFormat,
            fmt::format("{}: curve \"{}\" {}", file_, curve_, what),
            {Element::curve(curve_)}};
  }

  Result<void> readPoints() {
    const auto tri = json_.find("tri");
    const auto bary = json_.find("bary");
    if (tri == json_.end() || bary == json_.end() || !tri->is_array() || !bary->is_array() ||
        tri->size() != bary->size() || tri->size() < 2) {
      return fail("needs lists \"tri\" and \"bary\" of equal length, at least 2");
    }
    for (std::size_t i = 0; i < tri->size(); ++i) {
      const Json& face = (*tri)[i];
      const Json& weights = (*bary)[i];
      if (!face.is_number_unsigned() || face.get<std::uint64_t>() >= mesh_.faceCount()) {
        return fail(
            fmt::format("point {}: no triangle of this mesh, which has {}", i, mesh_.faceCount()));
      }
      if (!weights.is_array() || weights.size() != 3 ||
          !std::all_of(weights.begin(), weights.end(),
                       [](const Json& w) { return w.is_number(); })) {
        return fail(fmt::format("point {}: \"bary\" needs 3 numbers", i));
      }
      Eigen::Vector3d w(weights[0].get<double>(), weights[1].get<double>(),
                        weights[2].get<double>());
      if (!w.allFinite() || w.minCoeff() < -kWeightTolerance ||
          std::abs(w.sum() - 1) > 3 * kWeightTolerance) {
        return fail(fmt::format("point {}: weights are not negative and add up to 1", i));
      }
      for (int k = 0; k < 3; ++k) {
        if (w[k] < kSnap) w[k] = 0;
      }
      faces_.emplace_back(face.get<std::uint64_t>());
      weights_.push_back(w / w.sum());
    }
    return {};
  }

  /// The point lies in its own face; a segment in `face` ends at it, so the corners of its face
  /// that the two do not share must have no weight.
  Result<void> bringOnto(FaceId face, std::size_t point) {
    const Triangle& own = mesh_.vertices(faces_[point]);
    const Triangle& other = mesh_.vertices(face);
    Eigen::Vector3d& w = weights_[point];
    double shared = 0;
    for (int k = 0; k < 3; ++k) {
      const VertexId v = own[static_cast<std::size_t>(k)];
      if (std::find(other.begin(), other.end(), v) != other.end()) {
        shared += w[k];
      } else if (w[k] > kWeightTolerance) {
        shared = 0;
        break;
      } else {
        w[k] = 0;
      }
    }
    if (!(shared > 0)) {
      return fail(
          fmt::format("leaves the surface between the points {} and {}: the latter is not "
                      "in triangle {}",
                      point == 0 ? faces_.size() - 1 : point - 1, point, face.index()));
    }
    w /= w.sum();
    return {};
  }

  /// Points that fall together become one.
  void build(SurfacePath& path) const {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      SurfacePoint point = makeSurfacePoint(mesh_, faces_[i], weights_[i]);
      if (!path.points.empty() && path.points.back() == point) {
        path.faceOfSegment.back() = faces_[i];
        continue;
      }
      path.points.push_back(std::move(point));
      path.faceOfSegment.push_back(faces_[i]);
    }
    if (!path.closed) {
      path.faceOfSegment.pop_back();
    } else if (path.points.size() > 1 && path.points.front() == path.points.back()) {
      path.points.pop_back();
      path.faceOfSegment.pop_back();
    }
  }

  const Mesh& mesh_;
  const Json& json_;
  const std::string& curve_;
  const std::string& file_;
  std::vector<FaceId> faces_;
  std::vector<Eigen::Vector3d> weights_;
};

Result<void> checkCount(const Json& json, std::string_view key, std::size_t count,
                        const std::string& file) {
  const auto stated = json.find(key);
  if (stated == json.end()) return {};
  if (stated->is_number_unsigned() && stated->get<std::uint64_t>() == count) return {};
  return Error{ErrorCode::ModelMismatch,
               fmt::format("{}: made for a mesh with {} {}, this one has {}", file, stated->dump(),
                           key, count),
               {}};
}

/// A landmark beside the vertices: a triangle and the weights of its corners.
Result<SurfacePoint> readFacePoint(const Mesh& mesh, const Json& json, const std::string& name,
                                   const std::string& file) {
  const auto tri = json.find("tri"), bary = json.find("bary");
  const bool hasFace = tri != json.end() && tri->is_number_unsigned() &&
                       tri->get<std::uint64_t>() < mesh.faceCount();
  const bool hasWeights =
      bary != json.end() && bary->is_array() && bary->size() == 3 &&
      std::all_of(bary->begin(), bary->end(), [](const Json& w) { return w.is_number(); });
  if (hasFace && hasWeights) {
    const Eigen::Vector3d w((*bary)[0].get<double>(), (*bary)[1].get<double>(),
                            (*bary)[2].get<double>());
    if (w.allFinite() && w.minCoeff() >= -kWeightTolerance &&
        std::abs(w.sum() - 1) <= 3 * kWeightTolerance) {
      return makeSurfacePoint(mesh, FaceId(tri->get<std::uint64_t>()), w);
    }
  }
  return Error{ErrorCode::FileFormat,
               fmt::format("{}: landmark \"{}\" is neither a vertex nor a triangle of this mesh "
                           "(which has {}) with three weights that add up to 1",
                           file, name, mesh.faceCount()),
               {Element::landmark(name)}};
}

/// The object under `key`; null if there is none.
const Json* objectAt(const Json& json, std::string_view key) {
  const auto at = json.is_object() ? json.find(key) : json.end();
  return at != json.end() && at->is_object() ? &*at : nullptr;
}

}  // namespace

Result<Json> parseJson(std::string_view text, const std::string& file) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    return Error{ErrorCode::FileFormat,
                 fmt::format("{}, byte {}: this is not JSON; the file is damaged or cut off", file,
                             error.byte),
                 {Element::byte(error.byte)}};
  } catch (const Json::exception& error) {
    return Error{ErrorCode::FileFormat, fmt::format("{}: {}", file, error.what()), {}};
  }
}

Result<std::map<std::string, SurfacePath>> readCurves(const Mesh& mesh, const Json& json,
                                                      const std::string& file) {
  const Json* list = objectAt(json, "curves");
  if (list == nullptr) {
    return Error{
        ErrorCode::FileFormat, fmt::format("{}: the object \"curves\" is missing", file), {}};
  }
  if (Result<void> fits = checkCount(json, "triangles", mesh.faceCount(), file); !fits) {
    return fits.error();
  }
  std::map<std::string, SurfacePath> curves;
  for (const auto& [name, curve] : list->items()) {
    Result<SurfacePath> path = CurveReader(mesh, curve, name, file).read();
    if (!path) return path.error();
    curves.emplace(name, std::move(*path));
  }
  return curves;
}

Result<std::map<std::string, SurfacePoint>> readLandmarks(const Mesh& mesh, const Json& json,
                                                          const std::string& file) {
  const Json* list = objectAt(json, "landmarks");
  if (list == nullptr) {
    return Error{
        ErrorCode::FileFormat, fmt::format("{}: the object \"landmarks\" is missing", file), {}};
  }
  if (Result<void> fits = checkCount(json, "vertices", mesh.vertexCount(), file); !fits) {
    return fits.error();
  }
  std::map<std::string, SurfacePoint> landmarks;
  for (const auto& [name, vertex] : list->items()) {
    if (vertex.is_object()) {
      Result<SurfacePoint> point = readFacePoint(mesh, vertex, name, file);
      if (!point) return point.error();
      landmarks.emplace(name, *std::move(point));
      continue;
    }
    if (!vertex.is_number_unsigned() || vertex.get<std::uint64_t>() >= mesh.vertexCount()) {
      return Error{ErrorCode::FileFormat,
                   fmt::format("{}: landmark \"{}\" is no vertex of this mesh, which has {}", file,
                               name, mesh.vertexCount()),
                   {Element::landmark(name)}};
    }
    landmarks.emplace(name, SurfacePoint{VertexId(vertex.get<std::uint64_t>())});
  }
  return landmarks;
}

}  // namespace toile::detail

namespace toile {

Result<std::map<std::string, SurfacePath>> parseModelCurves(const Mesh& mesh, std::string_view json,
                                                            const std::string& file) {
  const Result<detail::Json> parsed = detail::parseJson(json, file);
  if (!parsed) return parsed.error();
  return detail::readCurves(mesh, *parsed, file);
}

Result<std::map<std::string, SurfacePoint>> parseLandmarks(const Mesh& mesh, std::string_view json,
                                                           const std::string& file) {
  const Result<detail::Json> parsed = detail::parseJson(json, file);
  if (!parsed) return parsed.error();
  return detail::readLandmarks(mesh, *parsed, file);
}

}  // namespace toile

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "toile/core/assert.h"
#include "toile/core/id.h"

namespace toile {

enum class ErrorCode {
  InvalidArgument,  ///< an option or value outside its range
  FileNotFound,
  FileUnreadable,     ///< exists, but permission or the disk says no
  FileUnwritable,     ///< folder missing or closed, disk full
  FileFormat,         ///< damaged or of another kind; message has line or byte
  UnitsMissing,       ///< a file without units and no --units
  NotManifold,        ///< edge with more than two faces, vertex with several fans
  NotOrientable,      ///< no consistent outside
  DegenerateFace,     ///< face without area
  ModelMismatch,      ///< design made for another connectivity
  NameNotFound,       ///< landmark, model curve, styling curve, piece that does not exist
  LeavesSilhouette,   ///< a projected curve misses the model
  CurveInvalid,       ///< too few points, equal points, no way on the surface
  NotADisk,           ///< tube, closed surface; where = one vertex per boundary loop
  LengthsInfeasible,  ///< over-braced wires; where = the worst wires
  NotConverged,
  Cancelled,
  Unsupported,  ///< asked for something that this version does not do; message says so
};

/// "FileFormat" and so on, for JSON and tests.
[[nodiscard]] std::string_view toString(ErrorCode code);

/// A thing of the user's that an error or finding is about: what the studio highlights.
struct Element {
  enum class Kind { Vertex, Edge, Face, Curve, Piece, Landmark, Line, Byte };
  Kind kind = Kind::Vertex;
  std::uint64_t index = 0;  ///< of a vertex, edge, face; line number or byte offset
  std::string name;         ///< id of a curve, piece, landmark; otherwise empty

  static Element vertex(VertexId id) { return {Kind::Vertex, id.index(), {}}; }
  static Element edge(EdgeId id) { return {Kind::Edge, id.index(), {}}; }
  static Element face(FaceId id) { return {Kind::Face, id.index(), {}}; }
  static Element curve(std::string id) { return {Kind::Curve, 0, std::move(id)}; }
  static Element piece(std::string id) { return {Kind::Piece, 0, std::move(id)}; }
  static Element landmark(std::string id) { return {Kind::Landmark, 0, std::move(id)}; }
  static Element line(std::uint64_t number) { return {Kind::Line, number, {}}; }
  static Element byte(std::uint64_t offset) { return {Kind::Byte, offset, {}}; }
  friend bool operator==(const Element&, const Element&) = default;
};

[[nodiscard]] std::string_view toString(Element::Kind kind);

struct Error {
  ErrorCode code = ErrorCode::InvalidArgument;
  std::string message;         ///< for people: what, where, what to try; one sentence or two
  std::vector<Element> where;  ///< the elements concerned, the worst first, at most a few dozen

  /// The same error with a prefix: "piece \"front\": ...".
  [[nodiscard]] Error during(std::string_view context) const;
};

/// Usable but noteworthy.
struct Finding {
  std::string code;     ///< stable, kebab-case, for programs: "tube-without-cut"
  std::string message;  ///< for people
  std::vector<Element> where;
  friend bool operator==(const Finding&, const Finding&) = default;
};

/// A value, or the Error that kept it from being made.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit

  [[nodiscard]] bool hasValue() const { return state_.index() == 0; }
  explicit operator bool() const { return hasValue(); }

  T& value() & { return checked(); }
  const T& value() const& { return const_cast<Result*>(this)->checked(); }
  T&& value() && { return std::move(checked()); }
  T& operator*() & { return checked(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(checked()); }
  T* operator->() { return &checked(); }
  const T* operator->() const { return &value(); }

  [[nodiscard]] const Error& error() const {
    TOILE_ASSERT(!hasValue());
    return *std::get_if<1>(&state_);
  }

 private:
  T& checked() {
    TOILE_ASSERT(hasValue());
    return *std::get_if<0>(&state_);
  }
  std::variant<T, Error> state_;
};

/// Done, or the Error that kept it from being done.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit

  [[nodiscard]] bool hasValue() const { return !error_; }
  explicit operator bool() const { return hasValue(); }
  [[nodiscard]] const Error& error() const {
    TOILE_ASSERT(error_.has_value());
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

}  // namespace toile

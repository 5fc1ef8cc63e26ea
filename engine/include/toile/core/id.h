// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace toile {

/// Index of an element, told apart by its tag: a VertexId never turns into a FaceId by accident.
template <class Tag>
class Id {
 public:
  constexpr Id() = default;  ///< invalid; isValid() is false
  constexpr explicit Id(std::size_t index) : index_(static_cast<std::uint32_t>(index)) {}

  [[nodiscard]] constexpr std::uint32_t index() const { return index_; }
  [[nodiscard]] constexpr bool isValid() const { return index_ != kInvalid; }
  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  static constexpr std::uint32_t kInvalid = 0xffffffffU;
  std::uint32_t index_ = kInvalid;
};

using VertexId = Id<struct VertexTag>;
using HalfedgeId = Id<struct HalfedgeTag>;
using EdgeId = Id<struct EdgeTag>;
using FaceId = Id<struct FaceTag>;
/// One edge of the cut (seam, feature, hem): owner of the body and target length, see cut/cut.h.
using CutEdgeId = Id<struct CutEdgeTag>;

/// A value per element, indexed only by the element's own id type.
template <class IdType, class T>
class ElementData {
 public:
  ElementData() = default;
  explicit ElementData(std::size_t count, const T& value = T()) : values_(count, value) {}

  T& operator[](IdType id) { return values_[id.index()]; }
  const T& operator[](IdType id) const { return values_[id.index()]; }
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] const std::vector<T>& values() const { return values_; }
  std::vector<T>& values() { return values_; }
  friend bool operator==(const ElementData&, const ElementData&) = default;

 private:
  std::vector<T> values_;
};

template <class T>
using VertexData = ElementData<VertexId, T>;
template <class T>
using HalfedgeData = ElementData<HalfedgeId, T>;
template <class T>
using EdgeData = ElementData<EdgeId, T>;
template <class T>
using FaceData = ElementData<FaceId, T>;

}  // namespace toile

template <class Tag>
struct std::hash<toile::Id<Tag>> {
  std::size_t operator()(toile::Id<Tag> id) const noexcept { return id.index(); }
};

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "toile/body/sizes.h"
#include "toile/core/progress.h"
#include "toile/pipeline.h"

namespace toile {

/// A design made in one size.
struct GradedSize {
  std::string name;
  bool isBase = false;
  std::shared_ptr<const Pattern> pattern;
  Layout nest;  ///< placements that bring every size of a piece onto the base size's
};

/// Makes a design in several sizes: for each a built-in body, the design carried over to it.
///
/// In the nest, each piece of a size lies on that of the base size by the rigid motion that brings
/// the ends of its seams closest to those of the base; pieces stand in rows, apart from each other.
/// @param base the name of one of the sizes
/// @return NameNotFound for `base`; the errors of makeBody(), carryToModel(), makePattern() with
/// the
///   size; NotConverged when a piece cannot be made in a size.
Result<std::vector<GradedSize>> gradeDesign(const Document& document,
                                            std::span<const BodySize> sizes,
                                            const std::string& base, Progress* progress = nullptr);

/// Writes for each size a folder as writePattern() does, and nested.svg, nested.dxf and grade.csv,
/// the length of every seam in every size.
/// @return findings of all sizes, each begun with its size.
Result<std::vector<Finding>> writeGrading(const std::vector<GradedSize>& sizes,
                                          const std::filesystem::path& folder,
                                          Progress* progress = nullptr);

}  // namespace toile

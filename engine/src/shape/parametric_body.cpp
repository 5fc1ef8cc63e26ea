// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "shape/shape_model.h"
#include "toile/body/body.h"

namespace toile {
namespace {

Result<ReferenceModel> makeFromQuery(std::string_view query) {
  BodyOptions options;
  std::set<std::string, std::less<>> given;
  while (!query.empty()) {
    const std::string_view item = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), item.size() + 1));
    const std::string_view name = item.substr(0, item.find('='));
    const std::string_view text = item.substr(std::min(item.size(), name.size() + 1));
    if (!given.emplace(name).second) {
      return Error{ErrorCode::InvalidArgument, std::string(name) + " stands twice", {}};
    }
    const Result<void> set = setBodyOption(options, name, text);
    if (!set) return set.error();
  }
  return makeBody(options);
}

}  // namespace

const BuiltinShape& parametricBody() {
  static const BuiltinShape shape{"body@1", makeFromQuery};
  return shape;
}

}  // namespace toile

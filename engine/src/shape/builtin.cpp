// SPDX-License-Identifier: GPL-3.0-or-later
#include "toile/shape/builtin.h"

#include <array>

#include "shape/shape_model.h"
#include "toile/core/nearest_name.h"

namespace toile {
namespace {

constexpr std::string_view kPrefix = "builtin:";

std::array<const BuiltinShape*, 3> shapes() {
  return {&bentSleeve(), &torso(), &parametricBody()};
}

}  // namespace

bool isBuiltin(std::string_view reference) {
  return reference.starts_with(kPrefix);
}

Result<ReferenceModel> makeBuiltinModel(std::string_view reference) {
  const std::string whole(reference);
  if (!isBuiltin(reference)) {
    return Error{ErrorCode::InvalidArgument, "\"" + whole + "\" does not begin with builtin:", {}};
  }
  reference.remove_prefix(kPrefix.size());
  const std::size_t mark = reference.find('?');
  const std::string name(reference.substr(0, mark));
  for (const BuiltinShape* shape : shapes()) {
    if (shape->name != name) continue;
    const std::string_view query =
        mark == std::string_view::npos ? std::string_view() : reference.substr(mark + 1);
    Result<ReferenceModel> model = shape->make(query);
    if (!model) return model.error().during("builtin:" + name);
    model->name = name.substr(0, name.find('@'));
    model->reference = whole;
    return model;
  }
  return Error{ErrorCode::NameNotFound,
               "there is no builtin model \"" + name + "\"" + suggestion(name, builtinNames()),
               {}};
}

std::vector<std::string> builtinNames() {
  std::vector<std::string> names;
  for (const BuiltinShape* shape : shapes()) names.push_back(shape->name);
  return names;
}

}  // namespace toile

#include "primitive_table.h"

#include <algorithm>

#include "concave_distance/mesh/surface/primitives.h"

namespace concave_distance::detail {
namespace {

using Lengths = std::vector<double>;

}  // namespace

const std::vector<Primitive>& primitives() {
  static const std::vector<Primitive> table{
      {"box",
       {{"size", 3}},
       false,
       std::nullopt,
       [](const Lengths& d, double, const std::string& where) {
         return makeBox({d[0], d[1], d[2]}, where);
       }},
      {"sphere",
       {{"radius", 1}},
       true,
       RoundKind::Sphere,
       [](const Lengths& d, double chord_error, const std::string& where) {
         return makeSphere(d[0], chord_error, where);
       }},
      {"cylinder",
       {{"radius", 1}, {"length", 1}},
       true,
       RoundKind::Cylinder,
       [](const Lengths& d, double chord_error, const std::string& where) {
         return makeCylinder(d[0], d[1], chord_error, where);
       }},
      {"capsule",
       {{"radius", 1}, {"length", 1}},
       true,
       RoundKind::Capsule,
       [](const Lengths& d, double chord_error, const std::string& where) {
         return makeCapsule(d[0], d[1], chord_error, where);
       }},
      {"cone",
       {{"radius", 1}, {"length", 1}},
       true,
       std::nullopt,
       [](const Lengths& d, double chord_error, const std::string& where) {
         return makeCone(d[0], d[1], chord_error, where);
       }},
  };
  return table;
}

std::size_t Primitive::dimensionCount() const {
  std::size_t count = 0;
  for (const Size& size : sizes) count += size.count;
  return count;
}

const Primitive* findPrimitive(const std::string& name) {
  for (const Primitive& primitive : primitives()) {
    if (name == primitive.name) return &primitive;
  }
  return nullptr;
}

const Primitive& primitiveOf(RoundKind kind) {
  return *std::find_if(primitives().begin(), primitives().end(),
                       [&](const Primitive& primitive) { return primitive.round_kind == kind; });
}

std::string primitiveNames(const std::string& last) {
  std::string names;
  for (const Primitive& primitive : primitives()) {
    if (!names.empty()) names += &primitive == &primitives().back() ? last : ", ";
    names += primitive.name;
  }
  return names;
}

}  // namespace concave_distance::detail

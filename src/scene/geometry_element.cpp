#include "geometry_element.h"

#include <array>
#include <cstddef>
#include <sstream>
#include <utility>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import_mesh.h"
#include "concave_distance/mesh/primitives.h"

namespace concave_distance::detail {
namespace {

constexpr double kDefaultChordErrorOfRadius = 0.01;

struct PrimitiveKind {
  const char* name;
  std::size_t dimension_count;
  bool round;
};

constexpr std::array<PrimitiveKind, 4> kPrimitives{
    {{"box", 3, false}, {"sphere", 1, true}, {"cylinder", 2, true}, {"capsule", 2, true}}};

const PrimitiveKind* findPrimitive(const std::string& name) {
  for (const PrimitiveKind& kind : kPrimitives) {
    if (name == kind.name) return &kind;
  }
  return nullptr;
}

double chordErrorOf(const GeometryElement& element) {
  return element.chord_error.value_or(kDefaultChordErrorOfRadius * element.dimensions.front());
}

SurfaceMesh makePrimitive(const GeometryElement& element) {
  const PrimitiveKind* kind = findPrimitive(element.primitive);
  if (kind == nullptr) {
    throw Error(element.where, "primitive '" + element.primitive + "' is not known",
                "use box, sphere, cylinder or capsule");
  }
  const std::vector<double>& d = element.dimensions;
  if (d.size() != kind->dimension_count) {
    throw Error(element.where, "a " + element.primitive + " with " + std::to_string(d.size()) + " dimensions",
                std::to_string(kind->dimension_count) + " are expected");
  }
  if (element.primitive == "box") return makeBox({d[0], d[1], d[2]}, element.where);
  const double chord_error = chordErrorOf(element);
  if (element.primitive == "sphere") return makeSphere(d[0], chord_error, element.where);
  if (element.primitive == "cylinder") return makeCylinder(d[0], d[1], chord_error, element.where);
  return makeCapsule(d[0], d[1], chord_error, element.where);
}

TriangleSoup soupOf(const SurfaceMesh& mesh) {
  TriangleSoup soup;
  soup.vertices = mesh.vertices();
  soup.triangles.reserve(mesh.triangleCount());
  for (const TriangleNodes& t : mesh.triangles()) {
    soup.triangles.push_back({t[0].value, t[1].value, t[2].value});
  }
  return soup;
}

MeshFile meshFileOf(const GeometryElement& element) {
  return MeshFile(element.mesh_resource, element.real_folders);
}

TriangleSoup loadElement(const GeometryElement& element) {
  if (element.mesh_resource.empty() == element.primitive.empty()) {
    throw Error(element.where,
                element.primitive.empty() ? "neither a mesh nor a primitive" : "both a mesh and a primitive",
                "give one of them");
  }
  if (!element.primitive.empty()) return soupOf(makePrimitive(element));
  return importMesh(meshFileOf(element), element.scale, element.access.limits);
}

/// Of all that the surface is made from; nothing where that is not in the files and numbers named.
std::optional<ContentKey> keyOf(const std::vector<GeometryElement>& elements, const RepairOptions& options) {
  ContentHasher hasher = preparationHasher();
  addRepairOptions(hasher, options);
  for (const GeometryElement& element : elements) {
    hasher.add(element.primitive);
    for (const double dimension : element.dimensions) hasher.add(dimension);
    if (element.primitive.empty()) {
      if (!addMeshFile(hasher, meshFileOf(element), element.access.limits)) return std::nullopt;
    } else if (!element.dimensions.empty()) {
      hasher.add(chordErrorOf(element));
    }
    for (int i = 0; i < 3; ++i) hasher.add(element.scale[i]);
    for (int i = 0; i < 16; ++i) hasher.add(element.frame_from_geometry.data()[i]);
  }
  return hasher.key();
}

}  // namespace

std::string locateGeometry(GeometryElement& element, const MeshFolders& folders,
                           const PackageLocator& package_locator) {
  if (!element.primitive.empty()) return "";
  try {
    if (element.access.roots) {
      LocatedMesh located = locateMeshBelow(element.mesh_resource, *element.access.roots, package_locator);
      element.mesh_resource = std::move(located.path);
      element.real_folders = std::move(located.real_folders);
      return "";
    }
    FoundMesh found = searchMesh(element.mesh_resource, folders, package_locator);
    element.mesh_resource = std::move(found.path);
    return std::move(found.below);
  } catch (const Error& error) {
    throw Error(element.where + ", " + error.where(), error.whatIsWrong(), error.remedy());
  }
}

RepairedMesh loadGeometry(const std::vector<GeometryElement>& elements, const std::string& where,
                          PreparationCache* cache) {
  RepairOptions options;
  options.weld_tolerance = kSinglePrecisionWeld;
  return repairedMeshThrough(
      cache, [&] { return keyOf(elements, options); },
      [&] {
        TriangleSoup body;
        for (const GeometryElement& element : elements) {
          if (!element.frame_from_geometry.matrix().allFinite()) {
            throw Error(element.where, "the pose is not finite", "give finite numbers");
          }
          appendTransformed(body, loadElement(element), element.frame_from_geometry);
        }
        const bool is_one_file = elements.size() == 1 && !elements.front().mesh_resource.empty();
        return repairMesh(body, options, is_one_file ? elements.front().mesh_resource : where);
      });
}

std::string describeApproximations(const std::vector<GeometryElement>& elements) {
  std::ostringstream text;
  for (const GeometryElement& element : elements) {
    const PrimitiveKind* kind = findPrimitive(element.primitive);
    if (kind == nullptr || !kind->round || element.dimensions.empty()) continue;
    text << (text.tellp() > 0 ? "; " : "") << element.primitive << " meshed from inside, "
         << chordErrorOf(element) << " m off at most";
  }
  return text.str();
}

}  // namespace concave_distance::detail

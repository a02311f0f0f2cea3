#include "geometry_element.h"

#include <cstddef>
#include <utility>

#include "base/content_hash.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "mesh/import/mesh_file.h"
#include "mesh/surface/primitive_table.h"
#include "mesh/surface/round_geometry.h"

namespace concave_distance::detail {
namespace {

constexpr double kDefaultChordErrorOfRadius = 0.01;

double chordErrorOf(const GeometryElement& element) {
  return element.chord_error.value_or(kDefaultChordErrorOfRadius * element.dimensions.front());
}

SurfaceMesh makePrimitive(const GeometryElement& element) {
  const Primitive* primitive = findPrimitive(element.primitive);
  if (primitive == nullptr) {
    throw Error(element.where, "primitive '" + element.primitive + "' is not known",
                "use " + primitiveNames(" or "));
  }
  const std::size_t count = primitive->dimensionCount();
  if (element.dimensions.size() != count) {
    throw Error(
        element.where,
        "a " + element.primitive + " with " + std::to_string(element.dimensions.size()) + " dimensions",
        std::to_string(count) + " are expected");
  }
  return primitive->make(element.dimensions, chordErrorOf(element), element.where);
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

/// The opened mesh file; nothing for any other geometry.
std::optional<MeshFile> openElement(const GeometryElement& element) {
  const int given = (element.mesh_resource.empty() ? 0 : 1) + (element.primitive.empty() ? 0 : 1) +
                    (element.triangles ? 1 : 0);
  if (given != 1) {
    throw Error(element.where, given == 0 ? "neither a mesh nor a primitive" : "both a mesh and a primitive",
                "give one of them");
  }
  if (element.mesh_resource.empty()) return std::nullopt;
  return std::optional<MeshFile>(std::in_place, element.mesh_resource, element.real_folders);
}

/// Adds all that the element's surface is made from. False where that is not in the file named alone.
bool addElement(ContentHasher& hasher, const GeometryElement& element, const std::optional<MeshFile>& file) {
  if (element.triangles) {
    const TriangleSoup& soup = *element.triangles;
    hasher.add("triangles")
        .addBytes(soup.vertices.data(), soup.vertices.size() * sizeof(soup.vertices[0]))
        .addBytes(soup.triangles.data(), soup.triangles.size() * sizeof(soup.triangles[0]));
  }
  hasher.add(element.primitive);
  for (const double dimension : element.dimensions) hasher.add(dimension);
  if (file) {
    if (!addMeshFile(hasher, *file, element.access.limits)) return false;
  } else if (!element.dimensions.empty()) {
    hasher.add(chordErrorOf(element));
  }
  for (int i = 0; i < 3; ++i) hasher.add(element.scale[i]);
  for (int i = 0; i < 16; ++i) hasher.add(element.frame_from_geometry.data()[i]);
  return true;
}

}  // namespace

std::string locateGeometry(GeometryElement& element, const MeshFolders& folders,
                           const PackageLocator& package_locator) {
  if (!element.primitive.empty() || element.triangles) return "";
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

std::optional<ContentKey> geometryKey(const std::vector<GeometryElement>& elements) {
  ContentHasher hasher;
  for (const GeometryElement& element : elements) {
    if (!addElement(hasher, element, openElement(element))) return std::nullopt;
  }
  return hasher.key();
}

// Each file is open from its import until it has been added to the key.
KeyedMesh loadGeometry(const std::vector<GeometryElement>& elements, const std::string& where) {
  TriangleSoup body;
  bool has_key = true;
  ContentHasher hasher;
  for (const GeometryElement& element : elements) {
    if (!element.frame_from_geometry.matrix().allFinite()) {
      throw Error(element.where, "the pose is not finite", "give finite numbers");
    }
    const std::optional<MeshFile> file = openElement(element);
    if (element.triangles) {
      appendTransformed(body, *element.triangles, element.frame_from_geometry);
    } else {
      appendTransformed(
          body,
          file ? importMesh(*file, element.scale, element.access.limits) : soupOf(makePrimitive(element)),
          element.frame_from_geometry);
    }
    has_key = has_key && addElement(hasher, element, file);
  }
  const bool is_one_file = elements.size() == 1 && !elements.front().mesh_resource.empty();
  return {repairMesh(body, RepairOptions(), is_one_file ? elements.front().mesh_resource : where),
          has_key ? std::optional<ContentKey>(hasher.key()) : std::nullopt};
}

std::optional<RoundShape> roundShapeOf(const std::vector<GeometryElement>& elements) {
  if (elements.size() != 1) return std::nullopt;
  const GeometryElement& element = elements.front();
  const Primitive* primitive = findPrimitive(element.primitive);
  if (primitive == nullptr || !primitive->round_kind ||
      element.dimensions.size() != primitive->dimensionCount())
    return std::nullopt;
  RoundShape shape;
  shape.kind = *primitive->round_kind;
  shape.radius = element.dimensions[0];
  if (hasSide(shape)) shape.half_length = 0.5 * element.dimensions[1];
  shape.body_from_shape.linear() =
      Eigen::Quaterniond(element.frame_from_geometry.linear()).normalized().toRotationMatrix();
  shape.body_from_shape.translation() = element.frame_from_geometry.translation();
  shape.chord_error = chordErrorOf(element);
  return shape;
}

std::string describeApproximations(const std::vector<GeometryElement>& elements) {
  TextStream text;
  const bool exact = roundShapeOf(elements).has_value();
  for (const GeometryElement& element : elements) {
    const Primitive* primitive = findPrimitive(element.primitive);
    if (primitive == nullptr || !primitive->is_curved || element.dimensions.empty()) continue;
    text << (text.tellp() > 0 ? "; " : "") << element.primitive;
    if (exact) {
      text << " taken exactly; searched and drawn as a mesh, ";
    } else {
      text << (elements.size() > 1 ? " among several elements" : "") << " meshed from inside, ";
    }
    text << chordErrorOf(element) << " m off at most";
  }
  return text.str();
}

}  // namespace concave_distance::detail

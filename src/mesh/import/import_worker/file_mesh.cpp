#include "file_mesh.h"

#include <algorithm>
#include <locale>
#include <sstream>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "cut_polygon.h"
#include "text_words.h"

namespace concave_distance::detail {
namespace {

/// Beyond it the exact signs of areas are not exact (exact_orientation.h).
constexpr double kLargestVertex = 1e60;

}  // namespace

void checkTriangleCount(std::uint64_t count, std::uint64_t most_triangles, const std::string& path) {
  if (count > most_triangles) {
    throw Error(path, "the file has more than " + std::to_string(most_triangles) + " triangles",
                "simplify the mesh, or raise the limit (of the node: ~limits/largest_triangle_count)");
  }
}

void checkVertices(const std::vector<Eigen::Vector3d>& vertices, const FaceNames& names,
                   const std::string& path) {
  if (vertices.size() > 0xffffffffU) {
    throw Error(path, "the file has more than 2^32 vertices", "simplify the mesh");
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (vertices[v].allFinite() && vertices[v].cwiseAbs().maxCoeff() <= kLargestVertex) continue;
    throw Error(path,
                "vertex " + std::to_string(static_cast<std::int64_t>(v) + names.first_vertex) + names.of +
                    " has a coordinate that is not finite or beyond 1e60",
                kExportAgain);
  }
}

Eigen::AlignedBox3d boxOf(const std::vector<Eigen::Vector3d>& vertices) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : vertices) box.extend(vertex);
  return box;
}

void checkSinglePrecision(const std::vector<Eigen::AlignedBox3d>& meshes, const std::string& path) {
  constexpr double kRounding = 6e-8;  // of a coordinate, half a unit of single precision
  constexpr double kLargestShare = 0.01;
  double farthest = 0.0;
  double extent = 0.0;
  for (const Eigen::AlignedBox3d& box : meshes) {
    if (box.isEmpty()) continue;
    farthest = std::max({farthest, box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()});
    extent = std::max(extent, box.diagonal().norm());
  }
  if (extent == 0.0 || kRounding * farthest <= kLargestShare * extent) return;
  std::ostringstream seen;
  seen.imbue(std::locale::classic());
  seen << "the mesh is " << extent << " large, but has coordinates of " << farthest
       << "; with seven digits its shape is lost";
  throw Error(path, seen.str(), "move the mesh to the origin of its file and give the body a pose");
}

void FileMesh::addFace(const std::vector<std::int64_t>& corners, std::uint64_t number) {
  for (const std::int64_t corner : corners) {
    if (corner < least_.vertex) least_ = {corner, number};
    if (corner > largest_.vertex) largest_ = {corner, number};
  }
  if (corners.size() < 3) return;
  const auto vertex = [&](std::size_t corner) { return static_cast<std::uint32_t>(corners[corner]); };
  if (corners.size() == 3) {
    soup_.triangles.push_back({vertex(0), vertex(1), vertex(2)});
    return;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) polygon_corners_.push_back(vertex(i));
  polygons_.push_back({polygon_corners_.size(), number});
}

void FileMesh::checkCorners(const std::string& path) const {
  const auto count = static_cast<std::int64_t>(soup_.vertices.size());
  if (least_.vertex >= 0 && largest_.vertex < count) return;
  const NotedCorner& wrong = least_.vertex < 0 ? least_ : largest_;
  throw Error(path,
              names_.kind + " " + std::to_string(wrong.number) + names_.of + " refers to vertex " +
                  std::to_string(wrong.vertex + names_.first_vertex) + " of " + std::to_string(count),
              kExportAgain);
}

TriangleSoup FileMesh::takeTriangles(const std::string& path, std::uint64_t most_triangles) {
  checkTriangleCount(soup_.triangles.size() + polygon_corners_.size() - 2 * polygons_.size(), most_triangles,
                     path);
  checkVertices(soup_.vertices, names_, path);
  checkCorners(path);
  cutPolygons(path);
  return std::move(soup_);
}

void FileMesh::cutPolygons(const std::string& path) {
  if (polygons_.empty()) return;
  soup_.triangles.reserve(soup_.triangles.size() + polygon_corners_.size() - 2 * polygons_.size());
  // A corner thinner than this rounding has no side; repair joins such corners.
  PolygonCutter cutter(kSinglePrecisionWeld * boxOf(soup_.vertices).diagonal().norm());
  std::size_t first = 0;
  for (const Polygon& polygon : polygons_) {
    const std::size_t count = polygon.end - first;
    if (!cutter.cut(soup_.vertices, polygon_corners_.data() + first, count, soup_.triangles)) {
      throw Error(path,
                  names_.kind + " " + std::to_string(polygon.number) + names_.of + " is a polygon of " +
                      std::to_string(count) + " corners whose border crosses itself, seen along its normal",
                  "cut its faces into triangles in the program that made the mesh, and export it again");
    }
    first = polygon.end;
  }
}

}  // namespace concave_distance::detail

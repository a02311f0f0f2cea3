#include "support/cgal_overlap.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <unordered_map>

namespace concave_distance::test {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;
using Face = ExactMesh::Face_index;
using Vertex = ExactMesh::Vertex_index;
using CurveMap = ExactMesh::Property_map<ExactMesh::Edge_index, bool>;

ExactMesh meshOf(const SurfaceMesh& surface) {
  ExactMesh mesh;
  for (const Eigen::Vector3d& v : surface.vertices()) mesh.add_vertex(Exact::Point_3(v.x(), v.y(), v.z()));
  for (const TriangleNodes& t : surface.triangles()) {
    mesh.add_face(Vertex(t[0].value), Vertex(t[1].value), Vertex(t[2].value));
  }
  return mesh;
}

/// A mark for the edges of a mesh that lie on another's surface.
CurveMap curveMapOf(ExactMesh& mesh) {
  return mesh.add_property_map<ExactMesh::Edge_index, bool>("e:curve", false).first;
}

/// Parameters of one type for every Boolean, so that CGAL's templates are compiled once.
auto markingCurves(const CurveMap& curves) {
  return CGAL::parameters::edge_is_constrained_map(curves);
}

std::array<Exact::Point_3, 3> cornersOf(const ExactMesh& mesh, Face face) {
  std::array<Exact::Point_3, 3> corners;
  std::size_t k = 0;
  for (const auto v : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) corners[k++] = mesh.point(v);
  return corners;
}

double areaInside(ExactMesh& mesh, const ExactMesh& around, const CurveMap& on_curve) {
  auto component = mesh.add_property_map<Face, std::size_t>("f:part", 0).first;
  const std::size_t count = pmp::connected_components(mesh, component, markingCurves(on_curve));
  const CGAL::Side_of_triangle_mesh<ExactMesh, Exact> side(around);
  std::vector<int> inside(count, -1);
  double area = 0.0;
  for (const Face face : mesh.faces()) {
    int& known = inside[component[face]];
    const auto c = cornersOf(mesh, face);
    if (known < 0) known = side(CGAL::centroid(c[0], c[1], c[2])) == CGAL::ON_BOUNDED_SIDE ? 1 : 0;
    if (known == 1) area += std::sqrt(CGAL::to_double(CGAL::squared_area(c[0], c[1], c[2])));
  }
  return area;
}

struct ExactPart {
  Exact::FT volume = 0;
  Exact::FT moment[3] = {0, 0, 0};
};

void addPart(ExactPart& sum, const ExactPart& other) {
  sum.volume += other.volume;
  for (int k = 0; k < 3; ++k) sum.moment[k] += other.moment[k];
}

std::vector<OverlapPart> partsOf(ExactMesh& overlap) {
  auto component = overlap.add_property_map<Face, std::size_t>("f:shell", 0).first;
  const std::size_t count = pmp::connected_components(overlap, component);
  std::vector<ExactPart> shells(count);
  std::vector<Exact::Point_3> some(count);
  for (const Face face : overlap.faces()) {
    const auto c = cornersOf(overlap, face);
    const Exact::FT volume = CGAL::volume(Exact::Point_3(0, 0, 0), c[0], c[1], c[2]);
    ExactPart& shell = shells[component[face]];
    shell.volume += volume;
    for (int k = 0; k < 3; ++k) shell.moment[k] += volume * (c[0][k] + c[1][k] + c[2][k]) / 4;
    some[component[face]] = c[0];
  }
  std::vector<ExactPart> parts;
  for (std::size_t s = 0; s < count; ++s) {
    if (shells[s].volume <= 0) continue;
    ExactMesh own;
    std::unordered_map<std::size_t, ExactMesh::Vertex_index> vertex;
    bool has_cavities = false;
    for (std::size_t other = 0; other < count; ++other)
      has_cavities = has_cavities || shells[other].volume < 0;
    parts.push_back(shells[s]);
    if (!has_cavities) continue;
    for (const Face face : overlap.faces()) {
      if (component[face] != s) continue;
      std::vector<ExactMesh::Vertex_index> corners;
      for (const auto v : CGAL::vertices_around_face(overlap.halfedge(face), overlap)) {
        const auto found = vertex.find(v);
        corners.push_back(found != vertex.end()
                              ? found->second
                              : vertex.emplace(v, own.add_vertex(overlap.point(v))).first->second);
      }
      own.add_face(corners);
    }
    const CGAL::Side_of_triangle_mesh<ExactMesh, Exact> side(own);
    for (std::size_t cavity = 0; cavity < count; ++cavity) {
      if (shells[cavity].volume < 0 && side(some[cavity]) == CGAL::ON_BOUNDED_SIDE)
        addPart(parts.back(), shells[cavity]);
    }
  }
  std::vector<OverlapPart> rounded;
  for (const ExactPart& part : parts) {
    OverlapPart entry{CGAL::to_double(part.volume), Eigen::Vector3d::Zero()};
    for (int k = 0; k < 3; ++k) entry.centroid[k] = CGAL::to_double(part.moment[k] / part.volume);
    rounded.push_back(entry);
  }
  std::sort(rounded.begin(), rounded.end(),
            [](const OverlapPart& l, const OverlapPart& r) { return l.volume > r.volume; });
  return rounded;
}

}  // namespace

std::optional<SurfaceMesh> cgalUnion(const std::vector<SurfaceMesh>& solids) {
  ExactMesh united = meshOf(solids.front());
  for (std::size_t i = 1; i < solids.size(); ++i) {
    ExactMesh other = meshOf(solids[i]);
    ExactMesh result;
    if (!pmp::corefine_and_compute_union(united, other, result, markingCurves(curveMapOf(united)),
                                         markingCurves(curveMapOf(other)))) {
      return std::nullopt;
    }
    united = std::move(result);
  }
  united.collect_garbage();
  std::vector<Eigen::Vector3d> vertices;
  for (const auto v : united.vertices()) {
    const Exact::Point_3& p = united.point(v);
    vertices.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }
  std::vector<TriangleNodes> triangles;
  for (const Face face : united.faces()) {
    TriangleNodes nodes;
    std::size_t k = 0;
    for (const auto v : vertices_around_face(united.halfedge(face), united)) {
      nodes[k++] = NodeIndex{static_cast<std::uint32_t>(v)};
    }
    triangles.push_back(nodes);
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "union");
}

OverlapTruth cgalOverlap(const SurfaceMesh& a, const SurfaceMesh& b_in_a) {
  OverlapTruth truth;
  ExactMesh mesh_a = meshOf(a);
  ExactMesh mesh_b = meshOf(b_in_a);
  const ExactMesh whole_a = mesh_a;
  const ExactMesh whole_b = mesh_b;
  const CurveMap curve_a = curveMapOf(mesh_a);
  const CurveMap curve_b = curveMapOf(mesh_b);
  ExactMesh overlap;
  truth.known = pmp::corefine_and_compute_intersection(mesh_a, mesh_b, overlap, markingCurves(curve_a),
                                                       markingCurves(curve_b));
  if (!truth.known) return truth;
  truth.parts = partsOf(overlap);
  for (const OverlapPart& part : truth.parts) truth.volume += part.volume;
  for (const Face face : overlap.faces()) {
    const auto c = cornersOf(overlap, face);
    truth.surface += std::sqrt(CGAL::to_double(CGAL::squared_area(c[0], c[1], c[2])));
  }
  truth.area_a = areaInside(mesh_a, whole_b, curve_a);
  truth.area_b = areaInside(mesh_b, whole_a, curve_b);
  return truth;
}

struct CgalSolids::Solid {
  explicit Solid(const SurfaceMesh& surface) : mesh(meshOf(surface)), side(mesh) {}
  ExactMesh mesh;
  CGAL::Side_of_triangle_mesh<ExactMesh, Exact> side;
};

CgalSolids::CgalSolids(const std::vector<SurfaceMesh>& solids) {
  for (const SurfaceMesh& solid : solids) solids_.push_back(std::make_unique<Solid>(solid));
}

CgalSolids::~CgalSolids() = default;

bool CgalSolids::hold(const Eigen::Vector3d& point) const {
  const Exact::Point_3 at(point.x(), point.y(), point.z());
  return std::any_of(solids_.begin(), solids_.end(),
                     [&](const auto& solid) { return solid->side(at) == CGAL::ON_BOUNDED_SIDE; });
}

}  // namespace concave_distance::test

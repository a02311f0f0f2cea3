#include "exact_solid.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_decomposition_3.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "concave_distance/base/error.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using ExactMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Structure = Nef::SNC_structure;

Eigen::Vector3d rounded(const Kernel::Point_3& point) {
  return {CGAL::to_double(point.x()), CGAL::to_double(point.y()), CGAL::to_double(point.z())};
}

Nef convexHullOf(const std::vector<Kernel::Point_3>& points) {
  ExactMesh hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  return Nef(hull);
}

/// Leaves of a closed set one volume, counted from the first bounded one, with its boundary.
class KeepVolume : public CGAL::Modifier_base<Structure> {
 public:
  explicit KeepVolume(std::size_t kept) : kept_(kept) {}

  void operator()(Structure& structure) override {
    std::size_t index = 0;
    for (auto volume = structure.volumes_begin(); volume != structure.volumes_end(); ++volume, ++index) {
      volume->mark() = index == kept_;
    }
    for (auto facet = structure.halffacets_begin(); facet != structure.halffacets_end(); ++facet) {
      facet->mark() = facet->incident_volume()->mark() || facet->twin()->incident_volume()->mark();
    }
    for (auto vertex = structure.vertices_begin(); vertex != structure.vertices_end(); ++vertex) {
      markSphereMap(vertex);
    }
  }

 private:
  static void markSphereMap(Structure::Vertex_iterator vertex) {
    vertex->mark() = false;
    for (auto edge = vertex->svertices_begin(); edge != vertex->svertices_end(); ++edge) {
      edge->mark() = false;
    }
    for (auto face = vertex->sfaces_begin(); face != vertex->sfaces_end(); ++face) {
      face->mark() = face->volume()->mark();
      vertex->mark() = vertex->mark() || face->mark();
    }
    for (auto arc = vertex->shalfedges_begin(); arc != vertex->shalfedges_end(); ++arc) {
      arc->mark() = arc->incident_sface()->mark() || arc->twin()->incident_sface()->mark();
      arc->source()->mark() = arc->source()->mark() || arc->mark();
    }
    if (vertex->has_shalfloop()) {
      const auto loop = vertex->shalfloop();
      loop->mark() = loop->twin()->mark() =
          loop->incident_sface()->mark() || loop->twin()->incident_sface()->mark();
    }
  }

  std::size_t kept_;
};

/// A surface of one shell as CGAL has it; false in second when triangles or corners are shared as no
/// 2-manifold shares them.
std::pair<ExactMesh, bool> shellMesh(const SurfaceMesh& mesh, const MeshTopology& topology,
                                     std::uint32_t shell) {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> triangles;
  std::unordered_map<std::uint32_t, std::size_t> number;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (topology.shell_of_triangle[t] != shell) {
      continue;
    }
    std::vector<std::size_t> corners;
    for (const NodeIndex node : mesh.triangles()[t]) {
      const auto [place, is_new] = number.emplace(node.value, points.size());
      if (is_new) {
        const Eigen::Vector3d& p = mesh.vertex(node);
        points.emplace_back(p.x(), p.y(), p.z());
      }
      corners.push_back(place->second);
    }
    triangles.push_back(std::move(corners));
  }
  ExactMesh result;
  namespace pmp = CGAL::Polygon_mesh_processing;
  if (!pmp::is_polygon_soup_a_polygon_mesh(triangles)) {
    return {result, false};
  }
  pmp::polygon_soup_to_polygon_mesh(points, triangles, result);
  return {result, CGAL::is_closed(result)};
}

double signedVolume(const SurfaceMesh& mesh, const MeshTopology& topology, std::uint32_t shell) {
  double volume = 0.0;
  const Eigen::Vector3d origin = mesh.boundingBox().center();
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (topology.shell_of_triangle[t] == shell) {
      const TriangleIndex triangle{t};
      volume += (mesh.corner(triangle, 0) - origin)
                    .dot((mesh.corner(triangle, 1) - origin).cross(mesh.corner(triangle, 2) - origin)) /
                6.0;
    }
  }
  return volume;
}

}  // namespace

struct ExactSolid::Implementation {
  Nef nef;
};

namespace {

ExactSolid solidOf(const Nef& nef) {
  return ExactSolid(std::make_shared<const ExactSolid::Implementation>(ExactSolid::Implementation{nef}));
}

}  // namespace

ExactSolid::ExactSolid(std::shared_ptr<const Implementation> implementation)
    : implementation_(std::move(implementation)) {}

ExactSolid ExactSolid::fromMesh(const SurfaceMesh& mesh, const std::string& where) {
  const MeshTopology topology = buildMeshTopology(mesh);
  Nef solid;
  Nef cavities;
  for (std::uint32_t shell = 0; shell < topology.shellCount(); ++shell) {
    if (topology.triangle_of_shell[shell] == kNoTriangle) {
      continue;  // a vertex that no triangle uses
    }
    if (!topology.shell_is_closed[shell]) {
      throw Error(where, "shell " + std::to_string(shell) + " of the surface is not closed",
                  "only a closed surface has an inside; see mesh_tool inspect and mesh_tool repair");
    }
    auto [surface, is_manifold] = shellMesh(mesh, topology, shell);
    if (!is_manifold || CGAL::Polygon_mesh_processing::does_self_intersect(surface)) {
      throw Error(where,
                  "shell " + std::to_string(shell) +
                      " crosses or touches itself, so that its inside is not "
                      "defined",
                  "separate the parts that touch, or give a surface that does not cross itself");
    }
    const bool is_cavity = signedVolume(mesh, topology, shell) < 0.0;
    (is_cavity ? cavities : solid) += Nef(surface);
  }
  solid = (solid - cavities).regularization();
  if (solid.is_empty()) {
    throw Error(where, "the surface encloses no volume",
                "give a closed surface whose triangles face outwards");
  }
  return solidOf(solid);
}

bool ExactSolid::isEmpty() const {
  return implementation_->nef.is_empty();
}

ExactSolid ExactSolid::hull() const {
  std::vector<Kernel::Point_3> points;
  const Nef& nef = implementation_->nef;
  for (auto vertex = nef.vertices_begin(); vertex != nef.vertices_end(); ++vertex) {
    points.push_back(vertex->point());
  }
  return solidOf(convexHullOf(points));
}

ExactSolid ExactSolid::minus(const ExactSolid& other) const {
  return solidOf((implementation_->nef - other.implementation_->nef).regularization());
}

std::vector<ExactSolid> ExactSolid::components() const {
  const Nef& nef = implementation_->nef;
  std::vector<ExactSolid> parts;
  std::size_t marked = 0;
  for (auto volume = nef.volumes_begin(); volume != nef.volumes_end(); ++volume) {
    marked += volume->mark() ? 1U : 0U;
  }
  if (marked == 1) {
    return {*this};
  }
  std::size_t index = 0;
  for (auto volume = nef.volumes_begin(); volume != nef.volumes_end(); ++volume, ++index) {
    if (volume->mark()) {
      Nef part = nef;
      KeepVolume keep(index);
      part.delegate(keep, false, true);
      parts.push_back(solidOf(part));
    }
  }
  return parts;
}

ExactSolid ExactSolid::below(const Eigen::Vector3d& normal, double offset) const {
  using FT = Kernel::FT;
  const Kernel::Vector_3 n(normal.x(), normal.y(), normal.z());
  const Kernel::Vector_3 axis =
      std::abs(normal.x()) < 0.6 ? Kernel::Vector_3(1, 0, 0) : Kernel::Vector_3(0, 1, 0);
  const Kernel::Vector_3 u = CGAL::cross_product(n, axis);
  const Kernel::Vector_3 v = CGAL::cross_product(n, u);
  double reach = 1.0;
  for (const Eigen::Vector3d& vertex : facets().vertices) {
    reach = std::max(reach, vertex.norm());
  }
  // u and v are at least half as long as n is squared; the box reaches beyond the solid in every direction.
  const FT far_away = 16.0 * (reach + std::abs(offset)) / std::min(1.0, normal.norm());
  const Kernel::Point_3 on_plane = CGAL::ORIGIN + n * (FT(offset) / n.squared_length());
  std::vector<Kernel::Point_3> corners;
  for (const int i : {-1, 1}) {
    for (const int j : {-1, 1}) {
      const Kernel::Point_3 corner = on_plane + u * (far_away * i) + v * (far_away * j);
      corners.push_back(corner);
      corners.push_back(corner - n * far_away);
    }
  }
  return solidOf((implementation_->nef * convexHullOf(corners)).regularization());
}

std::vector<ExactSolid> ExactSolid::convexParts() const {
  Nef walled = implementation_->nef;
  CGAL::convex_decomposition_3(walled);
  std::vector<ExactSolid> parts;
  auto volume = walled.volumes_begin();
  for (++volume; volume != walled.volumes_end(); ++volume) {
    if (volume->mark()) {
      CGAL::Polyhedron_3<Kernel> part;
      walled.convert_inner_shell_to_polyhedron(volume->shells_begin(), part);
      parts.push_back(solidOf(Nef(part)));
    }
  }
  return parts;
}

SolidFacets ExactSolid::facets() const {
  const Nef& nef = implementation_->nef;
  SolidFacets result;
  std::unordered_map<const void*, std::uint32_t> number;
  for (auto vertex = nef.vertices_begin(); vertex != nef.vertices_end(); ++vertex) {
    number.emplace(&*vertex, static_cast<std::uint32_t>(result.vertices.size()));
    result.vertices.push_back(rounded(vertex->point()));
  }
  for (auto facet = nef.halffacets_begin(); facet != nef.halffacets_end(); ++facet) {
    if (facet->incident_volume()->mark() || !facet->twin()->incident_volume()->mark()) {
      continue;  // kept: the halffacet that looks out
    }
    SolidFacet kept;
    for (auto cycle = facet->facet_cycles_begin(); cycle != facet->facet_cycles_end(); ++cycle) {
      if (!cycle.is_shalfedge()) {
        continue;
      }
      std::vector<std::uint32_t>& loop = kept.loops.emplace_back();
      Nef::SHalfedge_around_facet_const_circulator edge{Nef::SHalfedge_const_handle(cycle)};
      const auto end = edge;
      do {
        loop.push_back(number.at(&*edge->source()->center_vertex()));
      } while (++edge != end);
    }
    // The exact normal may be of any length, beyond what doubles hold.
    const Kernel::Plane_3 plane = facet->plane();
    const Kernel::FT a = plane.a();
    const Kernel::FT b = plane.b();
    const Kernel::FT c = plane.c();
    const Kernel::FT largest = std::max({CGAL::abs(a), CGAL::abs(b), CGAL::abs(c)});
    const Eigen::Vector3d direction(CGAL::to_double(a / largest), CGAL::to_double(b / largest),
                                    CGAL::to_double(c / largest));
    kept.normal = direction.normalized();
    kept.offset = -CGAL::to_double(plane.d() / largest) / direction.norm();
    result.facets.push_back(std::move(kept));
  }
  return result;
}

}  // namespace concave_distance

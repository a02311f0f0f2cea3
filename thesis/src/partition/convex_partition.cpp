#include "convex_partition.h"

#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/convex_decomposition_3.h>
#include <CGAL/exceptions.h>

#include <chrono>

#include "concave_distance/base/error.h"
#include "exact_solid.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance {
namespace {

using Solid = CGAL::Nef_polyhedron_3<detail::ExactKernel>;

/// Six times the signed volume of some triangles of a surface.
double signedVolume(const SurfaceMesh& mesh, const std::vector<TriangleIndex>& triangles) {
  const Eigen::Vector3d origin = mesh.boundingBox().center();
  double sum = 0.0;
  for (const TriangleIndex t : triangles) {
    const Eigen::Vector3d a = mesh.corner(t, 0) - origin;
    sum += a.dot((mesh.corner(t, 1) - origin).cross(mesh.corner(t, 2) - origin));
  }
  return sum;
}

/// The solid inside a surface: its shells that turn outwards, less those that turn inwards.
Solid solidOf(const SurfaceMesh& mesh, const MeshTopology& topology, const std::string& name) {
  std::vector<std::vector<TriangleIndex>> shells(topology.shellCount());
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    shells[topology.shell_of_triangle[t]].emplace_back(t);
  }
  Solid material;
  Solid hollows;
  for (const std::vector<TriangleIndex>& shell : shells) {
    if (shell.empty()) continue;
    detail::ExactPolyhedron polyhedron = detail::exactShell(mesh, shell, name);
    const bool hollow = signedVolume(mesh, shell) < 0.0;
    if (hollow) polyhedron.inside_out();
    Solid part(polyhedron);
    Solid& sum = hollow ? hollows : material;
    sum = sum.is_empty() ? part : Solid(sum + part);
  }
  return hollows.is_empty() ? material : Solid(material - hollows);
}

ConvexPartition piecesOf(Solid& solid, const std::string& name, PartitionReport& report) {
  CGAL::convex_decomposition_3(solid);
  ConvexPartition partition;
  partition.name = name;
  auto space = solid.volumes_begin();
  for (++space; space != solid.volumes_end(); ++space) {
    if (!space->mark()) continue;
    detail::ExactPolyhedron polyhedron;
    solid.convert_inner_shell_to_polyhedron(space->shells_begin(), polyhedron);
    ConvexPiece piece;
    if (detail::roundedPiece(polyhedron, name, piece)) {
      partition.pieces.push_back(std::move(piece));
    } else {
      ++report.dropped_slivers;
    }
  }
  return partition;
}

}  // namespace

PartitionedBody partitionMesh(const SurfaceMesh& mesh, const std::string& name,
                              const PartitionOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const MeshTopology topology = buildMeshTopology(mesh);
  if (!topology.allShellsClosed()) {
    throw Error(name, "the surface has a border, so it has no inside that could be partitioned",
                "close its holes; mesh_tool inspect counts them");
  }
  PartitionedBody body;
  body.report.reflex_edges = countReflexEdges(mesh);
  body.report.shells = topology.shellCount();
  if (body.report.reflex_edges > options.reflex_edge_limit) {
    throw Error(
        name,
        "the surface has " + std::to_string(body.report.reflex_edges) +
            " reflex edges, more than the limit of " + std::to_string(options.reflex_edge_limit),
        "each is cut through exactly, so pieces and time grow with their square at worst: simplify the "
        "rounds of the mesh, or raise the limit");
  }
  try {
    Solid solid = solidOf(mesh, topology, name);
    body.partition = piecesOf(solid, name, body.report);
  } catch (const CGAL::Failure_exception& failure) {
    throw Error(name, std::string("CGAL could not partition the surface: ") + failure.what(),
                "it may touch or cross itself; see mesh_tool inspect");
  }
  if (body.partition.pieces.empty()) {
    throw Error(name, "the surface encloses no volume",
                "its shells must turn outwards; see mesh_tool repair");
  }
  body.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return body;
}

}  // namespace concave_distance

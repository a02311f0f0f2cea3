#include "mesh_tool_commands.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <ostream>

#include "base/triangle_area.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "mesh/surface/refine_mesh.h"

namespace concave_distance::tools {
namespace {

struct Measures {
  double area = 0.0;
  double volume = 0.0;
  double shortest_edge = std::numeric_limits<double>::infinity();
  double longest_edge = 0.0;
};

Measures measure(const SurfaceMesh& mesh) {
  Measures measures;
  const Eigen::Vector3d origin = mesh.boundingBox().center();
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const Eigen::Vector3d a = mesh.corner(triangle, 0) - origin;
    const Eigen::Vector3d b = mesh.corner(triangle, 1) - origin;
    const Eigen::Vector3d c = mesh.corner(triangle, 2) - origin;
    measures.area += triangleArea(a, b, c);
    measures.volume += a.dot(b.cross(c)) / 6.0;
    for (const double length : {(b - a).norm(), (c - b).norm(), (a - c).norm()}) {
      measures.shortest_edge = std::min(measures.shortest_edge, length);
      measures.longest_edge = std::max(measures.longest_edge, length);
    }
  }
  return measures;
}

void printSizes(const char* label, const SurfaceMesh& mesh, std::ostream& out) {
  out << label << mesh.vertexCount() << " vertices, " << mesh.triangleCount() << " triangles\n";
}

void printRepairs(const RepairReport& report, std::ostream& out) {
  const std::string summary = report.summary();
  out << "found: " << (summary.empty() ? "nothing to repair" : summary) << '\n';
}

/// The input, repaired as the options say. @throws Error naming the file
RepairedMesh readRepaired(const MeshToolOptions& options) {
  RepairOptions repair;
  repair.weld_tolerance = options.weld_tolerance;
  repair.orient = options.orient;
  return repairMesh(importMesh(options.input, options.scale), repair, options.input);
}

}  // namespace

void inspectMeshFile(const MeshToolOptions& options, std::ostream& out) {
  const RepairedMesh repaired = readRepaired(options);
  const SurfaceMesh& mesh = repaired.mesh;
  const RepairReport& report = repaired.report;
  const Measures measures = measure(mesh);
  const Eigen::Vector3d size = mesh.boundingBox().sizes();
  out << "file: " << options.input << '\n'
      << "in the file: " << report.vertices_in << " vertices, " << report.triangles_in << " triangles\n";
  printSizes("repaired: ", mesh, out);
  printRepairs(report, out);
  out << "shells: " << report.shells << ", closed: " << report.closed_shells << '\n'
      << "holes: " << report.holes << ", border edges: " << report.border_edges
      << ", non-manifold edges: " << report.non_manifold_edges << '\n'
      << "lowest corner (m): " << mesh.boundingBox().min().transpose() << '\n'
      << "highest corner (m): " << mesh.boundingBox().max().transpose() << '\n'
      << "size (m): " << size.transpose() << '\n'
      << "edges (m): " << measures.shortest_edge << " to " << measures.longest_edge << '\n'
      << "area (m^2): " << measures.area << '\n'
      << "volume (m^3): ";
  if (report.closed_shells == report.shells) {
    out << measures.volume << '\n';
  } else {
    out << "none, the mesh is not closed\n";
  }
}

void repairMeshFile(const MeshToolOptions& options, std::ostream& out) {
  const RepairedMesh repaired = readRepaired(options);
  exportMesh(repaired.mesh, options.output);
  printRepairs(repaired.report, out);
  printSizes("written: ", repaired.mesh, out);
}

void refineMeshFile(const MeshToolOptions& options, std::ostream& out) {
  const RepairedMesh repaired = readRepaired(options);
  const RefinedMesh refined = refineToEdgeLength(repaired.mesh, options.max_edge_length);
  exportMesh(refined.mesh, options.output);
  printRepairs(repaired.report, out);
  printSizes("repaired: ", repaired.mesh, out);
  printSizes("written: ", refined.mesh, out);
  out << "longest edge (m): " << measure(refined.mesh).longest_edge << '\n';
}

void simplifyMeshFile(const MeshToolOptions& options, std::ostream& out) {
  const RepairedMesh repaired = readRepaired(options);
  const double tolerance = options.merge_tolerance * repaired.mesh.diameter();
  const MergedMesh merged = mergeFlatTriangles(repaired.mesh, tolerance);
  exportMesh(merged.mesh, options.output);
  printRepairs(repaired.report, out);
  printSizes("repaired: ", repaired.mesh, out);
  out << "flat patches: " << merged.flat_patches << '\n';
  printSizes("written: ", merged.mesh, out);
  out << "no point of the surface moved by more than (m): " << tolerance << '\n';
}

void convertMeshFile(const MeshToolOptions& options, std::ostream& out) {
  const SurfaceMesh mesh = weldEqualVertices(importMesh(options.input, options.scale), options.input);
  exportMesh(mesh, options.output);
  printSizes("written: ", mesh, out);
}

}  // namespace concave_distance::tools

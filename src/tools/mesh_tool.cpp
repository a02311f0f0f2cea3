#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <iostream>
#include <limits>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "base/output_file.h"
#include "base/run_tool.h"
#include "base/triangle_measures.h"
#include "base/versions.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "mesh/repair/merge_flat_triangles.h"
#include "mesh/surface/refine_mesh.h"
#include "mesh/surface/surface_moments.h"

namespace concave_distance::tools {
namespace {

struct MeshToolOptions {
  std::string input;
  std::string output;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  double weld_tolerance = kSinglePrecisionWeld;  ///< relative to the bounding box's diagonal
  bool orient = true;                            ///< turn triangles that disagree
  double max_edge_length = 0.0;                  ///< metres
  double merge_tolerance = kMergeTolerance;      ///< relative to the bounding box's diagonal
};

struct Measures {
  double area = 0.0;
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

// Each command reads `input`, writes `output` (but for inspect) and prints what it found to `out`. Each
// throws an Error that names the file.
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
    out << detail::SurfaceMoments(mesh).volume << '\n';
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

struct CommandLine {
  MeshToolOptions options;
  std::string scale = "1";
};

void addInput(CLI::App& command, CommandLine& line) {
  command.add_option("input", line.options.input, "mesh to read (.stl, .obj, .ply, .dae)")->required();
  command
      .add_option("--scale", line.scale,
                  "factor on the file's coordinates, or one for each axis (1,1,0.001); negative mirrors")
      ->type_name("S[,S,S]");
}

/// One factor for all axes, or three with commas between them.
Eigen::Vector3d parseScale(const std::string& text) {
  std::vector<double> factors;
  for (const std::string& factor : CLI::detail::split(text, ',')) {
    double value = 0.0;
    if (!CLI::detail::lexical_cast(factor, value)) {
      throw CLI::ConversionError(text, "--scale");
    }
    factors.push_back(value);
  }
  if (factors.size() == 1) {
    return Eigen::Vector3d::Constant(factors[0]);
  }
  if (factors.size() != 3) {
    throw CLI::ValidationError("--scale", "takes one factor, or three with commas between them");
  }
  return {factors[0], factors[1], factors[2]};
}

void addOutput(CLI::App& command, CommandLine& line) {
  command.add_option("output", line.options.output, "mesh to write (.stl, .obj, .ply)")->required();
}

void addRepair(CLI::App& command, CommandLine& line) {
  command
      .add_option("--weld-tolerance", line.options.weld_tolerance,
                  "vertices closer than this fraction of the body's size become one; 0: equal ones only")
      ->capture_default_str();
  command.add_flag("--keep-winding{false}", line.options.orient, "turn no triangle");
}

using Command = std::pair<CLI::App*, void (*)(const MeshToolOptions&, std::ostream&)>;

void addOptionsOfCommands(CLI::App& refine, CLI::App& simplify, CommandLine& line) {
  simplify
      .add_option("--tolerance", line.options.merge_tolerance,
                  "no point of the surface moves farther than this fraction of the body's size")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  refine.add_option("--max-edge", line.options.max_edge_length, "longest edge to leave, metres")->required();
}

std::vector<Command> addCommands(CLI::App& app, CommandLine& line) {
  CLI::App* inspect = app.add_subcommand("inspect", "Print size, shells, holes and what repair would change");
  CLI::App* repair = app.add_subcommand(
      "repair", "Weld vertices, drop zero-area and duplicate triangles, turn closed shells outwards");
  CLI::App* refine =
      app.add_subcommand("refine", "Repair, then split edges until none is longer than --max-edge");
  CLI::App* simplify = app.add_subcommand(
      "simplify", "Repair, then merge the triangles of each plane into as few as possible");
  CLI::App* convert =
      app.add_subcommand("convert", "Write in another format or scale; equal vertices are welded, no more");
  for (CLI::App* command : {inspect, repair, refine, simplify, convert}) addInput(*command, line);
  for (CLI::App* command : {repair, refine, simplify, convert}) addOutput(*command, line);
  for (CLI::App* command : {inspect, repair, refine, simplify}) addRepair(*command, line);
  addOptionsOfCommands(*refine, *simplify, line);
  return {{inspect, inspectMeshFile},
          {repair, repairMeshFile},
          {refine, refineMeshFile},
          {simplify, simplifyMeshFile},
          {convert, convertMeshFile}};
}

int run(int argc, char** argv) {
  CommandLine line;
  CLI::App app("Looks at meshes and prepares them. Lengths are metres.", "mesh_tool");
  app.footer("Exit status: 0 done, 1 the mesh or a file is at fault, 2 the command line is.");
  app.set_version_flag("--version", versionsText());
  app.require_subcommand(1);
  const std::vector<Command> commands = addCommands(app, line);
  try {
    app.parse(argc, argv);
    line.options.scale = parseScale(line.scale);
  } catch (const CLI::ParseError& error) {
    return reportParseError(app, error);
  }
  requireDistinctFiles({{"the input", line.options.input}}, {{"the output", line.options.output}});
  for (const auto& [command, act] : commands) {
    if (command->parsed()) act(line.options, std::cout);
  }
  return 0;
}

}  // namespace
}  // namespace concave_distance::tools

int main(int argc, char** argv) {
  return concave_distance::runTool("mesh_tool", argc, argv, concave_distance::tools::run);
}

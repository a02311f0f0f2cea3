#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "base/output_file.h"
#include "base/run_tool.h"
#include "mesh_tool_commands.h"

namespace {

using namespace concave_distance::tools;

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
  app.require_subcommand(1);
  const std::vector<Command> commands = addCommands(app, line);
  try {
    app.parse(argc, argv);
    line.options.scale = parseScale(line.scale);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : concave_distance::kWrongCommandLine;
  }
  concave_distance::requireDistinctFiles({{"the input", line.options.input}},
                                         {{"the output", line.options.output}});
  for (const auto& [command, act] : commands) {
    if (command->parsed()) act(line.options, std::cout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::runTool("mesh_tool", argc, argv, run);
}

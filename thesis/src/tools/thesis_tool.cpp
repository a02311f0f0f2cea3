// Prepares the bodies of the thesis's comparisons: convex hulls, convex pieces, constraint trees.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "base/output_file.h"
#include "base/run_tool.h"
#include "thesis_tool_commands.h"

namespace {

using namespace concave_distance::tools;

using Command = std::pair<CLI::App*, void (*)(const ThesisToolOptions&, std::ostream&)>;

std::vector<Command> addCommands(CLI::App& app, ThesisToolOptions& options) {
  CLI::App* hull = app.add_subcommand("hull", "Repair, then write the convex hull");
  CLI::App* partition =
      app.add_subcommand("partition", "Repair, then cut a closed mesh into convex pieces, exactly");
  CLI::App* tree = app.add_subcommand(
      "tree", "Repair, then write the constraint tree: hull, concavities, what stands in them, and so on");
  for (CLI::App* command : {hull, partition, tree}) {
    command->add_option("input", options.input, "mesh to read (.stl, .obj, .ply, .dae)")->required();
    command
        ->add_option("--weld-tolerance", options.repair.weld_tolerance,
                     "vertices closer than this fraction of the body's size become one; 0: equal ones only")
        ->capture_default_str();
    command->add_flag("--keep-winding{false}", options.repair.orient, "turn no triangle");
  }
  hull->add_option("output", options.output, "mesh to write (.stl, .obj, .ply)")->required();
  partition->add_option("output", options.output, "pieces to write (.obj, one object a piece)")->required();
  partition
      ->add_option("--reflex-edge-limit", options.reflex_edge_limit,
                   "refuse meshes with more edges that have more than half a turn of material around them")
      ->capture_default_str();
  tree->add_option("output", options.output, "tree to write (.yaml)")->required();
  tree->add_option("--pieces", options.pieces, "write the convex pieces, too (.obj, one object a piece)");
  tree->add_option("--flatness", options.flatness,
                   "leave out pieces thinner than this fraction of the body's size")
      ->capture_default_str();
  return {{hull, writeHull}, {partition, writePartition}, {tree, writeTree}};
}

int run(int argc, char** argv) {
  ThesisToolOptions options;
  CLI::App app("Prepares bodies for the thesis's comparisons. Lengths are metres.", "thesis_tool");
  app.footer("Exit status: 0 done, 1 the mesh or a file is at fault, 2 the command line is.");
  app.require_subcommand(1);
  const std::vector<Command> commands = addCommands(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return concave_distance::reportParseError(app, error);
  }
  concave_distance::requireDistinctFiles({{"the input", options.input}},
                                         {{"the output", options.output}, {"--pieces", options.pieces}});
  for (const auto& [command, act] : commands) {
    if (command->parsed()) act(options, std::cout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::runTool("thesis_tool", argc, argv, run);
}

// Random scenes whose niches are compared with an enumeration in long double: a program to look for inputs
// that nobody thought of. A small part of it runs in every build (niche_hunt_test).
//   niche_hunt [--seconds S] [--poses N] [--seed N] [--family NAME] [--scene N] [--margins] [--folder
//   findings]
// Scenes are drawn from every family in turn (--help lists them), or from one; each has 8 poses, along which
// the pair is solved cold and tracked. Every failure is one line: family, scene, cycle, parameters, what is
// wrong, and the command that repeats it; the meshes and poses of the scene are written to the folder. The
// last lines are the totals. The exit status is 1 when an answer was wrong.
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>

#include "base/output_file.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "fuzz/niche_hunt_scene.h"
#include "loading/query_poses.h"

namespace concave_distance {
namespace {

struct Options {
  double seconds = 1e9;
  std::uint64_t poses = 20000;
  std::uint64_t seed = 1;
  std::string family;
  std::int64_t scene = -1;
  bool margins = false;
  std::string folder = "findings";
};

struct Totals {
  std::uint64_t poses = 0;
  std::uint64_t niches = 0;
  std::uint64_t borderline = 0;
  std::uint64_t cold = 0;
  std::uint64_t tracked = 0;

  void add(const test::NicheHuntResult& result) {
    poses += result.poses;
    niches += result.niches;
    borderline += result.borderline;
    for (const test::NicheFailure& failure : result.failures) ++(failure.is_tracked ? tracked : cold);
  }
  void print(const std::string& name) const {
    std::cout << name << ": " << poses << " poses, " << niches << " niches, " << borderline << " borderline, "
              << cold << " wrong cold, " << tracked << " wrong tracked" << std::endl;
  }
};

/// The scene as files for distance_query. @return their common beginning
std::string writeScene(const test::NicheScene& scene, const std::string& folder, const std::string& name) {
  std::filesystem::create_directories(folder);
  const std::string path = folder + "/" + name;
  exportMesh(scene.a, path + "_a.obj");
  exportMesh(scene.b, path + "_b.obj");
  std::vector<TimedPose> poses;
  for (std::size_t i = 0; i < scene.poses.size(); ++i)
    poses.push_back({0.01 * static_cast<double>(i), scene.poses[i]});
  OutputFile file(path + "_poses.csv");
  file.stream() << matrixPosesText(poses);
  file.finish();
  return path;
}

void report(const Options& options, const test::NicheFamily& family, std::uint64_t number,
            const test::NicheScene& scene, const test::NicheHuntResult& result) {
  if (result.failures.empty()) return;
  const std::string name =
      std::string(family.name) + "_" + std::to_string(options.seed) + "_" + std::to_string(number);
  const std::string path = writeScene(scene, options.folder, name);
  for (const test::NicheFailure& failure : result.failures) {
    std::cout << "WRONG " << (failure.is_tracked ? "tracked" : "cold") << ", " << family.name << " scene "
              << number << ", cycle " << failure.cycle << ", " << failure.parameters << ": "
              << failure.complaint << "repeat: niche_hunt --seed " << options.seed << " --family "
              << family.name << " --scene " << number << (options.margins ? " --margins" : "")
              << ", files: " << path << "_*" << std::endl;
  }
}

int run(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  const auto isOver = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > options.seconds;
  };
  std::vector<const test::NicheFamily*> families;
  if (options.family.empty()) {
    for (const test::NicheFamily& family : test::nicheFamilies()) families.push_back(&family);
  } else {
    families.push_back(&test::nicheFamily(options.family));
  }
  std::map<std::string, Totals> totals;
  Totals all;
  const std::uint64_t first = options.scene < 0 ? 0 : static_cast<std::uint64_t>(options.scene);
  for (std::uint64_t number = first; all.poses < options.poses && !isOver(); ++number) {
    for (const test::NicheFamily* family : families) {
      if (all.poses >= options.poses || isOver()) break;
      const test::NicheScene scene = test::drawNicheScene(*family, options.seed, number);
      const test::NicheHuntResult result =
          test::huntScene(scene, streamSeed(options.seed, family->name, number), options.margins);
      report(options, *family, number, scene, result);
      totals[family->name].add(result);
      all.add(result);
    }
    if (options.scene >= 0) break;
  }
  for (const auto& [name, of_family] : totals) of_family.print(name);
  all.print("all, seed " + std::to_string(options.seed));
  return all.cold + all.tracked > 0 ? 1 : 0;
}

std::string familyList() {
  std::string list = "Families:\n";
  for (const test::NicheFamily& family : test::nicheFamilies()) {
    list += std::string("  ") + family.name + ": " + family.description + "\n";
  }
  return list;
}

}  // namespace
}  // namespace concave_distance

int main(int argc, char** argv) {
  using namespace concave_distance;
  try {
    Options options;
    CLI::App app("Random scenes whose niches are compared with an enumeration in long double.", "niche_hunt");
    app.footer(familyList());
    app.add_option("--seconds", options.seconds, "how long at most");
    app.add_option("--poses", options.poses, "how many at least")->capture_default_str();
    app.add_option("--seed", options.seed, "of all scenes")->capture_default_str();
    app.add_option("--family", options.family, "one family; default: all in turn");
    app.add_option("--scene", options.scene, "this scene alone");
    app.add_flag("--margins", options.margins, "give the bodies margins");
    app.add_option("--folder", options.folder, "where scenes with failures are written")
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return run(options);
  } catch (const std::exception& error) {
    std::cerr << "niche_hunt: " << error.what() << '\n';
    return 2;
  }
}

// How often the continuous searches end in the region of the global minimum, option by option.
//
//   continuous_benchmark [--scenes boxes_position_1,...] [--seeds 50] [--methods thesis] [--output
//   continuous.csv]
//
// A row is a scene (of meshes/thesis, or `pit`) and a method; --methods keeps those whose name contains the
// text. Phi: runs whose best point is feasible, within 10 % of the global minimum and below the second one
// (Carretero, sec. 5.1.1), both of them exact (findLocalMinima). error: median of d / d* - 1 over the
// feasible runs. Mflop by the thesis's rule (26 a point pair, 6 a constraint), mean, beside the mean time of
// a run and of G_i.
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/continuous/build_constraint_tree.h"
#include "concave_distance/continuous/continuous_annealing.h"
#include "concave_distance/continuous/continuous_genetic_search.h"
#include "concave_distance/distance/local_minima.h"
#include "continuous/tree_shapes.h"
#include "support/thesis_scenes.h"

namespace concave_distance::benchmark {
namespace {

using Genetic = ContinuousGeneticParameters;
using Annealing = ContinuousAnnealingParameters;

/// A rod that hangs in a pit beside a post: walls and post attract more than the nearer floor does. It showed
/// that crowding and immigrants are needed, which the thesis's scenes do not.
constexpr const char* kPit = "pit";

struct Scene {
  std::string name;
  ConstraintTree a;
  ConstraintTree b;
  Eigen::Isometry3d a_from_b;
  double minimum;         ///< d*, metres
  double region_ends_at;  ///< 1.1 d* or the second minimum, metres
};

struct Method {
  std::string name;
  std::function<ContinuousResult(const Scene&, RandomEngine&)> run;
};

Scene loadScene(const std::string& name) {
  if (name == kPit) {
    Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
    a_from_b.translation() = Eigen::Vector3d(1.25, 1.25, 1.1);
    const double to_floor = 0.1;
    return {name,     test::pitWithPost(), test::boxTree({-0.1, -0.1, 0}, {0.1, 0.1, 3}), a_from_b,
            to_floor, 1.1 * to_floor};
  }
  const test::ThesisScene s = test::loadThesisScene(name, 0.1);
  LocalMinimaRequest request;
  request.cutoff = 1.0;
  const std::vector<LocalMinimum> minima = findLocalMinima(*s.a, *s.b, s.a_from_b, request).niches;
  const double minimum = minima.front().distance;
  // Symmetric bodies have the global minimum in several places, to the files' single precision.
  constexpr double kSame = 1e-5;
  double second = request.cutoff;
  for (const LocalMinimum& niche : minima) {
    if (niche.distance > (1.0 + kSame) * minimum) second = std::min(second, niche.distance);
  }
  return {name,
          buildConstraintTree(s.a->surface(), {}, name + ", a").tree,
          buildConstraintTree(s.b->surface(), {}, name + ", b").tree,
          s.a_from_b,
          minimum,
          std::min(1.1 * minimum, second)};
}

Method genetic(const std::string& name, const Genetic& base,
               const std::function<void(Genetic&)>& change = {}) {
  Genetic p = base;
  if (change) change(p);
  p.validate(name);
  return {name, [p](const Scene& s, RandomEngine& engine) {
            return continuousGeneticSearch(s.a, s.b, s.a_from_b, p, engine);
          }};
}

Method annealing(const std::string& name, const Annealing& base,
                 const std::function<void(Annealing&)>& change = {}) {
  Annealing p = base;
  if (change) change(p);
  p.validate(name);
  return {name, [p](const Scene& s, RandomEngine& engine) {
            return continuousAnnealing(s.a, s.b, s.a_from_b, p, engine);
          }};
}

std::vector<Method> methods() {
  const Genetic thesis = thesisContinuousGenetic();
  const Genetic improved = improvedContinuousGenetic();
  const Annealing thesis_sa = thesisContinuousAnnealing();
  const auto slide = [](auto& p) {
    p.local_step.move = LocalMove::SlideCloser;
    p.local_step.repair = RepairMethod::Project;
  };
  return {
      genetic("cont-GA-nl, thesis", thesis, [](Genetic& p) { p.local_step.enabled = false; }),
      genetic("cont-GA-wl, thesis", thesis),
      genetic("cont-GA-wl, thesis, N_pop 250", thesis, [](Genetic& p) { p.population_size = 250; }),
      genetic("cont-GA-wl, thesis, N_pop 1500", thesis, [](Genetic& p) { p.population_size = 1500; }),
      genetic("thesis + roulette", thesis, [](Genetic& p) { p.selection = SelectionMethod::Roulette; }),
      genetic("thesis + linear mating", thesis,
              [](Genetic& p) { p.mating = ContinuousMating::LinearScaling; }),
      genetic("thesis + Cartesian mutation", thesis, [](Genetic& p) { p.mutation = RandomMove::Cartesian; }),
      genetic("thesis + fixed displacement", thesis, [](Genetic& p) { p.variable_displacement = false; }),
      genetic("thesis + elite 1", thesis, [](Genetic& p) { p.elite_count = 1; }),
      genetic("thesis + feasible preferred", thesis, [](Genetic& p) { p.prefer_feasible = true; }),
      genetic("thesis + projected start", thesis,
              [](Genetic& p) { p.initial_points = InitialPoints::Projected; }),
      genetic("thesis + projection repair", thesis,
              [](Genetic& p) { p.local_step.repair = RepairMethod::Project; }),
      genetic("thesis + sliding", thesis, slide),
      genetic("thesis + sliding, 3 repeats", thesis,
              [&](Genetic& p) {
                slide(p);
                p.local_step.repeats = 3;
              }),
      genetic("thesis + crowding", thesis, [](Genetic& p) { p.deterministic_crowding = true; }),
      genetic("thesis + immigrants 4", thesis, [](Genetic& p) { p.immigrants = 4; }),
      genetic("thesis + 5 repeats", thesis, [](Genetic& p) { p.local_step.repeats = 5; }),
      genetic("thesis + final 50", thesis, [](Genetic& p) { p.final_repeats = 50; }),
      genetic("cont-GA-wl, improved", improved),
      genetic("improved - sliding", improved,
              [&](Genetic& p) {
                p.local_step.move = thesis.local_step.move;
                p.local_step.repair = thesis.local_step.repair;
              }),
      genetic("improved + 3 repeats", improved, [](Genetic& p) { p.local_step.repeats = 3; }),
      genetic("improved - elite", improved, [](Genetic& p) { p.elite_count = 0; }),
      genetic("improved - final 50", improved, [](Genetic& p) { p.final_repeats = 0; }),
      genetic("improved - feasible preferred", improved, [](Genetic& p) { p.prefer_feasible = false; }),
      genetic("improved - crowding", improved, [](Genetic& p) { p.deterministic_crowding = false; }),
      genetic("improved - immigrants", improved, [](Genetic& p) { p.immigrants = 0; }),
      genetic("improved - crowding - immigrants", improved,
              [](Genetic& p) {
                p.deterministic_crowding = false;
                p.immigrants = 0;
              }),
      genetic("improved + projected start", improved,
              [](Genetic& p) { p.initial_points = InitialPoints::Projected; }),
      genetic("improved, N_pop 20", improved, [](Genetic& p) { p.population_size = 20; }),
      genetic("improved, N_pop 40, G_max 30", improved,
              [](Genetic& p) {
                p.population_size = 40;
                p.max_generations = 30;
              }),
      annealing("cont-SA-nl, thesis", thesis_sa, [](Annealing& p) { p.local_step.enabled = false; }),
      annealing("cont-SA-wl, thesis", thesis_sa),
      annealing("thesis SA + Cartesian move", thesis_sa,
                [](Annealing& p) { p.move = RandomMove::Cartesian; }),
      annealing("thesis SA + fixed displacement", thesis_sa,
                [](Annealing& p) { p.variable_displacement = false; }),
      annealing("thesis SA + sliding", thesis_sa, slide),
      annealing("cont-SA-wl, improved", improvedContinuousAnnealing()),
  };
}

struct Row {
  std::uint32_t successes = 0;
  std::uint32_t feasible = 0;
  std::vector<double> errors;
  std::vector<double> best_generations;
  double megaflops = 0.0;
  double milliseconds = 0.0;
};

Row measure(const Scene& scene, const Method& method, std::uint32_t seeds) {
  Row row;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    RandomEngine engine(streamSeed(seed, scene.name, 0));
    const auto start = std::chrono::steady_clock::now();
    const ContinuousResult result = method.run(scene, engine);
    row.milliseconds += 1e-3 * microsecondsSince(start) / seeds;
    row.megaflops += 1e-6 * static_cast<double>(result.cost.flops()) / seeds;
    row.best_generations.push_back(result.best_generation);
    if (result.is_feasible) {
      ++row.feasible;
      row.errors.push_back(result.distance / scene.minimum - 1.0);
      // Whole edges are minima: the last bits of one are no other region.
      row.successes += result.distance < scene.region_ends_at ? 1U : 0U;
    }
  }
  return row;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  std::vector<std::string> scenes = {"boxes_position_1",    "boxes_position_2", "cylinder_position_1",
                                     "cylinder_position_2", "battery_static",   kPit};
  std::uint32_t seeds = 50;
  std::string wanted;
  std::string output;
  CLI::App app("Robustness of the continuous searches", "continuous_benchmark");
  app.add_option("--scenes", scenes, "scenes of meshes/thesis, or pit")->delimiter(',');
  app.add_option("--seeds", seeds, "runs a cell")->capture_default_str();
  app.add_option("--methods", wanted, "only methods whose name contains this");
  app.add_option("--output", output, "CSV file");
  CLI11_PARSE(app, argc, argv);

  std::ofstream csv(output);
  if (csv) csv << "scene,method,runs,phi,feasible,median_error,mean_best_generation,megaflops,milliseconds\n";
  for (const std::string& name : scenes) {
    const Scene scene = loadScene(name);
    std::printf("%s: d* %.5f, region up to %.5f, constraints %zu and %zu\n", name.c_str(), scene.minimum,
                scene.region_ends_at, scene.a.constraints().size(), scene.b.constraints().size());
    for (const Method& method : methods()) {
      if (method.name.find(wanted) == std::string::npos) continue;
      const Row row = measure(scene, method, seeds);
      std::printf("  %-32s Phi %3u/%u  feasible %3u  error %8.1e  G_i %6.1f  %7.2f Mflop %8.2f ms\n",
                  method.name.c_str(), row.successes, seeds, row.feasible, median(row.errors),
                  mean(row.best_generations), row.megaflops, row.milliseconds);
      std::fflush(stdout);
      if (csv) {
        csv << name << ",\"" << method.name << "\"," << seeds << ',' << row.successes << ',' << row.feasible
            << ',' << median(row.errors) << ',' << mean(row.best_generations) << ',' << row.megaflops << ','
            << row.milliseconds << '\n';
      }
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark

// How often the continuous searches end in the region of the global minimum, option by option.
//
//   continuous_benchmark [--scenes boxes_position_1,...] [--seeds 50] [--methods thesis] [--held-out-poses 8]
//                        [--output continuous.csv]
//
// A row is a scene (of meshes/thesis, or `pit`) and a method; --methods keeps those whose name contains the
// text. Phi: runs whose best point is feasible, within 10 % of the global minimum and below the second one
// (Carretero, sec. 5.1.1), both of them exact (findLocalMinima). error: median of d / d* - 1 over the
// feasible runs. Mflop by the thesis's rule (26 a point pair, 6 a constraint), mean, beside the mean time of
// a run and of G_i. The last rows are pairs of bodies at random poses, with a fifth of the seeds at each, for
// the methods that stand for the thesis and for this package: none of these poses was looked at when the
// switches were chosen.
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "thesis/benchmark/support/continuous_scenes.h"
#include "thesis/src/continuous/continuous_annealing.h"
#include "thesis/src/continuous/continuous_genetic_search.h"

namespace concave_distance::benchmark {
namespace {

using Genetic = ContinuousGeneticParameters;
using Annealing = ContinuousAnnealingParameters;
using Scene = ContinuousScene;

struct Method {
  std::string name;
  std::function<ContinuousResult(const Scene&, RandomEngine&)> run;
};

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

/// @param scale of the bodies against the thesis's: for k_p, a length, and k_B t, a squared length
std::vector<Method> methods(double scale) {
  Genetic thesis = thesisContinuousGenetic();
  Genetic improved = improvedContinuousGenetic();
  Annealing thesis_sa = thesisContinuousAnnealing();
  Annealing improved_sa = improvedContinuousAnnealing();
  for (double* k_p : {&thesis.penalty_weight, &improved.penalty_weight, &thesis_sa.penalty_weight,
                      &improved_sa.penalty_weight}) {
    *k_p *= scale;
  }
  for (double* k_b : {&thesis_sa.boltzmann_constant, &improved_sa.boltzmann_constant}) *k_b *= scale * scale;
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
      genetic("thesis + immigrants 4", thesis, [](Genetic& p) { p.random_immigrants = 4; }),
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
      genetic("improved - immigrants", improved, [](Genetic& p) { p.random_immigrants = 0; }),
      genetic("improved - crowding - immigrants", improved,
              [](Genetic& p) {
                p.deterministic_crowding = false;
                p.random_immigrants = 0;
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
      annealing("cont-SA-wl, improved", improved_sa),
  };
}

struct Row {
  std::uint32_t runs = 0;
  std::uint32_t successes = 0;
  std::vector<double> errors;  ///< of feasible runs
  std::vector<double> best_generations;
  std::vector<double> megaflops;
  std::vector<double> milliseconds;
};

/// Adds runs to a row.
void measure(const Scene& scene, const Method& method, std::uint32_t seeds, Row& row) {
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    RandomEngine engine(streamSeed(seed, scene.name, 0));
    const auto start = std::chrono::steady_clock::now();
    const ContinuousResult result = method.run(scene, engine);
    row.milliseconds.push_back(1e-3 * microsecondsSince(start));
    row.megaflops.push_back(1e-6 * static_cast<double>(result.cost.flops()));
    row.best_generations.push_back(result.best_generation);
    ++row.runs;
    if (result.is_feasible) {
      row.errors.push_back(result.distance / scene.minimum - 1.0);
      row.successes += result.distance < scene.region_ends_at ? 1U : 0U;
    }
  }
}

void report(const std::string& scene, const std::string& method, const Row& row, std::ofstream& csv) {
  std::printf("  %-32s Phi %3u/%u  feasible %3zu  error %8.1e  G_i %6.1f  %7.2f Mflop %8.2f ms\n",
              method.c_str(), row.successes, row.runs, row.errors.size(), median(row.errors),
              mean(row.best_generations), mean(row.megaflops), mean(row.milliseconds));
  std::fflush(stdout);
  if (csv) {
    csv << '"' << scene << "\",\"" << method << "\"," << row.runs << ',' << row.successes << ','
        << row.errors.size() << ',' << median(row.errors) << ',' << mean(row.best_generations) << ','
        << mean(row.megaflops) << ',' << mean(row.milliseconds) << '\n';
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  std::vector<std::string> scenes = continuousSceneNames();
  std::uint32_t seeds = 50;
  std::uint32_t held_out_poses = 8;
  std::string wanted;
  std::string output;
  CLI::App app("Robustness of the continuous searches", "continuous_benchmark");
  app.add_option("--scenes", scenes, "scenes of meshes/thesis, or pit")->delimiter(',');
  app.add_option("--seeds", seeds, "runs a cell")->capture_default_str();
  app.add_option("--held-out-poses", held_out_poses, "poses a pair of bodies that no switch was chosen with")
      ->capture_default_str();
  app.add_option("--methods", wanted, "only methods whose name contains this");
  app.add_option("--output", output, "CSV file");
  CLI11_PARSE(app, argc, argv);

  std::ofstream csv(output);
  if (csv) csv << "scene,method,runs,phi,feasible,median_error,mean_best_generation,megaflops,milliseconds\n";
  for (const std::string& name : scenes) {
    const Scene scene = loadContinuousScene(name);
    std::printf("%s: d* %.5f, region up to %.5f, constraints %zu and %zu\n", name.c_str(), scene.minimum,
                scene.region_ends_at, scene.a.constraints().size(), scene.b.constraints().size());
    for (const Method& method : methods(1.0)) {
      if (method.name.find(wanted) == std::string::npos) continue;
      Row row;
      measure(scene, method, seeds, row);
      report(name, method.name, row, csv);
    }
  }
  if (held_out_poses == 0) return 0;
  for (const HeldOutPair& pair : heldOutPairs(held_out_poses)) {
    std::printf("%s: %zu poses\n", pair.name.c_str(), pair.scenes.size());
    // The thesis's bodies are 1 to 3 m across; what is a length is scaled with these against 3 m.
    for (const Method& method : methods(pair.size / 3.0)) {
      const bool is_shown = method.name == "cont-GA-wl, thesis" || method.name == "cont-SA-wl, thesis" ||
                            method.name == "cont-GA-wl, improved" || method.name == "improved, N_pop 20" ||
                            method.name == "cont-SA-wl, improved";
      if (!is_shown || method.name.find(wanted) == std::string::npos) continue;
      Row row;
      for (const Scene& scene : pair.scenes) measure(scene, method, std::max(1U, seeds / 5), row);
      report(pair.name, method.name, row, csv);
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark

#include "benchmark/support/tuning_variants.h"

#include <sstream>

namespace concave_distance::benchmark {
namespace {

/// Sets one parameter to each of some values.
template <typename Value, typename Set>
void addValues(const std::string& name, std::initializer_list<Value> values, Set set,
               std::vector<TuningVariant>& variants) {
  for (const Value value : values) {
    std::ostringstream text;
    text << name << ' ' << value;
    variants.push_back({text.str(), [=](TrackerParameters& p) { set(p, value); }});
  }
}

}  // namespace

std::vector<TuningVariant> searchVariants() {
  using P = TrackerParameters;
  using Count = std::uint32_t;
  std::vector<TuningVariant> v = {{"shipped", [](P&) {}}};
  for (const auto& [population, generations] : {std::pair<Count, Count>{100, 60},
                                                {100, 15},
                                                {100, 5},
                                                {100, 1},
                                                {200, 30},
                                                {50, 30},
                                                {50, 15},
                                                {24, 60},
                                                {24, 1},
                                                {2, 1}}) {
    v.push_back({"N_pop " + std::to_string(population) + ", G_max " + std::to_string(generations),
                 [population = population, generations = generations](P& p) {
                   p.cold.population_size = population;
                   p.cold.max_generations = generations;
                 }});
  }
  addValues<Count>(
      "convergence_generations", {3, 6, 10}, [](P& p, Count n) { p.cold.convergence_generations = n; }, v);
  v.push_back({"descents both_nodes", [](P& p) { p.cold.descent_moves = DescentMoves::BothNodes; }});
  v.push_back({"both_nodes, N_pop 50", [](P& p) {
                 p.cold.descent_moves = DescentMoves::BothNodes;
                 p.cold.population_size = 50;
               }});
  addValues<double>(
      "crossover_probability", {0.3, 0.9}, [](P& p, double x) { p.cold.crossover_probability = x; }, v);
  addValues<double>(
      "mutation_probability", {0.0, 0.05, 0.2}, [](P& p, double x) { p.cold.mutation_probability = x; }, v);
  addValues<double>(
      "exchange_probability", {0.0, 0.4, 1.0}, [](P& p, double x) { p.cold.exchange_probability = x; }, v);
  addValues<Count>(
      "immigrants", {0, 10, 20}, [](P& p, Count n) { p.cold.immigrants = n; }, v);
  addValues<double>(
      "sharing_exponent", {2.0, 10.0}, [](P& p, double x) { p.cold.sharing_exponent = x; }, v);
  v.push_back({"no mating restriction", [](P& p) { p.cold.mating_restriction = false; }});
  v.push_back({"niches not conserved", [](P& p) { p.cold.conserve_niches = false; }});
  v.push_back({"dynamic sharing", [](P& p) { p.cold.niching = NichingMethod::DynamicSharing; }});
  v.push_back({"deterministic crowding", [](P& p) {
                 p.cold.niching = NichingMethod::DeterministicCrowding;
                 p.cold.mating_restriction = false;
               }});
  for (const auto& [population, immigrants] :
       {std::pair<Count, Count>{200, 5}, {200, 10}, {400, 5}, {300, 20}}) {
    v.push_back(
        {"crowding, N_pop " + std::to_string(population) + ", immigrants " + std::to_string(immigrants),
         [population = population, immigrants = immigrants](P& p) {
           p.cold.niching = NichingMethod::DeterministicCrowding;
           p.cold.mating_restriction = false;
           p.cold.population_size = population;
           p.cold.immigrants = immigrants;
         }});
  }
  v.push_back({"N_pop 200, both_nodes", [](P& p) {
                 p.cold.population_size = 200;
                 p.cold.descent_moves = DescentMoves::BothNodes;
               }});
  v.push_back({"N_pop 200, immigrants 10, p_x 0.9", [](P& p) {
                 p.cold.population_size = 200;
                 p.cold.immigrants = 10;
                 p.cold.crossover_probability = 0.9;
               }});
  return v;
}

std::vector<TuningVariant> cycleVariants() {
  using P = TrackerParameters;
  using Count = std::uint32_t;
  std::vector<TuningVariant> v = {{"shipped", [](P&) {}}};
  v.push_back({"no evolution", [](P& p) {  // what is inherited is descended, and nothing else
                 p.warm.population_size = 2;
                 p.warm.max_generations = 1;
                 p.immigrants = 0;
                 p.inherited_limit = 0;
               }});
  addValues<Count>(
      "warm N_pop", {8, 16, 48}, [](P& p, Count n) { p.warm.population_size = n; }, v);
  addValues<Count>(
      "warm G_max", {2, 4}, [](P& p, Count n) { p.warm.max_generations = n; }, v);
  v.push_back({"warm both_nodes", [](P& p) { p.warm.descent_moves = DescentMoves::BothNodes; }});
  addValues<double>(
      "inherited_per_niche", {1.0, 6.0}, [](P& p, double x) { p.inherited_per_niche = x; }, v);
  addValues<Count>(
      "inherited_limit", {10, 60}, [](P& p, Count n) { p.inherited_limit = n; }, v);
  addValues<Count>(
      "tracker immigrants", {0, 4, 16}, [](P& p, Count n) { p.immigrants = n; }, v);
  addValues<Count>(
      "projected_niches", {0, 1, 8}, [](P& p, Count n) { p.projected_niches = n; }, v);
  addValues<Count>(
      "projected_immigrants", {0, 16}, [](P& p, Count n) { p.projected_immigrants = n; }, v);
  addValues<double>(
      "search_motion", {0.1, 0.25, 1.0, 2.0}, [](P& p, double x) { p.search_motion = x; }, v);
  addValues<Count>(
      "search_interval", {2, 8, 16}, [](P& p, Count n) { p.search_interval = n; }, v);
  addValues<Count>(
      "swept_cones", {0, 250, 500, 2000, 4000}, [](P& p, Count n) { p.swept_cones = n; }, v);
  addValues<Count>(
      "reviewed_niches", {0, 2, 4}, [](P& p, Count n) { p.reviewed_niches = n; }, v);
  v.push_back({"no extrapolation", [](P& p) { p.extrapolate = false; }});
  v.push_back({"no evolution, swept_cones 2000", [](P& p) {
                 p.warm.population_size = 2;
                 p.immigrants = 0;
                 p.inherited_limit = 0;
                 p.swept_cones = 2000;
               }});
  v.push_back({"no projections", [](P& p) { p.projected_niches = p.projected_immigrants = 0; }});
  const auto leaner = [&v](Count projected, double motion, Count interval, Count cones) {
    std::ostringstream text;
    text << "projected " << projected << ", motion " << motion << ", interval " << interval << ", cones "
         << cones << ", N_pop 16";
    v.push_back({text.str(), [=](P& p) {
                   p.projected_niches = projected;
                   p.projected_immigrants = 4 * projected;
                   p.search_motion = motion;
                   p.search_interval = interval;
                   p.swept_cones = cones;
                   p.warm.population_size = 16;
                 }});
  };
  for (const Count projected : {0, 1}) {
    leaner(projected, 0.5, 8, 1000);
    leaner(projected, 0.5, 16, 1000);
    leaner(projected, 0.5, 16, 2000);
    leaner(projected, 0.5, 16, 3000);
    leaner(projected, 0.5, 16, 4000);
    leaner(projected, 0.25, 16, 1000);
    leaner(projected, 0.25, 16, 2000);
  }
  return v;
}

}  // namespace concave_distance::benchmark

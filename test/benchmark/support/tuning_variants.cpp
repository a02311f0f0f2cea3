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
  std::vector<TuningVariant> v = {{"shipped", [](P&) {}}, {"before", [](P& p) { p.cold = {}; }}};
  v.push_back({"sharing", [](P& p) {
                 p.cold.niching = NichingMethod::Sharing;
                 p.cold.mating_restriction = true;
               }});
  v.push_back({"dynamic sharing", [](P& p) {
                 p.cold.niching = NichingMethod::DynamicSharing;
                 p.cold.mating_restriction = true;
               }});
  addValues<Count>(
      "N_pop", {2, 24, 50, 100, 200, 400}, [](P& p, Count n) { p.cold.population_size = n; }, v);
  addValues<Count>(
      "G_max", {1, 5, 15, 60}, [](P& p, Count n) { p.cold.max_generations = n; }, v);
  addValues<Count>(
      "convergence_generations", {3, 6, 10}, [](P& p, Count n) { p.cold.convergence_generations = n; }, v);
  v.push_back({"descents both_nodes", [](P& p) { p.cold.descent_moves = DescentMoves::BothNodes; }});
  addValues<double>(
      "crossover_probability", {0.3, 0.9}, [](P& p, double x) { p.cold.crossover_probability = x; }, v);
  addValues<double>(
      "mutation_probability", {0.0, 0.05, 0.2}, [](P& p, double x) { p.cold.mutation_probability = x; }, v);
  addValues<double>(
      "exchange_probability", {0.0, 0.4, 1.0}, [](P& p, double x) { p.cold.exchange_probability = x; }, v);
  addValues<Count>(
      "immigrants", {0, 5, 10, 40}, [](P& p, Count n) { p.cold.random_immigrants = n; }, v);
  v.push_back({"mating restriction", [](P& p) { p.cold.mating_restriction = true; }});
  return v;
}

std::vector<TuningVariant> cycleVariants() {
  using P = TrackerParameters;
  using Count = std::uint32_t;
  std::vector<TuningVariant> v = {{"shipped", [](P&) {}},
                                  {"before", [](P& p) { p.warm.population_size = 24; }},
                                  {"no evolution", [](P& p) {
                                     p.warm.population_size = 2;
                                     p.random_starts = 0;
                                     p.inherited_limit = 0;
                                   }}};
  addValues<Count>(
      "warm N_pop", {8, 48}, [](P& p, Count n) { p.warm.population_size = n; }, v);
  addValues<Count>(
      "warm G_max", {2, 4}, [](P& p, Count n) { p.warm.max_generations = n; }, v);
  v.push_back({"warm both_nodes", [](P& p) { p.warm.descent_moves = DescentMoves::BothNodes; }});
  addValues<double>(
      "inherited_per_niche", {1.0, 6.0}, [](P& p, double x) { p.inherited_per_niche = x; }, v);
  addValues<Count>(
      "inherited_limit", {10, 60}, [](P& p, Count n) { p.inherited_limit = n; }, v);
  addValues<Count>(
      "immigrants", {0, 4, 16}, [](P& p, Count n) { p.random_starts = n; }, v);
  return v;
}

std::vector<TuningVariant> shareVariants() {
  using P = TrackerParameters;
  std::vector<TuningVariant> v = {{"shipped", [](P&) {}}};
  addValues<double>(
      "search_share", {0.0, 0.3, 1.0}, [](P& p, double x) { p.search_share = x; }, v);
  return v;
}

}  // namespace concave_distance::benchmark

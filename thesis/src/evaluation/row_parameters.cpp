#include "row_parameters.h"

#include <utility>

#include "base/csv_writer.h"
#include "base/parameter.h"
#include "inheriting_search.h"
#include "search/genetic_parameter_table.h"
#include "thesis/src/genetic/comb_ga_parameter_table.h"
#include "tracking/tracker_parameter_table.h"

namespace concave_distance::evaluation {
namespace {

const char* nameOf(ContinuousMating mating) {
  switch (mating) {
    case ContinuousMating::LinearScaling:
      return "linear_scaling";
    case ContinuousMating::FitnessWeighted:
      return "fitness_weighted";
    case ContinuousMating::FitnessWeightedTwice:
      return "fitness_weighted_twice";
  }
  return "";
}

using RowParameters = std::vector<RowParameter>;

std::string text(double value) {
  return toText(ParameterValue(value));
}
std::string text(bool value) {
  return value ? "true" : "false";
}
std::string text(std::uint64_t value) {
  return std::to_string(value);
}
std::string text(std::uint32_t value) {
  return std::to_string(value);
}

template <typename Settings>
RowParameters allOf(const ParameterTable<Settings>& table, const Settings& settings) {
  RowParameters all;
  for (const Parameter<Settings>& parameter : table) {
    all.emplace_back(parameter.info.name, toText(parameter.get(settings)));
  }
  return all;
}

/// What differs from the defaults.
template <typename Settings>
void addChanges(const ParameterTable<Settings>& table, const Settings& settings, const Settings& defaults,
                const std::string& prefix, RowParameters& changes) {
  for (const Parameter<Settings>& parameter : table) {
    const std::string value = toText(parameter.get(settings));
    if (value != toText(parameter.get(defaults))) changes.emplace_back(prefix + parameter.info.name, value);
  }
}

const char* nameOf(DescentMoves moves) {
  switch (moves) {
    case DescentMoves::OneNode:
      return "one_node";
    case DescentMoves::BothNodes:
      return "both_nodes";
  }
  return "";
}

void addLocalStep(const LocalStepParameters& p, RowParameters& all) {
  if (!p.enabled) return;
  all.emplace_back("local_step", p.move == LocalMove::MoveCloser ? "move_closer" : "slide_closer");
  all.emplace_back("repair", p.repair == RepairMethod::SafeMoveAway ? "safe_move_away"
                             : p.repair == RepairMethod::MoveAway   ? "move_away"
                                                                    : "project");
  all.emplace_back("repair_scale", text(p.repair_scale));
  all.emplace_back("repeats", text(p.repeats));
}

/// Every parameter of a method of any kind.
struct Describer {
  RowParameters operator()(const CombGaParameters& p) const { return allOf(combGaParameters(), p); }

  RowParameters operator()(const AnnealingParameters& p) const {
    return {{"initial_temperature", text(p.initial_temperature)},
            {"boltzmann_constant", text(p.boltzmann_constant)},
            {"move", p.move == AnnealingMove::NewPoint ? "new_point" : "random_move"},
            {"move_radius", p.move_radius ? text(*p.move_radius) : "auto"},
            {"variable_displacement", text(p.variable_displacement)},
            {"new_point_probability", text(p.new_point_probability)},
            {"local_optimization", text(p.local_optimization)},
            {"descent_moves", nameOf(p.descent_moves)},
            {"evaluation_limit", text(p.evaluation_limit)}};
  }

  RowParameters operator()(const MultiStartParameters& p) const {
    return {{"starts", text(p.starts)}, {"evaluation_limit", text(p.evaluation_limit)}};
  }

  RowParameters operator()(const IslandParameters& p) const {
    RowParameters all = {
        {"islands", text(p.islands)}, {"epochs", text(p.epochs)}, {"migrants", text(p.migrants)}};
    for (RowParameter& parameter : allOf(combGaParameters(), p.genetic)) all.push_back(std::move(parameter));
    return all;
  }

  RowParameters operator()(const SearchMethod& method) const { return std::visit(*this, method); }

  RowParameters operator()(const ContinuousGeneticParameters& p) const {
    RowParameters all = {
        {"population_size", text(p.population_size)},
        {"max_generations", text(p.max_generations)},
        {"crossover_probability", text(p.crossover_probability)},
        {"mutation_probability", p.mutation_probability ? text(*p.mutation_probability) : "auto"},
        {"penalty_weight", text(p.penalty_weight)},
        {"selection",
         p.selection == SelectionMethod::Roulette ? "roulette" : "stochastic_universal_sampling"},
        {"mating", nameOf(p.mating)},
        {"mutation", p.mutation == RandomMove::Cartesian ? "cartesian" : "random_direction"},
        {"variable_displacement", text(p.variable_displacement)},
        {"initial_points", p.initial_points == InitialPoints::Projected ? "projected" : "bounding_boxes"},
        {"elite_count", text(p.elite_count)},
        {"deterministic_crowding", text(p.deterministic_crowding)},
        {"random_immigrants", text(p.random_immigrants)},
        {"prefer_feasible", text(p.prefer_feasible)},
        {"final_repeats", text(p.final_repeats)}};
    addLocalStep(p.local_step, all);
    return all;
  }

  RowParameters operator()(const ContinuousAnnealingParameters& p) const {
    RowParameters all = {
        {"initial_temperature", text(p.initial_temperature)},
        {"boltzmann_constant", text(p.boltzmann_constant)},
        {"penalty_weight", text(p.penalty_weight)},
        {"move", p.move == RandomMove::Cartesian ? "cartesian" : "random_direction"},
        {"variable_displacement", text(p.variable_displacement)},
        {"initial_points", p.initial_points == InitialPoints::Projected ? "projected" : "bounding_boxes"},
        {"prefer_feasible", text(p.prefer_feasible)},
        {"final_repeats", text(p.final_repeats)}};
    addLocalStep(p.local_step, all);
    return all;
  }

  RowParameters operator()(const TrackerMethod& method) const {
    const TrackerParameters shipped;
    RowParameters changes;
    if (method.forgets) changes.emplace_back("forgets", "true");
    addChanges(trackerParameters(), method.parameters, shipped, "", changes);
    addChanges(geneticParameters(), method.parameters.cold, shipped.cold, "cold.", changes);
    addChanges(geneticParameters(), method.parameters.warm, shipped.warm, "warm.", changes);
    return changes;
  }

  RowParameters operator()(const EnumerationMethod&) const { return {}; }
};

bool isGenetic(const Method& method) {
  const auto* search = std::get_if<SearchMethod>(&method);
  return search != nullptr && geneticOf(*search) != nullptr;
}

void addFirstGuess(const FirstGuess& guess, RowParameters& all) {
  if (guess.fixed_per_niche) {
    all.emplace_back("inheritance.fixed_per_niche", text(*guess.fixed_per_niche));
  } else {
    all.emplace_back("inheritance.per_niche", text(guess.inheritance.per_niche));
    all.emplace_back("inheritance.limit", text(guess.inheritance.limit));
    all.emplace_back("inheritance.one_each", text(guess.inheritance.one_each));
  }
  if (guess.extrapolation != Extrapolation::None) {
    all.emplace_back("inheritance.extrapolation",
                     guess.extrapolation == Extrapolation::Velocity ? "velocity" : "acceleration");
  }
  if (guess.random_starts) all.emplace_back("random_starts", text(*guess.random_starts));
}

/// Of all instants but the first.
void addFurther(const SearchMethod& method, RowParameters& all) {
  for (auto& [name, value] : std::visit(Describer{}, method)) all.emplace_back("further." + name, value);
}

}  // namespace

std::vector<RowParameter> rowParameters(const ExperimentRow& row, const ExperimentScene& scene) {
  RowParameters all = std::visit(Describer{}, row.methodOn(scene));
  if (scene.isMotion() && isGenetic(row.method)) {
    if (row.motion.further) addFurther(*row.motion.further, all);
    addFirstGuess(row.motion.guess, all);
  }
  return all;
}

void writeRows(const Experiment& experiment, const std::string& folder) {
  CsvFile file(folder + "/" + experiment.name + "_rows.csv", "row,algorithm,scene,parameters");
  for (const ExperimentRow& row : experiment.rows) {
    for (const ExperimentScene& scene : experiment.scenes) {
      std::string parameters;
      for (const auto& [name, value] : rowParameters(row, scene)) {
        parameters += (parameters.empty() ? "" : "; ") + name + "=" + value;
      }
      file.cells() << row.name << nameOf(row.method) << scene.name << parameters;
      file.cells().endLine();
    }
  }
  file.finish();
}

}  // namespace concave_distance::evaluation

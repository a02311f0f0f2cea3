#include "continuous_parameters.h"

#include <cmath>

#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

template <typename Value>
void require(bool is_right, const std::string& where, const char* name, Value value, const char* range) {
  if (!is_right) {
    throw Error(where, std::string(name) + " is " + std::to_string(value), std::string("give ") + range);
  }
}

bool isProbability(double value) {
  return value >= 0.0 && value <= 1.0;
}

void validateLocalStep(const LocalStepParameters& p, const std::string& where) {
  require(p.repair_scale > 0.0 && std::isfinite(p.repair_scale), where, "repair_scale", p.repair_scale,
          "a number above 0 (the thesis: 1.5)");
  require(p.repeats >= 1, where, "repeats", p.repeats, "at least 1, or switch local_step off");
  require(p.projections >= 1, where, "projections", p.projections, "at least 1");
}

LocalStepParameters improvedLocalStep() {
  LocalStepParameters step;
  step.move = LocalMove::SlideCloser;
  step.repair = RepairMethod::Project;
  return step;
}

}  // namespace

void ContinuousGeneticParameters::validate(const std::string& where) const {
  require(population_size >= 2 && population_size % 2 == 0, where, "population_size", population_size,
          "an even number of at least 2");
  require(max_generations >= 1, where, "max_generations", max_generations, "at least 1");
  require(isProbability(crossover_probability), where, "crossover_probability", crossover_probability,
          "a number in [0, 1]");
  if (mutation_probability) {
    require(isProbability(*mutation_probability), where, "mutation_probability", *mutation_probability,
            "a number in [0, 1]");
  }
  require(penalty_weight >= 0.0 && std::isfinite(penalty_weight), where, "penalty_weight", penalty_weight,
          "a length of at least 0, metres");
  require(elite_count < population_size, where, "elite_count", elite_count, "less than population_size");
  require(random_immigrants < population_size, where, "random_immigrants", random_immigrants,
          "less than population_size");
  validateLocalStep(local_step, where);
}

ContinuousGeneticParameters thesisContinuousGenetic() {
  return {};
}

ContinuousGeneticParameters improvedContinuousGenetic() {
  ContinuousGeneticParameters p;
  p.local_step = improvedLocalStep();
  p.elite_count = 1;
  p.deterministic_crowding = true;
  p.random_immigrants = 4;
  p.prefer_feasible = true;
  p.final_repeats = 50;
  return p;
}

void ContinuousAnnealingParameters::validate(const std::string& where) const {
  require(initial_temperature >= 1, where, "initial_temperature", initial_temperature, "at least 1");
  require(boltzmann_constant > 0.0 && std::isfinite(boltzmann_constant), where, "boltzmann_constant",
          boltzmann_constant, "a number above 0");
  require(penalty_weight >= 0.0 && std::isfinite(penalty_weight), where, "penalty_weight", penalty_weight,
          "a length of at least 0, metres");
  validateLocalStep(local_step, where);
}

ContinuousAnnealingParameters thesisContinuousAnnealing() {
  return {};
}

ContinuousAnnealingParameters improvedContinuousAnnealing() {
  ContinuousAnnealingParameters p;
  p.local_step = improvedLocalStep();
  p.local_step.repeats = 3;
  p.prefer_feasible = true;
  p.final_repeats = 50;
  return p;
}

}  // namespace concave_distance

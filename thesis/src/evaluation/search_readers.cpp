#include "search_readers.h"

#include <cmath>
#include <limits>

#include "experiment_values.h"
#include "loading/parameter_map.h"
#include "thesis/src/genetic/comb_ga_parameter_table.h"

namespace concave_distance::evaluation {

using detail::count32;
using detail::YamlMap;
using detail::YamlValue;

namespace {

constexpr std::pair<const char*, Extrapolation> kExtrapolations[] = {
    {"none", Extrapolation::None},
    {"velocity", Extrapolation::Velocity},
    {"acceleration", Extrapolation::Acceleration}};

}  // namespace

FirstGuess readFirstGuess(const YamlValue& value, FirstGuess guess) {
  YamlMap map(value, "what a population inherits: {per_niche: 3, limit: 30, one_each: true}");
  Inheritance& inheritance = guess.inheritance;
  if (auto v = map.take("per_niche")) {
    inheritance.per_niche = v->number("1 or more", [](double n) { return n >= 1.0 && std::isfinite(n); });
  }
  if (auto v = map.take("limit")) inheritance.limit = count32(*v, 0);
  if (auto v = map.take("one_each")) inheritance.one_each = v->boolean();
  if (auto v = map.take("fixed_per_niche")) guess.fixed_per_niche = count32(*v, 1);
  if (auto v = map.take("extrapolation")) guess.extrapolation = v->choice(kExtrapolations);
  map.finish();
  return guess;
}

void readCombGa(const YamlValue& value, CombGaParameters& p) {
  YamlMap map(value, "a map of parameters of the genetic algorithm");
  detail::readParameters(map, combGaParameters(), false, p);
  map.finish();
}

void readIslands(const YamlValue& value, IslandParameters& p) {
  YamlMap map(value, "a map of parameters of islands");
  if (auto v = map.take("islands")) p.islands = count32(*v, 1);
  if (auto v = map.take("epochs")) p.epochs = count32(*v, 1);
  if (auto v = map.take("migrants")) p.migrants = count32(*v, 0);
  if (auto v = map.take("genetic")) readCombGa(*v, p.genetic);
  map.finish();
}

void readMultiStart(const YamlValue& value, MultiStartParameters& p) {
  YamlMap map(value, "a map of parameters of random starts");
  if (auto v = map.take("starts")) p.starts = count32(*v, 1);
  if (auto v = map.take("evaluation_limit")) {
    p.evaluation_limit = v->count(0, std::numeric_limits<std::uint64_t>::max());
  }
  map.finish();
}

}  // namespace concave_distance::evaluation

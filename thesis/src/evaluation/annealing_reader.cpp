#include "annealing_reader.h"
#include "experiment_values.h"

#include <limits>

namespace concave_distance::detail {
namespace {

constexpr std::pair<const char*, DescentMoves> kDescentMoves[] = {{"one_node", DescentMoves::OneNode},
                                                                  {"both_nodes", DescentMoves::BothNodes}};
constexpr std::pair<const char*, AnnealingMove> kAnnealingMoves[] = {
    {"new_point", AnnealingMove::NewPoint}, {"random_move", AnnealingMove::RandomMove}};

}  // namespace

void readAnnealingParameters(const YamlValue& value, AnnealingParameters& p) {
  YamlMap map(value, "a map of parameters of the annealing");
  if (auto v = map.take("initial_temperature")) p.initial_temperature = count32(*v, 1);
  if (auto v = map.take("boltzmann_constant")) {
    p.boltzmann_constant = v->number("0 or more, square metres", notNegativeFinite);
  }
  if (auto v = map.take("move")) p.move = v->choice(kAnnealingMoves);
  if (auto v = map.take("move_radius")) p.move_radius = optionalNumber(*v, "auto", kLength, positiveFinite);
  if (auto v = map.take("variable_displacement")) p.variable_displacement = v->boolean();
  if (auto v = map.take("new_point_probability")) p.new_point_probability = v->number(kShare, share);
  if (auto v = map.take("descent_moves")) p.descent_moves = v->choice(kDescentMoves);
  if (auto v = map.take("evaluation_limit")) {
    p.evaluation_limit = v->count(0, std::numeric_limits<std::uint64_t>::max());
  }
  map.finish();
}

}  // namespace concave_distance::detail

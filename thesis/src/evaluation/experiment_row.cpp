#include "experiment.h"

namespace concave_distance::evaluation {
namespace {

/// Sets what a scene wants of a search.
struct SceneSettings {
  const ExperimentScene& scene;
  bool has_own_limit;
  bool has_own_population;

  void operator()(CombGaParameters& p) const {
    if (scene.population_size && !has_own_population) p.population_size = *scene.population_size;
    limit(p.evaluation_limit);
  }
  void operator()(AnnealingParameters& p) const { limit(p.evaluation_limit); }
  void operator()(MultiStartParameters& p) const { limit(p.evaluation_limit); }
  void operator()(IslandParameters& p) const { (*this)(p.genetic); }
  void limit(std::uint64_t& evaluations) const {
    if (scene.evaluation_limit && !has_own_limit) evaluations = *scene.evaluation_limit;
  }
};

}  // namespace

std::string nameOf(const Method& method) {
  if (const auto* genetic = std::get_if<ContinuousGeneticParameters>(&method)) {
    return genetic->local_step.enabled ? "cont-GA-wl" : "cont-GA-nl";
  }
  if (const auto* annealing = std::get_if<ContinuousAnnealingParameters>(&method)) {
    return annealing->local_step.enabled ? "cont-SA-wl" : "cont-SA-nl";
  }
  if (std::holds_alternative<TrackerMethod>(method)) return "tracker";
  if (std::holds_alternative<EnumerationMethod>(method)) return "enumeration";
  return concave_distance::nameOf(std::get<SearchMethod>(method));
}

Method ExperimentRow::methodOn(const ExperimentScene& scene) const {
  Method changed = method;
  if (auto* search = std::get_if<SearchMethod>(&changed)) {
    const bool is_shipped = base == RowBase::Shipped || base == RowBase::ShippedCycles;
    std::visit(SceneSettings{scene, has_own_limit, is_shipped}, *search);
  }
  return changed;
}

}  // namespace concave_distance::evaluation

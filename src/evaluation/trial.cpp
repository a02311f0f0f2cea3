#include "trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "concave_distance/search/automatic_radii.h"
#include "concave_distance/search/niche_identification.h"

namespace concave_distance::evaluation {
namespace {

using Clock = std::chrono::steady_clock;

/// Distances are sums of squares rounded alike; two node pairs are as good when only rounding parts them.
constexpr double kSame = 1.0 + 1e-12;
NicheRadii radiiOf(const SceneTruth& scene, const SearchMethod& method) {
  const auto* genetic = std::get_if<GeneticParameters>(&method);
  return automaticRadii(*scene.a, *scene.b, genetic != nullptr ? *genetic : GeneticParameters());
}

/// Adds up what a run shows on its way.
class Observer {
 public:
  Observer(const NicheRadii& radii, std::uint32_t stride, SearchWorkspace& workspace,
           std::vector<CurvePoint>* curve)
      : radii_(radii), stride_(stride), workspace_(workspace), curve_(curve) {}

  void operator()(const SearchRecord& record) {
    const Clock::time_point start = Clock::now();
    look(record);
    microseconds_ += std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  }

  double bestConvergence() const { return count_ > 0 ? best_sum_ / count_ : 0.0; }
  double populationConvergence() const { return count_ > 0 ? mean_sum_ / count_ : 0.0; }
  double microseconds() const { return microseconds_; }  ///< spent looking

 private:
  void look(const SearchRecord& record) {
    double sum = 0.0;
    for (std::size_t i = 0; i < record.point_count; ++i) sum += record.points[i].squared_distance;
    const double mean = sum / static_cast<double>(record.point_count);
    if (record.iteration > 0) {
      best_sum_ += record.best_so_far->squared_distance;
      mean_sum_ += mean;
      ++count_;
    }
    if (curve_ == nullptr || record.iteration % stride_ != 0) return;
    const std::size_t place = record.iteration / stride_;
    if (curve_->size() <= place) curve_->resize(place + 1);
    CurvePoint& point = (*curve_)[place];
    point.best_distance += std::sqrt(record.best_so_far->squared_distance);
    point.mean_square += mean;
    point.acceptance += record.acceptance_probability;
    if (record.point_count > 1) {
      population_.assign(record.points, record.points + record.point_count);
      identifyNiches(population_, radii_.niche, workspace_.metric, niches_, order_);
      point.niches += static_cast<double>(niches_.size());
    }
  }

  const NicheRadii& radii_;
  std::uint32_t stride_;
  SearchWorkspace& workspace_;
  std::vector<CurvePoint>* curve_;
  double best_sum_ = 0.0;
  double mean_sum_ = 0.0;
  double count_ = 0.0;
  double microseconds_ = 0.0;
  std::vector<TrialPoint> population_;
  std::vector<IdentifiedNiche> niches_;
  std::vector<std::uint32_t> order_;
};

/// Which true niches the identified ones are, decided by the flood that made the truth.
void measureRecall(const SceneTruth& scene, const std::vector<IdentifiedNiche>& found, TrialRecord& record) {
  LocalMinimaRequest request;
  request.cutoff = scene.niche_cutoff;
  for (const IdentifiedNiche& niche : found) {
    request.whose.emplace_back(scene.a->originalTriangle(niche.best.node_a),
                               scene.b->originalTriangle(niche.best.node_b));
  }
  const LocalMinima truth = findLocalMinima(*scene.a, *scene.b, scene.a_from_b, request);
  std::set<std::size_t> met(truth.owners.begin(), truth.owners.end());
  met.erase(LocalMinima::kNoOwner);
  const auto share = [&](std::size_t of) {
    return of > 0 ? static_cast<double>(met.size()) / static_cast<double>(of) : 1.0;
  };
  record.recall = share(truth.niches.size());
  record.precision = share(found.size());
}

}  // namespace

std::uint32_t curveStride(const SearchMethod& method) {
  return std::holds_alternative<AnnealingParameters>(method) ? 10 : 1;
}

TrialRecord runTrial(const Experiment& experiment, const ExperimentRow& row, const SceneTruth& scene,
                     std::uint32_t run, SearchWorkspace& workspace, std::vector<CurvePoint>* curve) {
  const NicheRadii radii = radiiOf(scene, row.method);
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  Observer observer(radii, curveStride(row.method), workspace, curve);
  RandomEngine engine(streamSeed(experiment.seed, "evaluate", run));
  workspace.basins.clear();
  const Clock::time_point start = Clock::now();
  const SearchOutcome outcome = searchPair(objective, row.method, radii, engine, workspace,
                                           [&observer](const SearchRecord& record) { observer(record); });
  TrialRecord record;
  record.microseconds =
      std::chrono::duration<double, std::micro>(Clock::now() - start).count() - observer.microseconds();
  record.distance = std::sqrt(outcome.best.squared_distance);
  record.best_iteration = outcome.best_iteration;
  record.exact = record.distance <= scene.node_distance * kSame;
  record.region = record.exact || record.distance < scene.region_limit;
  const double global = scene.node_distance * scene.node_distance;
  record.best_convergence = observer.bestConvergence() / global;
  record.population_convergence = observer.populationConvergence() / global;
  record.cost = outcome.cost;
  std::vector<IdentifiedNiche>& niches = workspace.niches;
  identifyNiches(workspace.population, radii.niche, workspace.metric, niches, workspace.order);
  record.niches = static_cast<std::uint32_t>(niches.size());
  for (std::size_t i = 0; i < std::min(niches.size(), record.members.size()); ++i) {
    record.members[i] = niches[i].member_count;
    record.niche_distances[i] = std::sqrt(niches[i].best.squared_distance);
  }
  if (experiment.niches) measureRecall(scene, niches, record);
  return record;
}

}  // namespace concave_distance::evaluation

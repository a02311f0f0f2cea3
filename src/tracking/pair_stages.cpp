#include "pair_stages.h"

#include "distance/niches/niche_properties.h"
#include "mesh/trees/normal_cone_tree.h"
#include "node_niches.h"
#include "search_stage.h"

namespace concave_distance {
namespace {

using detail::ConvexNiches;

constexpr std::size_t kUsualNiches = 256;

// Shares of a time budget, each of the whole time and with the stages before it.
constexpr double kShareOfSearch = 0.55;
constexpr double kShareOfNiches = 0.95;

}  // namespace

PairStages::PairStages(std::string name, std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
                       const TrackerParameters& parameters, double pose_error)
    : name_(std::move(name)),
      a_(std::move(a)),
      b_(std::move(b)),
      parameters_(parameters),
      pose_error_(pose_error),
      search_(*a_, *b_) {
  parameters_.validate(name_);
}

void PairStages::begin(const Eigen::Isometry3d& pose) {
  frame_.emplace(*a_, *b_, pose);
  clock_.start();
}

void PairStages::prove(PairSolution& solution, WorkLimit& limit) {
  std::optional<TrianglePair> nearest;
  if (wantsNiches() && !records().empty()) {
    const WitnessPair& witness = records().front().niche.witness;
    nearest = TrianglePair{witness.triangle_a, witness.triangle_b};
  }
  distance_before_ = cycle_.is_first ? kNotComputed : proof_.certificate().distance;
  proof_.prove(*frame_, parameters_, nearest, cycle_.since_last.displacement, limit);
  clock_.lap(SolveStage::Prove, solution.stages);
}

void PairStages::findNiches(PairSolution& solution, WorkLimit& limit) {
  if (isRound()) {
    solveRound(cycle_.since_niches, solution, limit);
  } else if (isExact()) {
    solveExact(cycle_.since_niches, solution, limit);
  } else {
    solveNodes(cycle_.since_niches, solution, limit);
  }
}

void PairStages::solveNodes(const Passed& passed, PairSolution& solution, WorkLimit& limit) {
  limit.allowShare(kShareOfNiches);
  search_.begin(*a_, *b_, parameters_);
  followNodePairs(*frame_, search_, passed.displacement, passed.elapsed, archive_, solution.cost, limit);
  clock_.lap(SolveStage::Follow, solution.stages);
  known_.clear();
  for (const NicheRecord& record : archive_.records()) known_.push_back(record.niche.node_pair);
  const std::vector<TrialPoint>& found =
      search_.propose(*frame_, parameters_, known_,
                      {name_, cycle_.number, cycle_.is_warm, false, cycle_.is_warm}, solution.cost, limit);
  clock_.lap(SolveStage::Propose, solution.stages);
  admitNodePairs(*frame_, parameters_, search_, found, cycle_.is_warm, cycle_.number, archive_, solution);
  clock_.lap(SolveStage::Admit, solution.stages);
}

void PairStages::solveExact(const Passed& passed, PairSolution& solution, WorkLimit& limit) {
  if (niches_.isUnchanged(passed.displacement)) return archive_.keepUnchanged(passed.elapsed);
  frame_->openFacets();
  frame_->pose_error = pose_error_;
  const ConvexNiches convex = countConvexNiches();
  const bool are_counted = convex != ConvexNiches::Unknown;
  if (!is_search_prepared_ && !are_counted && cycle_.is_tracked && parameters_.search_share > 0.0) prepare();
  limit.allowShare(kShareOfSearch);
  if (!proves()) niches_.follow(*frame_, archive_, limit);
  clock_.lap(SolveStage::Follow, solution.stages);
  if (!are_counted && searchIsDue(limit)) propose(solution.cost, limit);
  if (proves() && (!proof_.isPenetrating() || convex == ConvexNiches::OnlyTheNearest)) {
    niches_.proposeProven(*frame_, provenOnMeshes(), proof_.isPenetrating());
  }
  clock_.lap(SolveStage::Propose, solution.stages);
  niches_.admit(*frame_, parameters_,
                {cycle_.number, cycle_.last_niches_pose, passed.elapsed, cycle_.is_tracked, cutoffOfMeshes(),
                 convex, cycle_.ends_first},
                certainDistance(), kShareOfNiches, archive_, solution, limit);
  search_.earn(niches_.evolved(), niches_.work(), parameters_.search_share);
  clock_.lap(SolveStage::Admit, solution.stages);
  solution.stages[SolveStage::Sweep] = niches_.cost().sweep_seconds;
  solution.stages[SolveStage::Admit] -= niches_.cost().sweep_seconds;
}

// Two round solids are convex: their one niche needs no search.
void PairStages::solveRound(const Passed& passed, PairSolution& solution, WorkLimit& limit) {
  const bool is_unchanged = passed.displacement == 0.0 && !round_.records().empty();
  if (!isPairOfShapes()) solveExact(passed, solution, limit);
  if (is_unchanged && (isPairOfShapes() || niches_.isUnchanged(passed.displacement)))
    return round_.keepUnchanged(passed.elapsed);
  round_.update(*frame_, archive_,
                {cycle_.number, cycle_.is_warm ? passed.displacement : 0.0, passed.elapsed}, solution.events);
}

// The certificate's is between the exact surfaces.
WitnessPair PairStages::provenOnMeshes() {
  const WitnessPair& witness = proof_.certificate().witness;
  return isRound() ? niches_.refine(*frame_, witness) : witness;
}

double PairStages::cutoffOfMeshes() const {
  return parameters_.cutoff + parameters_.margin() + (isRound() ? RoundNiches::meshExcess(*frame_) : 0.0);
}

// Niches that none can see, and those of far sides, are not counted; nor what a proof has not reached.
detail::ConvexNiches PairStages::countConvexNiches() const {
  const bool is_proven = proves() && (proof_.certificate().status == CertificateStatus::Proven ||
                                      (proof_.isPenetrating() && !isRound()));
  if (!is_proven || parameters_.hidden || parameters_.keep_through_material) return ConvexNiches::Unknown;
  const NicheRule rule{parameters_.least_prominence, parameters_.prominence_limit, parameters_.margin()};
  return detail::countConvexNiches(
      *frame_, rule, certainDistance(),
      proof_.certificate().status != CertificateStatus::Penetrating && proof_.isSwallowed());
}

// Whenever a tracked pair has moved. A pose alone has nothing to inherit: there the search is for those that
// may have to end early.
bool PairStages::searchIsDue(const WorkLimit& limit) const {
  if (!proves()) return true;
  if (certainDistance() > cutoffOfMeshes()) return false;  // there is no niche to find
  return parameters_.search_share > 0.0 && (cycle_.is_tracked || limit.isTimed());
}

void PairStages::propose(SearchCost& cost, WorkLimit& limit) {
  const SearchStage stage{*frame_, parameters_, archive_, search_, niches_, known_};
  if (proves()) {
    proposeAsHelper(stage, {name_, cycle_.number, cycle_.is_warm, true, cycle_.is_tracked}, cost, limit);
  } else {
    proposeMinima(stage, {name_, cycle_.number, cycle_.is_warm, false, cycle_.is_warm}, cost, limit);
  }
}

double PairStages::certainDistance() const {
  if (!proves() || proof_.isPenetrating()) return 0.0;
  return proof_.certificate().lower_bound - proof_.error();
}

void PairStages::prepare() {
  if (!wantsNiches()) return;
  search_.prepare(*a_, *b_, parameters_);
  is_search_prepared_ = true;
  archive_.reserve(kUsualNiches);
  known_.reserve(kUsualNiches);
  const NormalSides sides = parameters_.keep_through_material ? NormalSides::Both : NormalSides::Outside;
  for (const BodyMesh* body : {a_.get(), b_.get()}) {
    if (isExact()) body->prepareNiches(sides);
  }
}

void PairStages::reset() {
  archive_.clear();
  round_.clear();
  proof_.clear();
  niches_.clear();
  search_.restart();
}

void PairStages::beginIdsAfter(std::uint64_t id) {
  archive_.beginIdsAfter(id);
  round_.beginIdsAfter(id);
}

void PairStages::setParameters(const TrackerParameters& parameters) {
  parameters.validate(name_);
  parameters_ = parameters;
}

void PairStages::renew() {
  proof_.renew();
  niches_.renew();
  search_.forgetParameters();
}

std::size_t PairStages::memoryBytes() const {
  return archive_.records().capacity() * sizeof(NicheRecord) + known_.capacity() * sizeof(TrialPoint) +
         proof_.memoryBytes() + niches_.memoryBytes() + search_.memoryBytes() + round_.memoryBytes();
}

}  // namespace concave_distance

#include "pair_stages.h"

#include <algorithm>

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
      meshes_(a_, b_) {
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
  NicheSearch& search = meshes_.search;
  NicheArchive& archive = meshes_.archive;
  search.begin(*a_, *b_, parameters_);
  followNodePairs(*frame_, search, passed.displacement, passed.elapsed, archive, solution.cost, limit);
  clock_.lap(SolveStage::Follow, solution.stages);
  known_.clear();
  for (const NicheRecord& record : archive.records()) known_.push_back(record.niche.node_pair);
  const std::vector<TrialPoint>& found =
      search.propose(*frame_, parameters_, known_,
                     {name_, cycle_.number, cycle_.is_warm, false, cycle_.is_warm}, solution.cost, limit);
  clock_.lap(SolveStage::Propose, solution.stages);
  admitNodePairs(*frame_, parameters_, search, found, cycle_.is_warm, cycle_.number, archive, solution);
  clock_.lap(SolveStage::Admit, solution.stages);
}

// A sphere or a capsule apart from the other body has the niches of its core, with the radius as a margin: a
// point or a segment in place of thousands of facets, and no facet is mistaken for the solid.
void PairStages::chooseBasis() {
  const bool is_apart = proves() && !proof_.isPenetrating() && !proof_.isSwallowed();
  NicheBasis* wanted = &meshes_;
  if (is_apart && isRound() && !parameters_.keep_through_material) {
    if (cores_ == nullptr) {
      cores_ = NicheBasis::ofCores(a_, b_);
      takeCoreParameters();
    }
    if (cores_ != nullptr) wanted = cores_.get();
  }
  if (wanted != &meshes_) core_frame_.emplace(*cores_->a, *cores_->b, cores_->poseOf(frame_->a_from_b));
  if (wanted == basis_) return;
  wanted->reset();
  round_.forgetMeshNiches();
  basis_ = wanted;
}

void PairStages::takeCoreParameters() {
  if (cores_ == nullptr) return;
  core_parameters_ = parameters_;
  core_parameters_.margin_a += cores_->margin_a;
  core_parameters_.margin_b += cores_->margin_b;
}

void PairStages::solveExact(const Passed& passed, PairSolution& solution, WorkLimit& limit) {
  chooseBasis();
  NicheBasis& basis = *basis_;
  if (basis.niches.isUnchanged(passed.displacement)) return basis.archive.keepUnchanged(passed.elapsed);
  PairFrame& frame = basisFrame();
  frame.openFacets();
  frame.pose_error = pose_error_;
  const ConvexNiches convex = countConvexNiches();
  const bool are_counted = convex == ConvexNiches::OnlyTheNearest || convex == ConvexNiches::None;
  if (!basis.is_search_prepared && !are_counted && cycle_.is_tracked && mayHelp()) prepare(basis);
  limit.allowShare(kShareOfSearch);
  if (!proves()) basis.niches.follow(frame, basis.archive, limit);
  clock_.lap(SolveStage::Follow, solution.stages);
  if (!are_counted && searchIsDue(limit)) propose(solution.cost, limit);
  if (proves() && (!proof_.isPenetrating() || convex == ConvexNiches::OnlyTheNearest)) {
    basis.niches.proposeProven(frame, provenOnBasis(), proof_.isPenetrating());
  }
  clock_.lap(SolveStage::Propose, solution.stages);
  basis.niches.admit(frame, basisParameters(),
                     {cycle_.number, basis.poseOf(cycle_.last_niches_pose), passed.elapsed, cycle_.is_tracked,
                      cutoffOfBasis(), convex, cycle_.ends_first},
                     certainOnBasis(), kShareOfNiches, basis.archive, solution, limit);
  basis.search.earn(basis.niches.evolved(), basis.niches.work(), parameters_.search_share);
  clock_.lap(SolveStage::Admit, solution.stages);
  solution.stages[SolveStage::Sweep] = basis.niches.cost().sweep_seconds;
  solution.stages[SolveStage::Admit] -= basis.niches.cost().sweep_seconds;
}

// Two round solids are convex: their one niche needs no search.
void PairStages::solveRound(const Passed& passed, PairSolution& solution, WorkLimit& limit) {
  const bool is_unchanged = passed.displacement == 0.0 && !round_.records().empty();
  if (!isPairOfShapes()) solveExact(passed, solution, limit);
  if (is_unchanged && (isPairOfShapes() || basis_->niches.isUnchanged(passed.displacement)))
    return round_.keepUnchanged(passed.elapsed);
  round_.update(*frame_, basis_->archive,
                {cycle_.number, cycle_.is_warm ? passed.displacement : 0.0, passed.elapsed}, solution.events);
}

// The certificate's is between the exact surfaces.
WitnessPair PairStages::provenOnBasis() {
  WitnessPair witness = proof_.certificate().witness;
  if (!isRound()) return witness;
  if (basis_->a != a_) witness.triangle_a = TriangleIndex{0};
  if (basis_->b != b_) witness.triangle_b = TriangleIndex{0};
  return basis_->niches.refine(basisFrame(), witness);
}

double PairStages::cutoffOfBasis() const {
  const double excess = basis_ == &meshes_ && isRound() ? RoundNiches::meshExcess(*frame_) : 0.0;
  return parameters_.cutoff + basisParameters().margin() + basis_->thickness + excess;
}

double PairStages::certainOnBasis() const {
  const double certain = certainDistance();
  return certain > 0.0 ? std::max(0.0, certain + basis_->margin() - basis_->thickness) : certain;
}

// Niches that none can see, and those of far sides, are not counted; nor what a proof has not reached.
detail::ConvexNiches PairStages::countConvexNiches() const {
  const bool is_proven = proves() && (proof_.certificate().status == CertificateStatus::Proven ||
                                      (proof_.isPenetrating() && !isRound()));
  if (!is_proven || parameters_.hidden || parameters_.keep_through_material) return ConvexNiches::Unknown;
  const NicheRule rule{parameters_.least_prominence, parameters_.prominence_limit,
                       basisParameters().margin()};
  return detail::countConvexNiches(
      basisFrame(), rule, certainOnBasis(),
      proof_.certificate().status != CertificateStatus::Penetrating && proof_.isSwallowed(),
      isRound() ? nullptr : &proof_.certificate().witness);
}

// Whenever a tracked pair has moved. A pose alone has nothing to inherit: there the search is for those that
// may have to end early.
bool PairStages::searchIsDue(const WorkLimit& limit) const {
  if (!proves()) return true;
  if (certainOnBasis() > cutoffOfBasis()) return false;  // there is no niche to find
  return mayHelp() && (cycle_.is_tracked || limit.isTimed());
}

void PairStages::propose(SearchCost& cost, WorkLimit& limit) {
  const SearchStage stage{basisFrame(), parameters_, basis_->archive, basis_->search, basis_->niches, known_};
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
  prepare(meshes_);
  if (cores_ != nullptr) prepare(*cores_);
}

void PairStages::prepare(NicheBasis& basis) {
  basis.search.prepare(*basis.a, *basis.b, parameters_);
  basis.is_search_prepared = true;
  basis.archive.reserve(kUsualNiches);
  known_.reserve(kUsualNiches);
  const NormalSides sides = parameters_.keep_through_material ? NormalSides::Both : NormalSides::Outside;
  for (const BodyMesh* body : {basis.a.get(), basis.b.get()}) {
    if (isExact()) body->prepareNiches(sides);
  }
}

void PairStages::reset() {
  meshes_.reset();
  if (cores_ != nullptr) cores_->reset();
  round_.clear();
  proof_.clear();
}

void PairStages::beginIdsAfter(std::uint64_t id) {
  meshes_.archive.beginIdsAfter(id);
  round_.beginIdsAfter(id);
}

void PairStages::setParameters(const TrackerParameters& parameters) {
  parameters.validate(name_);
  parameters_ = parameters;
}

void PairStages::renew() {
  proof_.renew();
  takeCoreParameters();
  for (NicheBasis* basis : {&meshes_, cores_.get()}) {
    if (basis == nullptr) continue;
    basis->niches.renew();
    basis->search.forgetParameters();
  }
}

}  // namespace concave_distance

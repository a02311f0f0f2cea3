#include "concave_distance/tracking/pair_tracker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "concave_distance/base/random_engine.h"
#include "concave_distance/distance/surface_walk.h"
#include "concave_distance/search/automatic_radii.h"
#include "concave_distance/search/genetic_search.h"
#include "concave_distance/search/local_descent.h"
#include "concave_distance/tracking/niche_admission.h"
#include "concave_distance/tracking/niche_archive.h"
#include "concave_distance/tracking/node_niches.h"
#include "concave_distance/tracking/pair_geometry.h"
#include "concave_distance/tracking/projection.h"
#include "concave_distance/tracking/prominence_flood.h"
#include "concave_distance/tracking/relative_motion.h"
#include "concave_distance/tracking/warm_start.h"

namespace concave_distance {
namespace {

// Candidates that a warm cycle refines at the most, best first; a cold one takes them all.
constexpr std::size_t kWarmCandidateLimit = 64;
// Triangle pairs that the extent of a niche is followed over at the most.
constexpr std::size_t kExtentPairLimit = 64;
// Records whose prominence is looked at again in a warm cycle, in turn.
constexpr std::size_t kReviewsPerCycle = 1;
// The archive holds this many times what is reported, for niches that come and go at the edge of the list.
constexpr std::size_t kArchiveFactor = 4;
// Rounds of projections in a cold cycle: each asks what the last one brought.
constexpr int kColdProjectionRounds = 4;
// States a flood looks at, at the most, before a newborn niche counts as one.
constexpr std::uint32_t kColdFloodStates = 4000;
constexpr std::uint32_t kWarmFloodStates = 400;
// Cycles for which the outcome of a flood is believed without a new one.
constexpr std::uint64_t kDrownedCycles = 16;
// Steps along the nearest niche's valley in one cycle at the most.
constexpr int kValleySteps = 8;
// A cold cycle projects this many times the immigrants of a warm one.
constexpr std::uint32_t kColdProjectionFactor = 16;
// Tells the stream of the projections from that of the evolution.
constexpr std::uint64_t kProjectionStream = 0x70726f6a656374ULL;

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

struct PairTracker::State {
  State(std::string pair_name, std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
        const TrackerParameters& given)
      : name(std::move(pair_name)),
        geometry(std::move(a), std::move(b)),
        parameters(given),
        search(*geometry.a, *geometry.b) {
    parameters.validate(name);
    chooseRadii();
  }

  void chooseRadii() {
    cold_radii = automaticRadii(*geometry.a, *geometry.b, parameters.cold);
    warm_radii = automaticRadii(*geometry.a, *geometry.b, parameters.warm);
  }

  void update(const Eigen::Isometry3d& pose, double time, PairSolution& solution);
  void followNiches(double displacement, double elapsed, SearchCost& cost, std::vector<NicheEvent>& events);
  void follow(NicheRecord& record, double elapsed);
  void evolve(const PairObjective& objective, PairSolution& solution);
  void collectCandidates(std::size_t known_minima);
  void projectNiches(PairSolution& solution);
  void walkValley(PairSolution& solution);
  void settleCandidates(PairSolution& solution);
  void reviewRecords(PairSolution& solution);
  void drownNewborns(const PairObjective& objective, PairSolution& solution);
  void orderCandidates();
  void admitCandidates(std::vector<NicheEvent>& events);
  void report(double displacement, PairSolution& solution);
  void describe(TrackedNiche& niche);

  std::string name;
  PairGeometry geometry;
  TrackerParameters parameters;
  NicheRadii cold_radii{};
  NicheRadii warm_radii{};
  SearchWorkspace search;
  NicheArchive archive;
  std::vector<NicheCandidate> candidates;
  std::vector<TrialPoint> known;
  std::vector<TrialPoint> inherited;
  std::vector<double> scratch;
  WitnessPair dark_side;  ///< the closest pair of this cycle that runs through material
  bool dark_side_met = false;
  // Where floods have started that led on: their niches are not flooded again for some cycles.
  struct Drowned {
    TrialPoint start;
    std::uint64_t cycle;
  };
  std::vector<Drowned> drowned;
  FloodWorkspace flood;
  std::uint64_t cycle = 0;
  bool warm = false;
  Eigen::Isometry3d last_pose = Eigen::Isometry3d::Identity();
  double last_time = 0.0;
  double last_elapsed = 0.0;
  double last_distance = kNotComputed;
  std::size_t next_review = 0;
  std::size_t next_projection = 0;
};

void PairTracker::State::update(const Eigen::Isometry3d& pose, double time, PairSolution& solution) {
  const auto start = std::chrono::steady_clock::now();
  solution.status = SolveStatus::Ok;
  solution.accuracy = parameters.accuracy;
  solution.distance = solution.lower_bound = solution.surface_distance = kNotComputed;
  solution.point_a_in_a.setConstant(kNotComputed);
  solution.point_b_in_a.setConstant(kNotComputed);
  solution.niches.clear();
  solution.events.clear();
  solution.niches_cut = solution.search_miss = false;
  solution.niches_beyond_cutoff = 0;
  solution.cycle = cycle;
  solution.warm = warm;
  solution.seed = parameters.seed;
  solution.cost = {};

  const std::optional<Eigen::Isometry3d> rigid = rigidPose(pose);
  if (!rigid) {
    solution.status = SolveStatus::InvalidPose;
    solution.solve_seconds = seconds(std::chrono::steady_clock::now() - start);
    return;
  }
  geometry.setPose(*rigid);
  const PairObjective objective(*geometry.a, *geometry.b, *rigid);
  const double elapsed = warm && time > last_time ? time - last_time : 0.0;
  const double displacement =
      warm ? largestDisplacement(geometry.b->surface().boundingBox(), last_pose, *rigid)
           : std::numeric_limits<double>::infinity();
  candidates.clear();
  dark_side_met = false;
  search.basins.clear();

  if (warm) {
    followNiches(displacement, elapsed, solution.cost, solution.events);
  }
  const std::size_t known_minima = search.basins.minima().size();
  evolve(objective, solution);
  collectCandidates(known_minima);
  settleCandidates(solution);
  projectNiches(solution);
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    uniteWithinRadius(warm ? warm_radii.niche : cold_radii.niche, search.metric, archive, solution.events);
  } else {
    uniteSamePlaces(geometry, archive, solution.events);
  }
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    improveNodePairs(objective, parameters.largest_niche_count, archive, geometry, solution.cost);
  } else {
    reviewRecords(solution);
    drownNewborns(objective, solution);
  }
  report(displacement, solution);

  last_pose = *rigid;
  last_time = time;
  last_elapsed = elapsed;
  last_distance = solution.distance;
  warm = true;
  ++cycle;
  solution.solve_seconds = seconds(std::chrono::steady_clock::now() - start);
}

void PairTracker::State::followNiches(double displacement, double elapsed, SearchCost& cost,
                                      std::vector<NicheEvent>& events) {
  const PairObjective objective(*geometry.a, *geometry.b, geometry.a_from_b);
  const double rounding = 1e-9 * geometry.scale();
  std::vector<NicheRecord>& records = archive.records();
  for (std::size_t i = 0; i < records.size();) {
    NicheRecord& record = records[i];
    const double before = record.niche.distance;
    record.niche.node_pair = descend(
        objective, objective.evaluate(record.niche.node_pair.node_a, record.niche.node_pair.node_b, cost),
        &search.basins, search.trail, cost);
    follow(record, elapsed);
    // No surviving minimum can fall by more than any point of B has moved: the basin is gone and the descent
    // has run on into another one.
    if (record.niche.distance < before - displacement - rounding) {
      candidates.push_back({record.niche.witness, record.niche.node_pair, record.niche.proven_local_minimum,
                            record.reported ? record.niche.id : 0});
      records[i] = records.back();
      records.pop_back();
      continue;
    }
    record.niche.closing_speed = elapsed > 0.0 ? (before - record.niche.distance) / elapsed : kNotComputed;
    if (parameters.accuracy != AccuracyLevel::Nodes && !parameters.keep_through_material) {
      record.niche.outward =
          classifyOutwardness(*geometry.a, *geometry.b, geometry.a_from_b, record.niche.witness);
      if (record.niche.outward == Outwardness::ThroughMaterial) {
        if (!dark_side_met || record.niche.witness.squared_distance < dark_side.squared_distance) {
          dark_side = record.niche.witness;
          dark_side_met = true;
        }
        archive.remove(i, events);
        continue;
      }
    }
    ++i;
  }
}

void PairTracker::State::follow(NicheRecord& record, double elapsed) {
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    placeRecord(record, geometry, geometry.nodeWitness(record.niche.node_pair));
    return;
  }
  TriangleIndex start_a = record.niche.witness.triangle_a;
  TriangleIndex start_b = record.niche.witness.triangle_b;
  const Eigen::Vector3d before_a = record.niche.point_a_in_a;
  const Eigen::Vector3d before_b = record.point_b_in_b;
  if (parameters.extrapolate && elapsed > 0.0) {
    const Eigen::Vector3d way_a = record.velocity_a_in_a * elapsed;
    const Eigen::Vector3d way_b = record.velocity_b_in_b * elapsed;
    if (way_a.squaredNorm() + way_b.squaredNorm() > 0.0) {
      const SurfacePoint on_a = walkTowards(*geometry.a, start_a, before_a + way_a);
      const SurfacePoint on_b = walkTowards(*geometry.b, start_b, before_b + way_b);
      const double extrapolated = (geometry.a_from_b * on_b.point - on_a.point).squaredNorm();
      if (extrapolated < (geometry.a_from_b * before_b - before_a).squaredNorm()) {
        start_a = on_a.triangle;
        start_b = on_b.triangle;
      }
    }
  }
  const WitnessRefinement refined = geometry.refine(start_a, start_b);
  record.niche.proven_local_minimum = refined.proven;
  placeRecord(record, geometry, refined.witness);
  if (elapsed > 0.0) {
    record.velocity_a_in_a = (record.niche.point_a_in_a - before_a) / elapsed;
    record.velocity_b_in_b = (record.point_b_in_b - before_b) / elapsed;
  }
}

void PairTracker::State::evolve(const PairObjective& objective, PairSolution& solution) {
  RandomEngine engine(streamSeed(parameters.seed, name, cycle));
  inherited.clear();
  GeneticParameters genetic = warm ? parameters.warm : parameters.cold;
  if (warm) {
    known.clear();
    for (const NicheRecord& record : archive.records()) {
      known.push_back(record.niche.node_pair);
    }
    const double softening = std::min(geometry.a->maxEdgeLength(), geometry.b->maxEdgeLength());
    inherit(known, {parameters.inherited_per_niche, parameters.inherited_limit}, softening, inherited,
            scratch);
    const auto wanted = static_cast<std::uint32_t>(inherited.size()) + parameters.immigrants;
    genetic.population_size = std::max(genetic.population_size, wanted + wanted % 2);
  }
  const GeneticResult result =
      geneticSearch(objective, genetic, warm ? warm_radii : cold_radii, inherited, engine, search);
  solution.cost.evaluations += result.cost.evaluations;
  solution.cost.descents += result.cost.descents;
  solution.cost.descents_joined += result.cost.descents_joined;
  solution.cost.descent_steps += result.cost.descent_steps;
  if (!genetic.local_optimization) {
    search.basins.addMinimum(result.best);
  }
}

void PairTracker::State::collectCandidates(std::size_t known_minima) {
  // Node pairs are cheap to compare: the best come first where a warm cycle has to choose.
  known.assign(search.basins.minima().begin() + static_cast<std::ptrdiff_t>(known_minima),
               search.basins.minima().end());
  std::sort(known.begin(), known.end());
  if (warm && known.size() > kWarmCandidateLimit) {
    known.resize(kWarmCandidateLimit);
  }
  for (const TrialPoint& pair : known) {
    if (parameters.accuracy == AccuracyLevel::Nodes) {
      candidates.push_back({geometry.nodeWitness(pair), pair, true, 0});
      continue;
    }
    const WitnessRefinement refined =
        geometry.refine(geometry.a->originalTriangle(pair.node_a), geometry.b->originalTriangle(pair.node_b));
    candidates.push_back({refined.witness, pair, refined.proven, 0});
  }
}

void PairTracker::State::projectNiches(PairSolution& solution) {
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    return;
  }
  RandomEngine engine(streamSeed(parameters.seed ^ kProjectionStream, name, cycle));
  const std::uint32_t immigrants =
      warm ? parameters.projected_immigrants : kColdProjectionFactor * parameters.projected_immigrants;
  candidates.clear();
  for (std::uint32_t k = 0; k < immigrants; ++k) {
    const Side side = k % 2 == 0 ? Side::A : Side::B;
    const NodeGraph& graph = (side == Side::A ? geometry.a : geometry.b)->graph();
    projectNode(geometry, side,
                NodeIndex{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))}, candidates);
  }
  settleCandidates(solution);

  // A warm cycle asks the nearest niche and the next ones in turn; a cold one all, and again what that
  // brought.
  std::uint64_t newest = 0;
  for (int round = 0; round < (warm ? 1 : kColdProjectionRounds); ++round) {
    const std::size_t count = archive.records().size();
    const std::size_t wanted = warm ? std::min<std::size_t>(parameters.projected_niches, count) : count;
    for (std::size_t k = 0; k < wanted; ++k) {
      next_projection = warm && k > 0 ? (next_projection + 1) % count : next_projection;
      const NicheRecord& record = archive.records()[warm && k > 0 ? next_projection : k];
      if (warm || record.niche.id > newest) {
        projectWitness(geometry, record, candidates);
      }
    }
    for (const NicheRecord& record : archive.records()) {
      newest = std::max(newest, record.niche.id);
    }
    if (candidates.empty()) {
      break;
    }
    settleCandidates(solution);
  }
  walkValley(solution);
}

void PairTracker::State::walkValley(PairSolution& solution) {
  if (parameters.projected_niches == 0) {
    return;
  }
  // The global minimum of a tessellated valley is often the next ripple: from the nearest niche's
  // surroundings on either body in turn, on as long as that comes nearer.
  Side side = cycle % 2 == 0 ? Side::A : Side::B;
  int fruitless = 0;
  for (int step = 0; step < kValleySteps && fruitless < (warm ? 1 : 2) && !archive.records().empty();
       ++step) {
    const double before = archive.records().front().niche.distance;
    projectNeighbours(geometry, side, archive.records().front(), candidates);
    settleCandidates(solution);
    fruitless = archive.records().front().niche.distance < before ? 0 : fruitless + 1;
    side = side == Side::A ? Side::B : Side::A;
  }
}

void PairTracker::State::settleCandidates(PairSolution& solution) {
  orderCandidates();
  admitCandidates(solution.events);
  archive.settle();
  candidates.clear();
}

void PairTracker::State::reviewRecords(PairSolution& solution) {
  // A cold cycle looks at every record, once all are known: neighbours may have come in any order.
  const std::size_t reviews = warm ? kReviewsPerCycle : archive.records().size();
  for (std::size_t k = 0; k < reviews && !archive.records().empty(); ++k) {
    next_review = (next_review + archive.records().size() - 1) % archive.records().size();
    if (reviewProminence(next_review, geometry, parameters, archive, solution.events)) {
      archive.settle();
    }
  }
}

void PairTracker::State::orderCandidates() {
  std::sort(candidates.begin(), candidates.end(), [](const NicheCandidate& l, const NicheCandidate& r) {
    return l.witness.squared_distance != r.witness.squared_distance
               ? l.witness.squared_distance < r.witness.squared_distance
               : l.node_pair < r.node_pair;
  });
}

void PairTracker::State::admitCandidates(std::vector<NicheEvent>& events) {
  const double niche_radius = warm ? warm_radii.niche : cold_radii.niche;
  for (const NicheCandidate& candidate : candidates) {
    AdmissionResult result{Admission::SamePlace, 0};
    if (parameters.accuracy == AccuracyLevel::Nodes) {
      result = admitNodePair(candidate, geometry, niche_radius, cycle, search.metric, archive);
    } else {
      result = admitCandidate(candidate, geometry, parameters, niche_radius, cycle, archive, events);
    }
    if (result.outcome == Admission::ThroughMaterial &&
        (!dark_side_met || candidate.witness.squared_distance < dark_side.squared_distance)) {
      dark_side = candidate.witness;
      dark_side_met = true;
    }
    if (candidate.left_by != 0) {
      const bool joined =
          result.outcome == Admission::SamePlace || result.outcome == Admission::LowProminence;
      events.push_back(joined ? NicheEvent{NicheEvent::Kind::Merge, candidate.left_by, result.id}
                              : NicheEvent{NicheEvent::Kind::Death, candidate.left_by, 0});
    }
  }
}

// A newborn niche that a flood of the grid leads out of below the least prominence is part of what it leads
// to.
void PairTracker::State::drownNewborns(const PairObjective& objective, PairSolution& solution) {
  const std::uint32_t state_limit = warm ? kWarmFloodStates : kColdFloodStates;
  drowned.erase(std::remove_if(drowned.begin(), drowned.end(),
                               [&](const Drowned& entry) { return cycle - entry.cycle > kDrownedCycles; }),
                drowned.end());
  candidates.clear();
  for (std::size_t i = archive.records().size(); i-- > 0;) {
    const NicheRecord& record = archive.records()[i];
    if (record.reported || record.niche.distance == 0.0 || i == 0) {
      continue;  // the deepest has nowhere to lead to
    }
    const TrialPoint start = descend(objective, record.niche.node_pair, nullptr, search.trail, solution.cost);
    const bool known = std::any_of(drowned.begin(), drowned.end(),
                                   [&](const Drowned& entry) { return samePlace(entry.start, start); });
    if (!known) {
      const double level = (1.0 + parameters.least_prominence) * std::sqrt(start.squared_distance);
      const auto deeper = floodForDeeper(objective, start, level, 0.0, state_limit, flood, solution.cost);
      if (!deeper) {
        continue;
      }
      const TrialPoint end = descend(objective, *deeper, nullptr, search.trail, solution.cost);
      const WitnessRefinement refined =
          geometry.refine(geometry.a->originalTriangle(end.node_a), geometry.b->originalTriangle(end.node_b));
      if (!(std::sqrt(refined.witness.squared_distance) < record.niche.distance)) {
        continue;  // deeper for the grid only
      }
      candidates.push_back({refined.witness, end, refined.proven, 0});
      drowned.push_back({start, cycle});
    }
    archive.remove(i, solution.events);
  }
  settleCandidates(solution);
}

void PairTracker::State::report(double displacement, PairSolution& solution) {
  std::vector<NicheRecord>& records = archive.records();
  const std::size_t capacity = kArchiveFactor * parameters.largest_niche_count;
  while (records.size() > capacity) {
    archive.remove(records.size() - 1, solution.events);
    solution.niches_cut = true;
  }
  for (NicheRecord& record : records) {
    if (record.niche.distance > parameters.cutoff) {
      ++solution.niches_beyond_cutoff;
      continue;
    }
    if (solution.niches.size() == parameters.largest_niche_count) {
      solution.niches_cut = true;
      continue;
    }
    if (!record.reported) {
      solution.events.push_back({NicheEvent::Kind::Birth, record.niche.id, 0});
      record.reported = true;
    }
    if (parameters.niches_wanted) {
      describe(record.niche);
    }
    solution.niches.push_back(record.niche);
  }
  if (!records.empty()) {
    const TrackedNiche& nearest = records.front().niche;
    solution.distance = nearest.distance;
    solution.point_a_in_a = nearest.point_a_in_a;
    solution.point_b_in_a = nearest.point_b_in_a;
    solution.status = nearest.distance == 0.0 ? SolveStatus::Penetrating : SolveStatus::Ok;
  }
  // A segment that leaves a closed body inwards and meets no surface ends in that body's material: swallowed.
  // Only the closest pair can be so without a closer crossing of the surfaces.
  if (dark_side_met && (records.empty() || std::sqrt(dark_side.squared_distance) < solution.distance) &&
      isVisible(*geometry.a, *geometry.b, geometry.a_from_b, dark_side)) {
    solution.status = SolveStatus::Penetrating;
    solution.surface_distance = std::sqrt(dark_side.squared_distance);
    solution.distance = 0.0;
    solution.point_a_in_a = dark_side.point_a_in_a;
    solution.point_b_in_a = dark_side.point_b_in_a;
  }
  const double rounding = 1e-9 * geometry.scale();
  solution.search_miss = warm && solution.distance < last_distance - displacement - rounding;
}

void PairTracker::State::describe(TrackedNiche& niche) {
  if (parameters.accuracy == AccuracyLevel::Nodes) {
    return;
  }
  const double tolerance = 1e-9 * geometry.scale();
  const NicheExtent extent = measureExtent(*geometry.a, *geometry.b, geometry.a_from_b, niche.witness,
                                           tolerance, kExtentPairLimit, geometry.extent);
  niche.kind = extent.kind;
  niche.extent = extent.length;
  if (extent.kind != NicheKind::Point) {
    niche.point_a_in_a = extent.representative.point_a_in_a;
    niche.point_b_in_a = extent.representative.point_b_in_a;
  }
  niche.visible = isVisible(*geometry.a, *geometry.b, geometry.a_from_b, niche.witness);
}

PairTracker::PairTracker(std::string name, std::shared_ptr<const BodyMesh> a,
                         std::shared_ptr<const BodyMesh> b, const TrackerParameters& parameters)
    : state_(std::make_unique<State>(std::move(name), std::move(a), std::move(b), parameters)) {}
PairTracker::~PairTracker() = default;
PairTracker::PairTracker(PairTracker&&) noexcept = default;
PairTracker& PairTracker::operator=(PairTracker&&) noexcept = default;

void PairTracker::update(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution) {
  state_->update(a_from_b, time, solution);
}

void PairTracker::reset() {
  state_->archive.clear();
  state_->warm = false;
}

void PairTracker::setParameters(const TrackerParameters& parameters) {
  parameters.validate(state_->name);
  if (parameters.accuracy != state_->parameters.accuracy) {
    reset();  // node niches and refined ones are not the same places
  }
  state_->parameters = parameters;
  state_->chooseRadii();
}

std::size_t PairTracker::memoryBytes() const {
  const State& state = *state_;
  return sizeof(State) + state.archive.records().capacity() * sizeof(NicheRecord) +
         state.candidates.capacity() * sizeof(NicheCandidate) +
         (state.known.capacity() + state.inherited.capacity()) * sizeof(TrialPoint) +
         state.search.memoryBytes();
}

const TrackerParameters& PairTracker::parameters() const {
  return state_->parameters;
}

PairSolution solveOnce(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                       const std::shared_ptr<const BodyMesh>& b, const TrackerParameters& parameters,
                       const Eigen::Isometry3d& a_from_b) {
  PairTracker tracker(name, a, b, parameters);
  PairSolution solution;
  tracker.update(a_from_b, 0.0, solution);
  return solution;
}

}  // namespace concave_distance

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "distance/basin_verdict.h"
#include "distance/certificate.h"
#include "distance/cone_sweep.h"
#include "distance/local_minima.h"
#include "niche_admission.h"
#include "niche_archive.h"
#include "pair_geometry.h"
#include "ripple_memory.h"
#include "search/automatic_radii.h"
#include "search/pair_objective.h"
#include "search/search_workspace.h"

namespace concave_distance {

// What a plateau's distance may vary by, relative to the bodies: far above the kernels' rounding.
inline constexpr double kPlateauTolerance = 1e-9;

/// What level `certified` keeps from cycle to cycle.
struct Proof {
  CertificateWorkspace workspace;
  ProofFront front;
  DistanceCertificate certificate;  ///< of the last cycle
  double error = 0.0;               ///< metres, of the certificate
  bool seeded = false;              ///< there is a last certificate
  bool current = false;             ///< made with the parameters as they are
  bool swallowed = false;           ///< one body holds a part of the other
};

/// What level `complete` keeps.
struct Completeness {
  std::vector<NicheRecord> records;  ///< of the last cycle, as a buffer
  bool current = false;              ///< the archive is complete at the last pose, as parameters want it
  bool cut = false;                  ///< and it was cut
  LocalMinimaMemory memory;

  std::size_t memoryBytes() const { return records.capacity() * sizeof(NicheRecord) + memory.memoryBytes(); }
};

/// What one pair keeps from cycle to cycle, and the stages of a cycle, in the order of update(). Each stage
/// has a file of its own.
struct TrackerState {
  TrackerState(std::string pair_name, std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
               const TrackerParameters& given);

  void prepareSearch();
  void update(const Eigen::Isometry3d& pose, double time, PairSolution& solution);
  void reset();
  void restart(std::uint64_t largest_used_id);

  std::size_t memoryBytes() const;
  void clear(PairSolution& solution) const;
  void solveNiches(double displacement, double elapsed, PairSolution& solution);

  // follow_niches.cpp: every known niche to where its minimum has moved.
  void followNiches(double displacement, double elapsed, SearchCost& cost, std::vector<NicheEvent>& events);
  void follow(NicheRecord& record, double elapsed);
  void followInwardWitness();

  // search_niches.cpp: candidates from the genetic search and from projections.
  bool searchIsDue(double displacement);
  void evolve(const PairObjective& objective, PairSolution& solution);
  void collectCandidates(std::size_t known_minima);
  void projectNiches(PairSolution& solution);
  bool sweepsCones() const { return parameters.swept_cones > 0 && parameters.niches_wanted; }
  void sweepCones(PairSolution& solution);

  // settle_niches.cpp: which candidates are niches, and which niches are still niches of their own.
  void settleCandidates(PairSolution& solution);
  void reviewRecords(PairSolution& solution);
  void report(const NicheCandidate& candidate, const AdmissionResult& result,
              std::vector<NicheEvent>& events);
  bool isDark(const WitnessPair& witness, Outwardness outward);
  std::optional<AdmissionResult> knownVerdict(const NicheCandidate& candidate, Outwardness& outward);
  std::uint64_t addNiche(const NicheCandidate& candidate, Outwardness outward);
  bool isNearest(const NicheCandidate& candidate) const;
  void judge(PairSolution& solution);
  void settleVerdicts(std::size_t known, PairSolution& solution);

  // complete_niches.cpp: level `complete`.
  void completeNiches(double displacement, double elapsed, PairSolution& solution);
  void carryNiches(PairSolution& solution);

  // prove_distance.cpp: levels `certified` and `complete`.
  void proveDistance(double displacement);
  void admitClosest(PairSolution& solution);
  void reportProven(PairSolution& solution);
  void proveAlone(double displacement, double elapsed, PairSolution& solution);

  // report_niches.cpp
  void describeNiches(PairSolution& solution);
  bool uniteOnPlateau(std::size_t i, std::vector<NicheEvent>& events);
  void listNiches(PairSolution& solution);
  void reportNearest(double displacement, PairSolution& solution);
  void reportLimit(PairSolution& solution) const;
  void describe(TrackedNiche& niche);

  std::string name;
  PairGeometry geometry;
  TrackerParameters parameters;
  bool search_prepared = false;  ///< with the present parameters
  NicheRadii cold_radii{};
  NicheRadii warm_radii{};
  SearchWorkspace search;
  NicheArchive archive;
  std::vector<NicheCandidate> candidates;
  std::vector<TrialPoint> known;
  std::vector<TrialPoint> inherited;
  std::vector<double> scratch;
  WitnessPair inward_witness;  ///< the closest pair of this cycle that runs through material
  bool inward_witness_met = false;
  bool swallowed = false;  ///< the last cycle found so by its dark side
  /// A candidate that waits for its verdict.
  struct Pending {
    std::size_t candidate;
    Outwardness outward;
  };
  /// Buffers of judge().
  struct Judging {
    std::vector<char> records;  ///< not 0: to be judged again
    std::vector<BasinSeed> seeds;
    std::vector<Pending> pending;
    BasinVerdicts verdicts;
    std::vector<std::uint64_t> ids;   ///< of the niche of every basin
    std::vector<std::size_t> seeded;  ///< first seed of every basin
    std::vector<std::uint64_t> record_ids;
  };
  Judging judging;
  ConeSweep sweep;
  std::vector<MinimumSeed> swept;  ///< not used yet
  bool swept_at_rest = false;      ///< all cones have been compared at this pose
  RippleMemory ripples;
  std::uint64_t cycle = 0;
  bool warm = false;
  Eigen::Isometry3d last_pose = Eigen::Isometry3d::Identity();
  double last_time = 0.0;
  double last_elapsed = 0.0;
  double last_distance = kNotComputed;
  std::size_t next_review = 0;
  double due_reviews = 0.0;
  /// Of the work that goes with the motion, from 1 / search_interval to 1 where the next search is due.
  double due_share = 1.0;
  std::size_t next_projection = 0;
  double moved_since_search = 0.0;  ///< metres, at most
  std::uint32_t cycles_since_search = 0;
  bool searching = true;  ///< this cycle looks for newborn niches
  /// Cycles since the bodies last moved against each other: what was found at this very pose is not found
  /// again.
  std::uint32_t cycles_at_rest = 0;
  Proof proof;
  Completeness completeness;
  StageClock stage_clock;
  WorkLimit limit;  ///< of the present cycle
};

}  // namespace concave_distance

#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/tracked_pair.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// Makes what the niches of one pair need of its bodies, while these are there: facets, neighbours and normal
/// cones; then the grids of the search, which take ten times as long and without which lists are proven too.
/// Two convex bodies need less (areConvex()), two round solids nothing.
class PreparationTask {
 public:
  PreparationTask(const std::shared_ptr<const BodyMesh>& a, const std::shared_ptr<const BodyMesh>& b,
                  const TrackerParameters& parameters);
  /// Returns whether it makes all that a pair needs with these parameters.
  bool suffices(const TrackerParameters& parameters) const;
  /// Returns whether all but the search is made.
  bool isDone() const { return is_done_.load(std::memory_order_acquire); }
  bool isSearchDone() const { return is_search_done_.load(std::memory_order_acquire); }
  /// Makes all but the search. An exception is left to the first cycle that needs the part, as below.
  void makeNiches();
  void makeSearch();
  void run() {
    makeNiches();
    makeSearch();
  }

 private:
  void makeParts();

  std::weak_ptr<const BodyMesh> a_;
  std::weak_ptr<const BodyMesh> b_;
  TrackerParameters parameters_;
  bool needs_search_ = true;  ///< needsSearch()
  std::atomic<bool> is_done_{false};
  std::atomic<bool> is_search_done_{false};
};

/// Runs such tasks on a thread of its own that gives way to others, so that no cycle waits for them: first
/// the niches of pairs, then those of meshes that may come near, then the searches of pairs that have lasted
/// for a second: the surface of a cloud is replaced before.
class NichePreparation {
 public:
  NichePreparation() = default;
  /// Waits for the task that runs; the others are dropped.
  ~NichePreparation();
  NichePreparation(const NichePreparation&) = delete;
  NichePreparation& operator=(const NichePreparation&) = delete;

  /// Begins with what the pairs and bodies of a scene will need, if its meshes are not too large for that.
  void addAhead(const Scene& scene, const std::vector<std::shared_ptr<TrackedPair>>& pairs);
  /// Returns whether niches of a pair can be had without waiting, and else begins to prepare them after
  /// what came before; at once where no thread can be had. Levels that prove no distance never wait.
  bool isPrepared(TrackedPair& pair);

 private:
  using Clock = std::chrono::steady_clock;
  struct Entry {
    std::shared_ptr<PreparationTask> task;
    bool is_ahead = false;  ///< nobody else has it
    Clock::time_point search_due = Clock::now() + kLasting;
  };
  static constexpr std::chrono::seconds kLasting{1};
  using Lists = std::array<std::deque<Entry>, 3>;
  void add(Entry entry);
  void work();
  Lists::iterator first();
  void addAhead(const std::shared_ptr<const BodyMesh>& mesh, const TrackerParameters& parameters);
  bool isBegunAhead(const std::shared_ptr<const BodyMesh>& mesh);
  std::unordered_map<const BodyMesh*, std::weak_ptr<const BodyMesh>> begun_ahead_;
  std::size_t most_begun_ = 64;  ///< before those that are gone are looked for

  std::mutex mutex_;  ///< of the following
  std::condition_variable added_;
  Lists waiting_;  ///< pairs, meshes, searches
  bool is_ending_ = false;
  std::thread thread_;  ///< begins with the first task
};

}  // namespace concave_distance

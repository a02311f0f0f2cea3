#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <unordered_set>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// Makes what the niches of one pair need of its bodies: facets, neighbours, normal cones and the grid of the
/// search. Two convex bodies need less (areConvex()), two round solids nothing.
class PreparationTask {
 public:
  PreparationTask(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b,
                  const TrackerParameters& parameters);
  /// Returns whether it makes all that a pair needs with these parameters.
  bool suffices(const TrackerParameters& parameters) const;
  bool isDone() const { return is_done_.load(std::memory_order_acquire); }
  /// Makes the parts. An exception is left to the first cycle that needs the part.
  void run();

 private:
  void makeParts() const;

  std::shared_ptr<const BodyMesh> a_;
  std::shared_ptr<const BodyMesh> b_;
  bool keeps_through_material_;
  bool lists_hidden_;
  bool is_searched_;
  std::atomic<bool> is_done_{false};
};

/// Runs such tasks on a thread of its own that gives way to others, so that no cycle waits for them.
class NichePreparation {
 public:
  NichePreparation() = default;
  /// Waits for the task that runs; the others are dropped.
  ~NichePreparation();
  NichePreparation(const NichePreparation&) = delete;
  NichePreparation& operator=(const NichePreparation&) = delete;

  /// Runs a task after those that came before; at once where no thread can be had.
  void add(std::shared_ptr<PreparationTask> task);
  /// Makes what a mesh needs against any other, once.
  void addAhead(const std::shared_ptr<const BodyMesh>& mesh, const TrackerParameters& parameters);

 private:
  void work();
  std::unordered_set<const BodyMesh*> begun_ahead_;  ///< meshes, some of which may be gone

  std::mutex mutex_;  ///< of the following
  std::condition_variable added_;
  std::vector<std::shared_ptr<PreparationTask>> tasks_;  ///< that nobody has begun
  bool is_ending_ = false;
  std::thread thread_;  ///< begins with the first task
};

}  // namespace concave_distance

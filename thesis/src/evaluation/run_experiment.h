#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "experiment.h"

namespace concave_distance::evaluation {

struct EvaluationOptions {
  std::string meshes;       ///< folder of the thesis's meshes and poses
  std::string output;       ///< folder of the results
  std::uint32_t runs = 0;   ///< of every row on every scene
  std::uint32_t shard = 0;  ///< does every shard_count-th unit of work, from this one on
  std::uint32_t shard_count = 1;
};

/// Told after each unit of work: runs done so far (those of earlier calls included) and in all.
using ProgressObserver = std::function<void(std::uint64_t done, std::uint64_t all)>;

/// Runs what the results do not hold yet, in parallel over units of work. What a run gives depends on the
/// experiment's seed, the row and the run's number alone.
/// @throws Error for what is wrong with files
void runExperiment(const Experiment& experiment, const EvaluationOptions& options,
                   const ProgressObserver& progress);

}  // namespace concave_distance::evaluation

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/scene/scene.h"
#include "frames_now.h"
#include "pair_partners.h"
#include "scene_operation.h"

namespace concave_distance::detail {

/// Says what is wrong with one operation of a batch.
struct OperationFault {
  std::size_t operation;  ///< its place
  std::string body;       ///< SceneOperation::body
  Error error;
  bool selects_nothing = false;  ///< no body or pair is left of its pattern or group
};

/// Says what a caller should know of an operation that was applied.
struct OperationRemark {
  std::size_t operation = 0;         ///< its place
  AddedPairs added;                  ///< Add: without the names of pairs
  std::vector<std::string> unknown;  ///< Attach: touch_links that name no body
};

struct AppliedOperations {
  std::vector<OperationFault> faults;    ///< empty: all were applied
  std::vector<OperationRemark> remarks;  ///< of Add and Attach
};

/// Applies one operation and records it in Scene::operations.
/// @return names of the pairs that it switches or sets, 1000 at most of groups and patterns
/// @throws Error for what is wrong with it; then nothing is changed, but for the pairs of a pattern
std::vector<std::string> applyOperation(Scene& scene, const SceneOperation& operation,
                                        const FramesNow& frames);

/// Most operations of one batch.
inline constexpr std::size_t kMostOperations = 10'000;

/// @throws Error for more than kMostOperations
void requireBatchSize(std::size_t operations);

/// Applies and records a batch on a copy of a scene, each operation on what those before it have made. Each
/// fault is listed, and an operation is left out that names a body whose Add has failed. When there is one,
/// the caller drops the copy or, with operations that are independent of each other, keeps what was applied:
/// one with a fault has changed nothing.
AppliedOperations applyOperations(Scene& scene, const std::vector<SceneOperation>& operations,
                                  const FramesNow& frames);

}  // namespace concave_distance::detail

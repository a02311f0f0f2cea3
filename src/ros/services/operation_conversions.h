#pragma once

#include <concave_distance/SceneOperation.h>

#include <cstddef>
#include <string>

#include "concave_distance/loading/load_scene.h"
#include "scene/scene_operation.h"

namespace concave_distance {

/// Returns the operation of a message, without the body of an ADD (see bodyOf()). What is wrong with its
/// numbers is its `problem`.
detail::SceneOperation toOperation(const SceneOperation& message);

/// Returns the body of an ADD, at the origin of its frame.
/// @param defaults of the scene, for what the message leaves at 0
/// @param largest_triangle_count of each of its `meshes`
/// @throws Error for one without a shape, for a shape that is none, and for numbers out of range
BodyDescription bodyOf(const SceneOperation& message, const SceneDefaults& defaults,
                       std::size_t largest_triangle_count);

/// Gives a loaded body the place, colour and margin of an ADD, and the scene's material.
/// @throws Error for a pose or margin that is out of range
void finishBody(const SceneOperation& message, const SceneDefaults& defaults, SceneBody& body);

/// Returns what the new pairs of a message are told: a warning distance or nothing.
/// @throws Error for a length that is negative or not a number
template <typename Message>
std::optional<double> warningDistanceOf(const Message& message) {
  if (message.has_warning_distance == 0) return std::nullopt;
  if (!(message.warning_distance >= 0.0) || !(message.warning_hysteresis >= 0.0)) {
    throw Error("warning_distance", "a length is negative or not a number", "give metres, 0 or more");
  }
  return message.warning_distance;
}

/// Returns the colour of a message; all 0: `fallback`.
Eigen::Vector4d toColour(const std_msgs::ColorRGBA& color, const Eigen::Vector4d& fallback);

}  // namespace concave_distance

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/scene/scene.h"
#include "pair_partners.h"

namespace concave_distance::detail {

enum class OperationKind : std::uint8_t {
  Add,
  Move,
  Remove,
  Attach,
  Detach,
  AllowContact,     ///< the pairs of both sides are switched off
  DisallowContact,  ///< ... and on
  SetMargin
};

/// One operation of a batch. Fields that its kind does not name are ignored.
struct SceneOperation {
  OperationKind kind = OperationKind::Add;
  /// SetMargin: a body, group or pattern; Allow- and DisallowContact: side A, likewise; else a body's name.
  std::string body;
  std::string other;  ///< Attach: the parent; Allow- and DisallowContact: side B
  std::string frame;  ///< Move: of the pose; Detach: in which the body stays; empty as in body_placement.h
  Eigen::Isometry3d frame_from_body = Eigen::Isometry3d::Identity();  ///< Move
  std::vector<std::string> touch_links;                               ///< Attach: as attachBody()'s may_touch
  std::optional<SceneBody> added;                                     ///< Add: with its mesh
  PairPartners partners;                                              ///< Add
  /// Add: metres, of the new pairs, and the hysteresis; empty: as the scene's defaults
  std::optional<double> warning_distance;
  double warning_hysteresis = 0.0;
  bool allow_robot_link = false;  ///< Remove
  double margin = 0.0;            ///< SetMargin: metres
  /// Says what is known to be wrong already, such as a mesh that cannot be read; empty: nothing.
  std::optional<Error> problem;
};

}  // namespace concave_distance::detail

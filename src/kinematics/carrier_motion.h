#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "concave_distance/contact/wrench.h"
#include "concave_distance/kinematics/scene_kinematics.h"

namespace concave_distance::detail {

/// Follows what no joint moves: bodies on no robot, and the roots of robots.
class CarrierMotion {
 public:
  /// Forgets all poses.
  void reset();
  /// Another revision of the scene: bodies and robots that are in both go on.
  void setScene(const SceneKinematics& before, const SceneKinematics& now);
  void update(const SceneKinematics& joints, const SceneState& state, double time);
  /// Returns the velocity of what carries a body, about the world's origin; nothing where it was not known in
  /// two updates, or the time did not advance.
  const std::optional<RelativeTwist>& of(const SceneKinematics& joints, std::size_t body) const;

 private:
  struct Carrier {
    std::optional<Eigen::Isometry3d> pose;
    std::optional<RelativeTwist> twist;
    void move(const std::optional<Eigen::Isometry3d>& now, double seconds);
  };

  std::vector<Carrier> roots_;
  std::vector<Carrier> bodies_;
  std::optional<double> time_;
};

}  // namespace concave_distance::detail

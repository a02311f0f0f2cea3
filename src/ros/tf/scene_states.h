#pragma once

#include <memory>
#include <string>
#include <vector>

#include "concave_distance/kinematics/scene_kinematics.h"
#include "tf_locate.h"

namespace concave_distance {

/// Reads where robots and bodies are in one cycle: links by tf, also those without geometry, so that joints
/// need no positions. Each robot is taken at the oldest of the newest times of its bodies.
class SceneStates {
 public:
  void setScene(std::shared_ptr<const SceneKinematics> joints, const std::string& reference_frame);
  /// @param locate updated in this cycle
  void update(TfLocate& locate);

  /// Bodies that are not known now, and those on links that are not, have no pose.
  const SceneState& state() const { return state_; }
  /// Why links have no pose: one for each robot that has such.
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  void placeRobot(TfLocate& locate, std::size_t robot);

  std::shared_ptr<const SceneKinematics> joints_;
  std::string reference_frame_;
  SceneState state_;
  std::vector<std::vector<bool>> is_known_;  ///< links of robots
  std::vector<std::string> problems_;
};

}  // namespace concave_distance

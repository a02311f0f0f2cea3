#include "concave_distance/scene/rigid_frames.h"

namespace concave_distance {

void RigidFrames::join(const std::string& a, const std::string& b) {
  const std::string root_a = rootOf(a);
  const std::string root_b = rootOf(b);
  if (root_a != root_b) parent_[root_b] = root_a;
}

bool RigidFrames::areJoined(const std::string& a, const std::string& b) const {
  return rootOf(a) == rootOf(b);
}

std::string RigidFrames::rootOf(std::string frame) const {
  for (auto found = parent_.find(frame); found != parent_.end(); found = parent_.find(frame)) {
    frame = found->second;
  }
  return frame;
}

}  // namespace concave_distance

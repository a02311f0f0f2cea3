#include "benchmark/support/swaying_joints.h"

#include <algorithm>
#include <cmath>

namespace concave_distance::benchmark {
namespace {

constexpr double kTurn = 0.5;          // rad, largest amplitude of a turning joint
constexpr double kShift = 0.1;         // m, of a sliding one
constexpr double kShareOfRange = 0.2;  // at most, of both
constexpr double kSlowest = 0.07;      // Hz
constexpr double kFrequencyStep = 0.011;
constexpr std::size_t kFrequencies = 7;

bool isMoved(const urdf::Joint& joint) {
  const bool has_one_axis = joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS ||
                            joint.type == urdf::Joint::PRISMATIC;
  return has_one_axis && !joint.mimic;
}

void keepInRange(const urdf::Joint& joint, SwayingJoint& moved) {
  if (joint.type == urdf::Joint::CONTINUOUS || !joint.limits) return;
  const double lower = joint.limits->lower;
  const double upper = joint.limits->upper;
  if (!(lower < upper)) {
    moved.centre = std::clamp(0.0, std::min(lower, upper), std::max(lower, upper));
    moved.amplitude = 0.0;
    return;
  }
  if (lower > 0.0 || upper < 0.0) moved.centre = 0.5 * (lower + upper);
  moved.amplitude = std::min(moved.amplitude, kShareOfRange * (upper - lower));
  moved.centre = std::clamp(moved.centre, lower + moved.amplitude, upper - moved.amplitude);
}

}  // namespace

double SwayingJoint::at(double time) const {
  return centre + amplitude * std::sin(2.0 * M_PI * frequency * time);
}

std::vector<SwayingJoint> swayingJoints(const urdf::ModelInterface& model) {
  std::vector<SwayingJoint> joints;
  for (const auto& [name, joint] : model.joints_) {
    if (!isMoved(*joint)) continue;
    const double frequency = kSlowest + kFrequencyStep * static_cast<double>(joints.size() % kFrequencies);
    joints.push_back({name, 0.0, joint->type == urdf::Joint::PRISMATIC ? kShift : kTurn, frequency});
    keepInRange(*joint, joints.back());
  }
  return joints;
}

}  // namespace concave_distance::benchmark

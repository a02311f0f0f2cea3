#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "motion_paths.h"

namespace concave_distance::detail {

/// Where two bodies are at one moment of a motion, and what moves one against the other, in one frame that
/// neither moves against (the base).
struct RelativePose {
  struct Axis {
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< of a turn
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Matrix3d slides = Eigen::Matrix3d::Zero();  ///< of a slide or shift: its axes
  };
  MotionMoment at;
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d base_from_a = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d base_from_b = Eigen::Isometry3d::Identity();
  std::vector<Axis> axes;  ///< as RelativePath::elements()
};

/// Says what moves a body B against a body A: the joints of both behind their last common one. Body frames
/// are those of the meshes as they are solved.
class RelativePath {
 public:
  /// @param a,b paths, with the bodies' frames recentred
  RelativePath(const MotionPaths& paths, const BodyPath& a, const BodyPath& b);

  bool isMoved() const { return !elements_.empty(); }
  /// From A to the base and from there to B; the first countOfA() of them move A.
  const std::vector<std::size_t>& elements() const { return elements_; }
  std::size_t countOfA() const { return count_of_a_; }

  /// Allocates nothing once the buffer of `pose` has grown.
  void evaluate(const MotionPaths& paths, MotionMoment at, RelativePose& pose) const;
  /// Metres: bounds what rounding does to the pose of any point of B within `radius` of its frame's origin.
  double rounding(const MotionPaths& paths, double radius) const;
  /// Where A is in the world. @param moment as for evaluate()
  static Eigen::Isometry3d worldFrom(const MotionPaths& paths, const BodyPath& body, MotionMoment at);

 private:
  struct Branch {
    Eigen::Isometry3d start = Eigen::Isometry3d::Identity();  ///< before the first of its elements
    Eigen::Isometry3d tail = Eigen::Isometry3d::Identity();
  };
  void evaluateBranch(const MotionPaths& paths, bool is_of_a, MotionMoment at, RelativePose& pose) const;

  std::vector<std::size_t> elements_;
  std::size_t count_of_a_ = 0;
  Branch a_;
  Branch b_;
  double start_length_ = 0.0;  ///< metres, of the poses that the starts were made of
};

}  // namespace concave_distance::detail

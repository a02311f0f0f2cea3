#include "relative_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace concave_distance::detail {
namespace {

Eigen::Isometry3d motionOf(const MotionPaths& paths, const PathElement& element, MotionMoment at) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  const MotionCurve& curve = paths.curves[element.curve];
  switch (element.kind) {
    case PathElement::Kind::Turn:
      motion.linear() = Eigen::AngleAxisd(curve.value(at), element.axes.col(0)).toRotationMatrix();
      break;
    case PathElement::Kind::Slide:
      motion.translation() = curve.value(at) * element.axes.col(0);
      break;
    case PathElement::Kind::Shift:
      motion.translation() =
          element.axes * Eigen::Vector3d(curve.value(at), paths.curves[element.curve + 1].value(at),
                                         paths.curves[element.curve + 2].value(at));
      break;
    case PathElement::Kind::Slerp: {
      const WaypointTurns& turns = paths.turns[element.turns];
      const double angle = at.share * curve.rate(at);
      motion.linear() =
          turns.rotations[at.segment] * Eigen::AngleAxisd(angle, turns.axes[at.segment]).toRotationMatrix();
      break;
    }
  }
  return motion;
}

RelativePose::Axis axisOf(const MotionPaths& paths, const PathElement& element, MotionMoment at,
                          const Eigen::Isometry3d& base_from_element) {
  RelativePose::Axis axis;
  axis.origin = base_from_element.translation();
  switch (element.kind) {
    case PathElement::Kind::Turn:
      axis.direction = base_from_element.linear() * element.axes.col(0);
      break;
    case PathElement::Kind::Slide:
      axis.slides.col(0) = base_from_element.linear() * element.axes.col(0);
      break;
    case PathElement::Kind::Shift:
      axis.slides = base_from_element.linear() * element.axes;
      break;
    case PathElement::Kind::Slerp: {
      const WaypointTurns& turns = paths.turns[element.turns];
      axis.direction = base_from_element.linear() * (turns.rotations[at.segment] * turns.axes[at.segment]);
      break;
    }
  }
  return axis;
}

}  // namespace

RelativePath::RelativePath(const MotionPaths& paths, const BodyPath& a, const BodyPath& b) {
  std::size_t common = 0;
  while (common < std::min(a.elements.size(), b.elements.size()) &&
         a.elements[common] == b.elements[common]) {
    ++common;
  }
  const auto start_of = [&](const BodyPath& path) {
    Branch branch;
    branch.start = common == 0 ? path.start : Eigen::Isometry3d::Identity();
    branch.tail = path.tail;
    if (path.elements.size() > common) {
      branch.start = branch.start * paths.elements[path.elements[common]].before;
    } else {
      branch.start = branch.start * path.tail;
      branch.tail = Eigen::Isometry3d::Identity();
    }
    start_length_ += path.start.translation().norm() + branch.start.translation().norm();
    return branch;
  };
  a_ = start_of(a);
  b_ = start_of(b);
  // The base is where A's branch begins: what is far from the world's origin cancels once, here.
  b_.start = a_.start.inverse(Eigen::Isometry) * b_.start;
  a_.start = Eigen::Isometry3d::Identity();
  const auto first = static_cast<std::ptrdiff_t>(common);
  elements_.assign(a.elements.rbegin(), a.elements.rend() - first);
  count_of_a_ = elements_.size();
  elements_.insert(elements_.end(), b.elements.begin() + first, b.elements.end());
}

void RelativePath::evaluateBranch(const MotionPaths& paths, bool is_of_a, MotionMoment at,
                                  RelativePose& pose) const {
  const Branch& branch = is_of_a ? a_ : b_;
  const std::size_t count = is_of_a ? count_of_a_ : elements_.size() - count_of_a_;
  Eigen::Isometry3d base_from_moved = branch.start;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t place = is_of_a ? count_of_a_ - 1 - k : count_of_a_ + k;
    const PathElement& element = paths.elements[elements_[place]];
    if (k > 0) base_from_moved = base_from_moved * element.before;
    pose.axes[place] = axisOf(paths, element, at, base_from_moved);
    base_from_moved = base_from_moved * motionOf(paths, element, at);
  }
  (is_of_a ? pose.base_from_a : pose.base_from_b) = base_from_moved * branch.tail;
}

void RelativePath::evaluate(const MotionPaths& paths, MotionMoment at, RelativePose& pose) const {
  pose.at = at;
  pose.axes.resize(elements_.size());
  evaluateBranch(paths, true, at, pose);
  evaluateBranch(paths, false, at, pose);
  pose.a_from_b = pose.base_from_a.inverse(Eigen::Isometry) * pose.base_from_b;
}

// Each product of poses loses at most 8 units of rounding of the lengths that it adds up, and each angle 4 of
// the terms of its polynomial, times the lengths behind it.
double RelativePath::rounding(const MotionPaths& paths, double radius) const {
  double length = radius + start_length_ + b_.start.translation().norm() + a_.tail.translation().norm() +
                  b_.tail.translation().norm();
  double angles = 0.0;
  for (std::size_t place = 0; place < elements_.size(); ++place) {
    const PathElement& element = paths.elements[elements_[place]];
    length += element.before.translation().norm();
    const auto magnitude = [&](std::size_t k) { return paths.curves[element.curve + k].magnitude(); };
    switch (element.kind) {
      case PathElement::Kind::Turn:
        angles += magnitude(0);
        break;
      case PathElement::Kind::Slide:
        length += magnitude(0);
        break;
      case PathElement::Kind::Shift:
        length += magnitude(0) + magnitude(1) + magnitude(2);
        break;
      case PathElement::Kind::Slerp:
        angles += 4.0;
        break;
    }
  }
  const double operations = 16.0 + 16.0 * static_cast<double>(elements_.size()) + 4.0 * angles;
  return operations * std::numeric_limits<double>::epsilon() * length;
}

Eigen::Isometry3d RelativePath::worldFrom(const MotionPaths& paths, const BodyPath& body, MotionMoment at) {
  Eigen::Isometry3d pose = body.start;
  for (const std::size_t element : body.elements) {
    pose = pose * paths.elements[element].before * motionOf(paths, paths.elements[element], at);
  }
  return pose * body.tail;
}

}  // namespace concave_distance::detail

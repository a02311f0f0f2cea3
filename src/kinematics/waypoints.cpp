#include "waypoints.h"

#include <cmath>
#include <string>
#include <utility>

#include "base/constants.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "wording.h"

namespace concave_distance::detail {
namespace {

std::string sizeText(const Eigen::MatrixXd& numbers) {
  return std::to_string(numbers.rows()) + " x " + std::to_string(numbers.cols());
}

void requireNumbers(const JointMotion& motion, const Eigen::MatrixXd& numbers, const std::string& what,
                    const std::string& unit) {
  const auto columns = static_cast<Eigen::Index>(motion.joints.size());
  if (numbers.rows() != motion.positions.rows() || numbers.cols() != columns) {
    throw Error(what, "their size is " + sizeText(numbers),
                "give " + counted(static_cast<std::size_t>(motion.positions.rows()), "row") + " with " +
                    counted(motion.joints.size(), "number") + ", one for each joint");
  }
  for (Eigen::Index row = 0; row < numbers.rows(); ++row) {
    for (Eigen::Index column = 0; column < columns; ++column) {
      const double number = numbers(row, column);
      if (std::abs(number) <= kLargestCoordinate) continue;
      throw Error("waypoint " + std::to_string(row) + ", joint '" +
                      motion.joints[static_cast<std::size_t>(column)] + "'",
                  "one of the " + what + " is " + numberText(number),
                  "give finite numbers up to 1e18, " + unit);
    }
  }
}

MotionCurve::Coefficients cubic(double from, double to, double rate_from, double rate_to) {
  const double way = to - from;
  return {from, rate_from, 3.0 * way - 2.0 * rate_from - rate_to, -2.0 * way + rate_from + rate_to};
}

MotionCurve::Coefficients quintic(double from, double to, double rate_from, double rate_to, double bend_from,
                                  double bend_to) {
  const double way = to - from;
  return {from,
          rate_from,
          0.5 * bend_from,
          10.0 * way - 6.0 * rate_from - 4.0 * rate_to - 1.5 * bend_from + 0.5 * bend_to,
          -15.0 * way + 8.0 * rate_from + 7.0 * rate_to + 1.5 * bend_from - bend_to,
          6.0 * way - 3.0 * rate_from - 3.0 * rate_to - 0.5 * bend_from + 0.5 * bend_to};
}

}  // namespace

std::vector<double> requireTimes(const std::vector<double>& times, std::size_t count,
                                 const std::function<bool(std::size_t)>& are_equal) {
  if (count == 0) throw Error("motion", "it has no waypoint", "give at least one");
  if (times.empty()) {
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<double>(i);
    return numbers;
  }
  if (times.size() != count) {
    throw Error("motion", counted(times.size(), "time") + " for " + counted(count, "waypoint"),
                "give a time for each waypoint, or none at all");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::string where = "waypoint " + std::to_string(i);
    if (!(std::abs(times[i]) <= kLargestCoordinate)) {
      throw Error(where, "its time is not finite, or beyond 1e18 s", "give seconds");
    }
    if (i == 0 || times[i] > times[i - 1]) continue;
    if (times[i] == times[i - 1] && are_equal(i)) continue;
    throw Error(where,
                "its time, " + numberText(times[i]) + " s, is not after that of the waypoint before it, " +
                    numberText(times[i - 1]) + " s",
                "let times ascend; only equal waypoints may have one time");
  }
  return times;
}

std::vector<double> requireWaypoints(const JointMotion& motion) {
  requireNumbers(motion, motion.positions, "positions", "rad or m");
  const bool has_velocities = motion.velocities.size() > 0;
  const bool has_accelerations = motion.accelerations.size() > 0;
  if (has_velocities) requireNumbers(motion, motion.velocities, "velocities", "rad/s or m/s");
  if (has_accelerations) requireNumbers(motion, motion.accelerations, "accelerations", "rad/s^2 or m/s^2");
  if (has_accelerations && !has_velocities) {
    throw Error("accelerations", "they are given without velocities", "give both, or neither");
  }
  if (has_velocities && motion.times.empty()) {
    throw Error("velocities", "they are given without times", "give the times of the waypoints too");
  }
  return requireTimes(motion.times, static_cast<std::size_t>(motion.positions.rows()), [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    return motion.positions.row(row) == motion.positions.row(row - 1);
  });
}

MotionCurve curveOf(const JointMotion& motion, const std::vector<double>& times, std::size_t column) {
  const auto of = [column](const Eigen::MatrixXd& numbers, std::size_t row) {
    return numbers(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
  };
  std::vector<double> values;
  for (std::size_t i = 0; i < times.size(); ++i) values.push_back(of(motion.positions, i));
  if (motion.velocities.size() == 0 || times.size() == 1) return MotionCurve::straight(values);
  const bool is_quintic = motion.accelerations.size() > 0;
  std::vector<MotionCurve::Coefficients> segments;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double seconds = times[i + 1] - times[i];
    const double rate_from = seconds * of(motion.velocities, i);
    const double rate_to = seconds * of(motion.velocities, i + 1);
    if (is_quintic) {
      segments.push_back(quintic(values[i], values[i + 1], rate_from, rate_to,
                                 seconds * seconds * of(motion.accelerations, i),
                                 seconds * seconds * of(motion.accelerations, i + 1)));
    } else {
      segments.push_back(cubic(values[i], values[i + 1], rate_from, rate_to));
    }
  }
  return {std::move(segments), is_quintic ? std::size_t{5} : std::size_t{3}};
}

}  // namespace concave_distance::detail

#include "benchmark/support/joint_path.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/csv_table.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"

namespace concave_distance::benchmark {
namespace {

// The last row may be this far from the first one: both are written with 9 digits or more.
constexpr double kClosingTolerance = 1e-9;

/// The first column as seconds. @throws Error naming `path` unless they rise strictly and all is finite
std::vector<double> readTimes(const CsvTable& table, const std::string& path) {
  std::vector<double> times;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const std::string where = path + ":" + std::to_string(table.lines[row]);
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      if (!std::isfinite(table.at(row, column))) {
        throw Error(where, "column " + table.columns[column] + " is not finite", "correct the cell");
      }
    }
    const double time = table.at(row, 0);
    if (!times.empty() && !(time > times.back())) {
      throw Error(where, "time " + numberText(time) + " s does not follow " + numberText(times.back()) + " s",
                  "sort the rows by time");
    }
    times.push_back(time);
  }
  return times;
}

}  // namespace

JointPath::JointPath(std::vector<double> times, Eigen::MatrixXd waypoints, double period)
    : times_(std::move(times)), waypoints_(std::move(waypoints)), period_(period) {
  // Equal second derivatives from both sides of every waypoint: one linear equation each, cyclic.
  const auto count = static_cast<Eigen::Index>(times_.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd right(count, waypoints_.cols());
  const auto span_after = [&](Eigen::Index i) {
    const auto k = static_cast<std::size_t>(i);
    return (i + 1 < count ? times_[k + 1] : period_) - times_[k];
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index last = (i + count - 1) % count;
    const Eigen::Index next = (i + 1) % count;
    const double before = span_after(last);
    const double after = span_after(i);
    system(i, last) += 1.0 / before;
    system(i, i) += 2.0 / before + 2.0 / after;
    system(i, next) += 1.0 / after;
    right.row(i) = 3.0 * ((waypoints_.row(i) - waypoints_.row(last)) / (before * before) +
                          (waypoints_.row(next) - waypoints_.row(i)) / (after * after));
  }
  velocities_ = system.partialPivLu().solve(right);
}

Eigen::VectorXd JointPath::at(double time) const {
  double phase = std::fmod(time, period_);
  if (phase < 0.0) phase += period_;
  const auto after = std::upper_bound(times_.begin(), times_.end(), phase);
  const auto i = std::max<Eigen::Index>(static_cast<Eigen::Index>(after - times_.begin()) - 1, 0);
  const auto count = static_cast<Eigen::Index>(times_.size());
  const Eigen::Index next = (i + 1) % count;
  const double start = times_[static_cast<std::size_t>(i)];
  const double span = (i + 1 < count ? times_[static_cast<std::size_t>(i) + 1] : period_) - start;
  const double s = (phase - start) / span;
  // Hermite's basis.
  return ((1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s) * waypoints_.row(i) +
          s * (1.0 - s) * (1.0 - s) * span * velocities_.row(i) +
          s * s * (3.0 - 2.0 * s) * waypoints_.row(next) + s * s * (s - 1.0) * span * velocities_.row(next))
      .transpose();
}

NamedJointPath readJointPath(const std::string& path) {
  const CsvTable table = readCsv(path);
  if (table.columns.size() < 2 || table.columns.front() != "t") {
    throw Error(path, "the columns are others than a joint path's",
                "begin with the line t,<joint>,<joint>,...");
  }
  std::vector<double> times = readTimes(table, path);
  if (times.size() < 4 || times.front() != 0.0) {
    throw Error(path, std::to_string(times.size()) + " rows from t = " + numberText(times.front()) + " s",
                "give at least four rows, the first at t = 0");
  }
  const auto joints = static_cast<Eigen::Index>(table.columns.size()) - 1;
  Eigen::MatrixXd waypoints(static_cast<Eigen::Index>(times.size()), joints);
  for (Eigen::Index row = 0; row < waypoints.rows(); ++row) {
    for (Eigen::Index joint = 0; joint < joints; ++joint) {
      waypoints(row, joint) = table.at(static_cast<std::size_t>(row), static_cast<std::size_t>(joint) + 1);
    }
  }
  const double gap = (waypoints.bottomRows<1>() - waypoints.topRows<1>()).cwiseAbs().maxCoeff();
  if (!(gap <= kClosingTolerance)) {
    throw Error(path, "the path does not close: its ends differ by " + numberText(gap),
                "repeat the first row as the last one, at the end of the period");
  }
  const double period = times.back();
  times.pop_back();
  const Eigen::MatrixXd open = waypoints.topRows(waypoints.rows() - 1);
  return {{table.columns.begin() + 1, table.columns.end()}, JointPath(std::move(times), open, period)};
}

}  // namespace concave_distance::benchmark

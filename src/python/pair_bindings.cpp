#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "answers.h"
#include "bindings.h"
#include "concave_distance/base/error.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "parameter_arguments.h"
#include "pose_arrays.h"
#include "python_body.h"
#include "signal_check.h"
#include "unlocked.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

constexpr const char* kWhere = "PairTracker";

TrackerParameters parametersFor(const PythonBody& a, const PythonBody& b, TrackerParameters parameters,
                                const py::kwargs& keywords) {
  setParameters(keywords, kWhere, parameters);
  requireMargin("margin_a", parameters.margin_a, *a.mesh);
  requireMargin("margin_b", parameters.margin_b, *b.mesh);
  return parameters;
}

std::vector<double> readTimes(const py::object& times, std::size_t count) {
  if (times.is_none()) return std::vector<double>(count, 0.0);
  const DoubleArray numbers = readNumbers(times, "times");
  if (numbers.ndim() > 1 || static_cast<std::size_t>(numbers.size()) != count)
    throw Error("times",
                "there are " + std::to_string(numbers.size()) + " for " + std::to_string(count) + " poses",
                "give one for each pose, seconds");
  std::vector<double> read(numbers.data(), numbers.data() + numbers.size());
  if (!std::all_of(read.begin(), read.end(), [](double t) { return std::isfinite(t); }))
    throw Error("times", "one of them is not finite", "give seconds");
  return read;
}

/// Python has this as PairTracker: usable from any thread, one at a time.
class PythonPair {
 public:
  PythonPair(const PythonBody& a, const PythonBody& b, const std::string& name, const py::kwargs& keywords)
      : a_(a), b_(b), tracker_(name, a.mesh, b.mesh, parametersFor(a, b, {}, keywords)) {}

  Answers update(const py::object& poses, const py::object& times) {
    const std::vector<GivenPose> given = readPoses(poses, "poses");
    const std::vector<double> seconds = readTimes(times, given.size());
    return answer(given, [&](std::size_t i) { tracker_.update(given[i].pose, seconds[i], solution_); });
  }
  Answers solve(const py::object& poses) {
    const std::vector<GivenPose> given = readPoses(poses, "poses");
    return answer(given, [&](std::size_t i) { tracker_.solve(given[i].pose, solution_); });
  }
  void restart() {
    const Unlocked unlocked;
    const std::lock_guard<std::mutex> turn(mutex_);
    tracker_.restart();
  }
  py::dict parameters() { return valuesOf(currentParameters()); }
  void setParameters(const py::kwargs& keywords) {
    const TrackerParameters parameters = parametersFor(a_, b_, currentParameters(), keywords);
    const Unlocked unlocked;
    const std::lock_guard<std::mutex> turn(mutex_);
    tracker_.setParameters(parameters);
  }
  const PythonBody& bodyA() const { return a_; }
  const PythonBody& bodyB() const { return b_; }

 private:
  TrackerParameters currentParameters() {
    const Unlocked unlocked;
    const std::lock_guard<std::mutex> turn(mutex_);
    return tracker_.parameters();
  }
  template <typename SolveOne>
  Answers answer(const std::vector<GivenPose>& poses, const SolveOne& solve_one) {
    const Unlocked unlocked;
    const std::lock_guard<std::mutex> turn(mutex_);
    Answers answers;
    answers.rows.reserve(poses.size());
    answers.niche_offsets.reserve(poses.size() + 1);
    SignalCheck check_signals;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      solve_one(i);
      answers.append(solution_);
      check_signals();
    }
    return answers;
  }

  PythonBody a_;
  PythonBody b_;
  std::mutex mutex_;
  PairTracker tracker_;
  PairSolution solution_;
};

Answers solveEachOf(const PythonBody& a, const PythonBody& b, const py::object& poses,
                    const std::string& name, std::uint32_t threads, const py::kwargs& keywords) {
  const std::vector<GivenPose> given = readPoses(poses, "poses");
  const TrackerParameters parameters = parametersFor(a, b, {}, keywords);
  const Unlocked unlocked;
  // So many solutions at a time, with their niches, are held besides the answers; signals are looked for
  // between.
  constexpr std::size_t kLargestBatch = 1024;
  constexpr std::chrono::milliseconds kUsualDuration{50};
  SignalCheck check_signals;
  Answers answers;
  std::size_t batch_size = 16;
  for (std::size_t first = 0; first < given.size();) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<Eigen::Isometry3d> batch;
    const std::size_t end = std::min(first + batch_size, given.size());
    for (; first < end; ++first) batch.push_back(given[first].pose);
    for (const PairSolution& solution : solveEach(name, a.mesh, b.mesh, parameters, batch, threads))
      answers.append(solution);
    if (std::chrono::steady_clock::now() - begin < kUsualDuration)
      batch_size = std::min(2 * batch_size, kLargestBatch);
    check_signals();
  }
  return answers;
}

}  // namespace

void bindPairs(py::module& module) {
  module.def(
      "parameters", &describeParameters, py::arg("of_scene") = false,
      "The keywords of PairTracker, or those of load_scene and load_robot that set defaults of pairs: a "
      "dict for each, with name, unit, default, allowed, description, is_expert.");
  module.def("solve_each", &solveEachOf, py::arg("body_a"), py::arg("body_b"), py::arg("poses"),
             py::arg("name") = "pair", py::arg("threads") = 0,
             "Solves at each pose alone, in parallel: the answers of PairTracker.solve, for any number of "
             "threads.\n\n"
             "poses: of B in A's frame, (n, 4, 4) matrices or (n, 7) with x, y, z, qx, qy, qz, qw, metres\n"
             "threads: 0 for one per core\n"
             "Further keywords as of PairTracker. Returns Answers with n rows.");
  py::class_<PythonPair>(
      module, "PairTracker",
      "A pair of bodies over time. It may be used from any thread; calls wait for each other.")
      .def(py::init<const PythonBody&, const PythonBody&, const std::string&, const py::kwargs&>(),
           py::arg("body_a"), py::arg("body_b"), py::arg("name") = "pair",
           "name: keys the random streams, with the seed\n"
           "Further keywords: parameters(). None means no limit, or automatic.\n"
           "Raises Error naming the keyword, the value seen and what is allowed.")
      .def(
          "update", &PythonPair::update, py::arg("poses"), py::arg("times") = py::none(),
          "Solves at successive poses of one motion, warm-started from the niches of the pose before.\n\n"
          "poses: of B in A's frame, (4, 4), (n, 4, 4), (7,) or (n, 7) with x, y, z, qx, qy, qz, qw, metres\n"
          "times: (n,) seconds, for closing speeds; None: they are NaN\n"
          "Returns Answers with a row for each pose; one that is no pose has the status INVALID_POSE.")
      .def("solve", &PythonPair::solve, py::arg("poses"),
           "Solves at each pose alone, and ends what was tracked. Poses and answers as of update.")
      .def("restart", &PythonPair::restart, "As if newly made: the next update is cold, ids begin anew.")
      .def("set_parameters", &PythonPair::setParameters,
           "Sets parameters by keyword, from the next pose on. Raises Error, and changes nothing then.")
      .def_property_readonly("parameters", &PythonPair::parameters, "A dict: the value of each keyword.")
      .def_property_readonly("body_a", &PythonPair::bodyA)
      .def_property_readonly("body_b", &PythonPair::bodyB);
}

}  // namespace concave_distance::python

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/scene/scene_tracker.h"
#include "loading/pair_record.h"
#include "loading/record_answers.h"
#include "loading/scene_files.h"
#include "scene/pair_recorder.h"
#include "support/body_motions.h"
#include "support/concave_shapes.h"
#include "support/round_bodies.h"

namespace concave_distance::test {

inline SceneBody bodyOf(const std::string& name, std::shared_ptr<const BodyMesh> mesh, double margin = 0.0) {
  SceneBody body;
  body.name = name;
  body.frame = name;
  body.bounds = boundsOf(*mesh);
  body.mesh = std::move(mesh);
  body.margin = margin;
  return body;
}

inline std::shared_ptr<const BodyMesh> meshOf(const std::string& name, SurfaceMesh surface,
                                              const BodyMeshOptions& options = {}) {
  return std::make_shared<const BodyMesh>(name, std::move(surface), options);
}

/// Two bodies in a tracked scene, of which B moves, with a recorder as the node has it.
class RecordedPair {
 public:
  static constexpr std::int64_t kEpoch = 1'700'000'000'250'000'000;

  RecordedPair(SceneBody a, SceneBody b, const PairSettings& settings, std::uint32_t length = 200)
      : recorder(length) {
    ScenePair pair;
    pair.name = a.name + "/" + b.name;
    pair.body_b = 1;
    pair.settings = settings;
    scene.bodies.push_back(std::move(a));
    scene.bodies.push_back(std::move(b));
    scene.pairs.push_back(pair);
    tracker.setScene(scene);
  }

  /// One cycle with A where it turns about z by `time`, B where `a_from_b` says; nothing: it is not known.
  void run(double time, const std::optional<Eigen::Isometry3d>& a_from_b,
           const PairDemand& demand = {true, true, true, false}) {
    const Eigen::Isometry3d world_from_a(Eigen::AngleAxisd(time, Eigen::Vector3d::UnitZ()));
    std::optional<Eigen::Isometry3d> world_from_b;
    if (a_from_b) world_from_b = world_from_a * *a_from_b;
    tracker.update({world_from_a, world_from_b}, time, demand);
    recorder.record(tracker.pairs(), kEpoch);
  }
  /// So many cycles of a motion, 50 a second.
  void run(const Motion& motion, int cycles) {
    for (int k = 0; k < cycles; ++k) run(0.02 * k, motion.at(0.02 * k));
  }
  std::optional<PairRecording> take(std::size_t most = 1'000'000) {
    return recorder.take(scene.bodies[1].serial, scene.bodies[0].serial, most, std::chrono::milliseconds(0));
  }
  const TrackedPair& tracked() const { return *tracker.pairs().front(); }

  Scene scene;
  SceneTracker tracker{SceneTrackerOptions{1, nullptr, false}};
  PairRecorder recorder;
};

/// Writes what record_pair writes. @return the answers
inline detail::RecordAnswers writeRecording(const PairRecording& recording, const std::string& folder) {
  const detail::PairRecord record = detail::recordOf(recording);
  detail::RecordAnswers answers = detail::answersTo(record, kNoCycleEnd);
  detail::writeFolder(folder, detail::savedRecord(recording, record, answers));
  return answers;
}

/// B passes A at less than a metre and turns.
inline Motion passingMotion() {
  return {Eigen::Vector3d(0.3, 0.9, 0.1), Eigen::Vector3d(0.3, 0.2, 0.1), Eigen::Vector3d(0.4, -0.7, 1.1)};
}

}  // namespace concave_distance::test

#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/random_engine.h"
#include "benchmark/support/many_bodies.h"
#include "concave_distance/loading/load_scene.h"
#include "scene/frames_now.h"
#include "scene/scene_operation.h"

namespace concave_distance::benchmark {

struct ChurnOptions {
  std::size_t bodies = 200;
  std::size_t changes = 100;    ///< a second
  std::size_t new_meshes = 20;  ///< of these
  std::uint64_t seed = 1;
};

enum class Change : std::uint8_t { Move, Attach, Detach, Remove, Add, AddNew };
inline constexpr std::size_t kChangeKinds = 6;

/// A scene of which half the bodies follow frames on smooth paths, and edits change the others: each edit as
/// the node's services make it, with a copy of the scene. scene() may be called from any thread, the rest
/// from one at a time.
class LivingScene {
 public:
  explicit LivingScene(const ChurnOptions& options);

  const ChurnOptions& options() const { return options_; }
  /// The scene after the last edit.
  std::shared_ptr<const Scene> scene() const;
  /// World poses of a scene's bodies. @param time seconds
  Poses posesOf(const Scene& scene, double time) const;

  /// Makes the next change of a second's. @return what it was: with nothing to detach, say, it is a move
  Change change(double time);
  /// Attaches a body, or detaches one; nothing moves.
  void attachOrDetach(double time);
  /// Adds 100 bodies of known shapes in one batch and takes them away again. @return milliseconds of the
  /// first
  double timeABatch(double time);

 private:
  Change changeWanted();
  bool move(double time);
  bool attach(double time);
  bool detach(double time);
  bool remove(double time);
  void add(double time, bool is_new);

  detail::FramesNow framesAt(double time) const;
  Eigen::Isometry3d poseOfFrame(const std::string& frame, double time) const;
  Eigen::Isometry3d randomPlace();
  BodyDescription knownShape();
  BodyDescription newShape();
  std::vector<detail::SceneOperation> additions(const std::vector<BodyDescription>& descriptions);
  void apply(const std::vector<detail::SceneOperation>& operations, double time);
  void serve(Scene scene);

  ChurnOptions options_;
  RandomEngine engine_;
  std::size_t links_ = 0;  ///< the first bodies, on paths
  std::vector<Path> paths_;
  std::vector<BodyDescription> shapes_;
  TriangleSoup ball_;  ///< of about 1,000 triangles
  std::uint64_t changes_ = 0;
  std::uint64_t names_ = 0;
  mutable std::mutex mutex_;
  std::shared_ptr<const Scene> scene_;
};

}  // namespace concave_distance::benchmark

#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "benchmark/support/fcl_distance.h"
#include "benchmark/support/joint_chain.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance::benchmark {

/// Joint positions that change linearly between waypoints, or on cubics where there are velocities.
struct Motion {
  std::string kind;
  std::vector<double> times;  ///< seconds, ascending
  std::vector<Eigen::VectorXd> positions;
  std::vector<Eigen::VectorXd> velocities;  ///< empty: none

  std::size_t segmentCount() const { return times.size() - 1; }
  Eigen::VectorXd at(double time) const;
};

/// An arm among bodies that stand still, as FCL sees them: distances by FCL on the same meshes, and bounds of
/// motions from the chain alone. It shares the loading of the scene with the library, and nothing else.
class MotionStage {
 public:
  struct Poses {
    std::vector<Eigen::Isometry3d> world_from_link;  ///< of the chain
    std::vector<Eigen::Isometry3d> world_from_body;  ///< one for each of bodies()
  };

  struct Ball {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0.0;
  };
  /// One body, in its own frame; balls and boxes each cover its triangles.
  struct Body {
    std::string name;
    int link = -1;                                                     ///< of the chain; -1: stands still
    Eigen::Isometry3d link_from_body = Eigen::Isometry3d::Identity();  ///< or world_from_body
    std::shared_ptr<FclModel> model;
    Ball whole;
    std::vector<Ball> balls;
    std::vector<Eigen::AlignedBox3d> boxes;
    std::vector<Eigen::Vector3d> shell_points;  ///< a vertex of each connected part
    bool is_box = false;
    std::vector<double> reach;  ///< by joint: m that no point exceeds from its axis, at any positions
  };
  struct Pair {
    std::size_t a = 0;  ///< place in bodies(), on the arm
    std::size_t b = 0;  ///< stands still, or nearer to the arm's root
    std::string name;
  };

  /// @param urdf of the arm, whose root is the frame `world`
  MotionStage(std::string name, std::shared_ptr<const Scene> scene, const std::string& urdf);

  const std::string& name() const { return name_; }
  const std::shared_ptr<const Scene>& scene() const { return scene_; }
  const JointChain& chain() const { return chain_; }
  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<Pair>& pairs() const { return pairs_; }
  /// The place in pairs() of two bodies, in either order; throws Error where there is none.
  std::size_t findPair(const std::string& name_a, const std::string& name_b) const;

  void place(const Eigen::VectorXd& positions, Poses& poses) const;

  /// Metres that the bodies are apart at least, from their balls and boxes.
  /// @param enough a bound above this need not be better
  double boundAt(std::size_t pair, const Poses& poses, double enough) const;
  /// FCL's distance, 0 for bodies that meet or of which one is within the other. @param seed the answer where
  /// the bodies are not nearer, which saves most of the work
  double distanceAt(std::size_t pair, const Poses& poses,
                    double seed = std::numeric_limits<double>::infinity()) const;
  /// The least of all pairs, or `seed` where none is nearer. @param pair receives which
  /// @param distances grows with each that FCL is asked for
  double leastAt(const Poses& poses, double seed, std::size_t* pair = nullptr,
                 std::size_t* distances = nullptr) const;

  /// Metres that no point of A exceeds in its path against B while the joints go linearly and by `change`
  /// with `middle` halfway.
  /// @param poses at `middle`
  double pathBound(std::size_t pair, const Poses& poses, const Eigen::VectorXd& change) const;

 private:
  void addBody(std::size_t index);

  std::string name_;
  std::shared_ptr<const Scene> scene_;
  JointChain chain_;
  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;
};

/// The demo arm in its cell (config/cell.yaml), 210 pairs of links and boxes.
MotionStage cellStage();
/// The demo arm before the shelf of config/robot.yaml: seven links and a mesh, and three pairs of links.
MotionStage shelfStage();

}  // namespace concave_distance::benchmark

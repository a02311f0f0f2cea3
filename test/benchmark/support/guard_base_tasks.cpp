#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "benchmark/support/guard_tasks.h"
#include "concave_distance/loading/load_scene.h"

namespace concave_distance::benchmark {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979;

/// A rectangle on the floor.
struct Rectangle {
  Vector2d centre;
  double angle;
  Vector2d half;

  std::array<Vector2d, 4> corners() const {
    std::array<Vector2d, 4> found;
    const std::array<Vector2d, 4> signs{Vector2d(1, 1), Vector2d(-1, 1), Vector2d(-1, -1), Vector2d(1, -1)};
    for (std::size_t i = 0; i < 4; ++i) found[i] = centre + Rotation2Dd(angle) * half.cwiseProduct(signs[i]);
    return found;
  }
};

/// The widest gap along a normal of a side: below 0 the rectangles overlap; else their distance or less.
double gapOf(const Rectangle& a, const Rectangle& b) {
  double widest = -1e9;
  for (const double angle : {a.angle, a.angle + kPi / 2.0, b.angle, b.angle + kPi / 2.0}) {
    const Vector2d axis(std::cos(angle), std::sin(angle));
    double low[2] = {1e9, 1e9};
    double high[2] = {-1e9, -1e9};
    for (int side = 0; side < 2; ++side) {
      for (const Vector2d& corner : (side == 0 ? a : b).corners()) {
        low[side] = std::min(low[side], axis.dot(corner));
        high[side] = std::max(high[side], axis.dot(corner));
      }
    }
    widest = std::max({widest, low[1] - high[0], low[0] - high[1]});
  }
  return widest;
}

std::string shown(double number) {
  return std::to_string(number);
}

std::string boxText(const std::string& name, const std::string& frame, const Rectangle& place) {
  return "  - {name: " + name + ", frame: " + frame + ", box: {size: [" + shown(2.0 * place.half.x()) + ", " +
         shown(2.0 * place.half.y()) + ", 0.5]}, pose: {xyz: [" + shown(place.centre.x()) + ", " +
         shown(place.centre.y()) + ", 0.25], rpy: [0, 0, " + shown(place.angle) + "]}}\n";
}

/// A base of 0.6 m by 0.4 m with a beam that stands out at its side: concave, an L seen from above.
const std::array<Rectangle, 2> kBaseParts{Rectangle{{0.0, 0.0}, 0.0, {0.3, 0.2}},
                                          Rectangle{{0.25, 0.3}, 0.0, {0.04, 0.1}}};

std::string baseUrdf(bool with_beam) {
  std::string shapes;
  for (std::size_t i = 0; i < (with_beam ? 2U : 1U); ++i) {
    const Rectangle& part = kBaseParts[i];
    shapes += "<collision><origin xyz='" + shown(part.centre.x()) + " " + shown(part.centre.y()) +
              " 0.2'/><geometry><box size='" + shown(2.0 * part.half.x()) + " " + shown(2.0 * part.half.y()) +
              " 0.3'/></geometry></collision>";
  }
  return "<robot name='base'><link name='hall'/><link name='base'>" + shapes +
         "</link><joint name='drive' type='planar'><parent link='hall'/><child link='base'/>"
         "<axis xyz='0 0 1'/></joint></robot>";
}

/// Holds what the tasks of the base have in common: three joints, x, y and theta in the hall's frame.
class BaseTask : public GuardTask {
 public:
  const Scene& scene() const override { return scene_; }
  bool touches(const VectorXd& positions) override { return gap(positions) <= 0.0; }
  double acceleration() const override { return 1.0; }
  double rowDistance() const override { return 0.8; }

 protected:
  void load(const std::string& bodies, bool with_beam) {
    part_count_ = with_beam ? 2 : 1;
    SceneLoadOptions options;
    options.descriptions["robot"] = baseUrdf(with_beam);
    scene_ = loadSceneText("defaults: {cutoff: 0.9}\nrobots:\n  - {description: robot}\nbodies:\n" + bodies,
                           "hall", ".", options);
  }
  double gap(const VectorXd& positions) const {
    double least = 1e9;
    for (std::size_t i = 0; i < part_count_; ++i) {
      Rectangle part = kBaseParts[i];
      part.centre = positions.head<2>() + Rotation2Dd(positions[2]) * part.centre;
      part.angle += positions[2];
      for (const Rectangle& obstacle : obstacles_) least = std::min(least, gapOf(part, obstacle));
    }
    return least;
  }
  static VectorXd towards(const Eigen::Vector3d& target, const VectorXd& positions, double fastest) {
    Eigen::Vector3d wanted = 1.5 * (target - positions);
    wanted[2] = 1.5 * std::remainder(target[2] - positions[2], 2.0 * kPi);
    const double speed = wanted.head<2>().norm();
    if (speed > fastest) wanted.head<2>() *= fastest / speed;
    wanted[2] = std::clamp(wanted[2], -0.8, 0.8);
    return wanted;
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  Scene scene_;
  std::size_t part_count_ = 1;
  std::vector<Rectangle> obstacles_;
  std::mt19937 engine_;
};

/// Two walls 0.56 m apart and one at their end; the opening is at x < -0.6.
class NarrowTask : public BaseTask {
 public:
  NarrowTask() {
    obstacles_ = {
        {{0.0, 0.33}, 0.0, {0.6, 0.05}}, {{0.0, -0.33}, 0.0, {0.6, 0.05}}, {{0.65, 0.0}, 0.0, {0.05, 0.38}}};
    load(boxText("left", "world", obstacles_[0]) + boxText("right", "world", obstacles_[1]) +
             boxText("end", "world", obstacles_[2]),
         false);
  }
  VectorXd begin(std::uint64_t number) override {
    engine_.seed(3000 + static_cast<unsigned>(number));
    for (double& phase : phases_) phase = uniform(0.0, 2.0 * kPi);
    sway_ = uniform(0.05, 0.2);
    for (;;) {
      const VectorXd start = Eigen::Vector3d(uniform(0.15, 0.27), uniform(-0.05, 0.05), uniform(-0.12, 0.12));
      if (gap(start) > 0.025) return start;
    }
  }
  VectorXd command(double time, const VectorXd& positions) override {
    VectorXd wanted = towards({-1.5, 0.0, 0.0}, positions, 0.6);
    wanted[1] += sway_ * std::sin(2.3 * time + phases_[0]);
    wanted[2] += 2.0 * sway_ * std::sin(1.7 * time + phases_[1]);
    return wanted;
  }
  bool hasArrived(const VectorXd& positions) override { return positions[0] < -1.0; }
  double timeLimit() const override { return 20.0; }

 private:
  std::array<double, 2> phases_{};
  double sway_ = 0.0;
};

class CrossingTask : public BaseTask {
 public:
  static constexpr std::size_t kMoving = 3;

  CrossingTask() {
    std::string bodies;
    for (std::size_t i = 0; i < kMoving; ++i) {
      obstacles_.push_back({{0.0, 0.0}, 0.0, {0.15, 0.2}});
      bodies += boxText("cart_" + std::to_string(i), "cart_" + std::to_string(i), {{0, 0}, 0.0, {0.15, 0.2}});
    }
    obstacles_.push_back({{0.0, 1.6}, 0.1, {2.2, 0.05}});
    bodies += boxText("wall", "world", obstacles_.back());
    load(bodies, true);
  }
  VectorXd begin(std::uint64_t number) override {
    engine_.seed(4000 + static_cast<unsigned>(number));
    const Eigen::Vector3d start(-2.0, uniform(-0.8, 0.8), uniform(-kPi, kPi));
    target_ = {2.0, uniform(-0.8, 0.8), uniform(-kPi, kPi)};
    for (std::size_t i = 0; i < kMoving; ++i) {
      obstacles_[i] = {{uniform(-1.2, 1.2), uniform(-1.0, 1.0)}, uniform(-kPi, kPi), {0.15, 0.2}};
      const double angle = uniform(-kPi, kPi);
      speeds_[i] = uniform(0.1, 0.4) * Vector2d(std::cos(angle), std::sin(angle));
      turns_[i] = uniform(-0.3, 0.3);
    }
    return start;
  }
  VectorXd command(double /*time*/, const VectorXd& positions) override {
    // The driver steers at the goal and waits for carts to go.
    return towards(target_, positions, 0.6);
  }
  bool hasArrived(const VectorXd& positions) override { return (positions - target_).head<2>().norm() < 0.1; }
  double timeLimit() const override { return 20.0; }

  // Carts go to and fro, and turn back 0.1 m before the base: a contact is the base's.
  void moveObstacles(double step, const VectorXd& positions) override {
    for (std::size_t i = 0; i < kMoving; ++i) {
      const Rectangle before = obstacles_[i];
      const double nearest = gap(positions);
      obstacles_[i].centre += step * speeds_[i];
      obstacles_[i].angle += step * turns_[i];
      if (gap(positions) < std::min(nearest, 0.1)) {
        obstacles_[i] = before;
        speeds_[i] = -speeds_[i];
        turns_[i] = -turns_[i];
      }
      if (obstacles_[i].centre.cwiseAbs().maxCoeff() > 1.2)
        speeds_[i] = -obstacles_[i].centre.normalized() * speeds_[i].norm();
    }
  }
  void placeObstacles(SceneState& state) const override {
    for (std::size_t i = 0; i < kMoving; ++i) {
      const std::size_t body = *scene_.findBody("cart_" + std::to_string(i));
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() << obstacles_[i].centre, 0.0;
      pose.linear() = Eigen::AngleAxisd(obstacles_[i].angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      state.world_from_body[body] = pose * scene_.bodies[body].frame_from_body;
    }
  }

 private:
  Eigen::Vector3d target_ = Eigen::Vector3d::Zero();
  std::array<Vector2d, kMoving> speeds_{};
  std::array<double, kMoving> turns_{};
};

}  // namespace

std::unique_ptr<GuardTask> makeNarrowTask() {
  return std::make_unique<NarrowTask>();
}
std::unique_ptr<GuardTask> makeCrossingTask() {
  return std::make_unique<CrossingTask>();
}

}  // namespace concave_distance::benchmark

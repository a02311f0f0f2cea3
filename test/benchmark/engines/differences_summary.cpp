#include "benchmark/engines/differences_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "concave_distance/contact/normal_force.h"
#include "support/hunt_crossley_rebound.h"

namespace concave_distance::benchmark {
namespace {

constexpr std::size_t kBounces = 4;
constexpr std::size_t kContacts = 4;

double lowestPoint(const ComparedScene& scene, const EngineSample& sample,
                   Eigen::Vector3d* in_body = nullptr) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& vertex : scene.surface().vertices()) {
    const double height =
        sample.centre.z() + sample.world_from_body.row(2).dot(vertex - scene.mass.centre_in_body);
    if (height >= lowest) continue;
    lowest = height;
    if (in_body != nullptr) *in_body = vertex;
  }
  return lowest;
}

/// Of the centre at the tops of the flights after each bounce.
std::vector<double> apexHeights(const Trajectory& trajectory, double gravity) {
  std::vector<double> heights;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const EngineSample& before = trajectory[i - 1];
    if (before.velocity.z() > 0.0 && trajectory[i].velocity.z() <= 0.0) {
      heights.push_back(before.centre.z() + 0.5 * before.velocity.z() * before.velocity.z() / gravity);
    }
  }
  return heights;
}

/// Time from where the centre first falls below `height` until it is above it again; NaN where that is too
/// short for the samples.
double timeBelow(const Trajectory& trajectory, double height) {
  const auto crossing = [&](std::size_t i) {
    const double share =
        (height - trajectory[i - 1].centre.z()) / (trajectory[i].centre.z() - trajectory[i - 1].centre.z());
    return trajectory[i - 1].time + share * (trajectory[i].time - trajectory[i - 1].time);
  };
  double begin = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const bool was_below = trajectory[i - 1].centre.z() < height;
    const bool is_below = trajectory[i].centre.z() < height;
    if (!was_below && is_below) begin = crossing(i);
    if (!was_below || is_below) continue;
    const double span = crossing(i) - begin;
    return span > 2.0 / kRate ? span : kNotComputed;
  }
  return kNotComputed;
}

struct Bounce {
  double speed = 0.0;    ///< after it, m/s
  double contact = 0.0;  ///< seconds
};

/// The sphere's law with the weight, which the closed form leaves out: Runge and Kutta's fourth order.
Bounce bounceUnderItsWeight(const ComparedScene& scene, double speed) {
  constexpr double kStep = 1e-6;
  const double gravity = -scene.settings().gravity.z();
  const auto upwards = [&](double depth, double sinking) {
    return huntCrossleyForce(depth, sinking, scene.material.contact_modulus, scene.radius,
                             scene.material.dissipation) /
               scene.mass.mass -
           gravity;
  };
  double depth = 0.0;
  double sinking = speed;
  double time = 0.0;
  do {
    const double a1 = -upwards(depth, sinking);
    const double v2 = sinking + 0.5 * kStep * a1;
    const double a2 = -upwards(depth + 0.5 * kStep * sinking, v2);
    const double v3 = sinking + 0.5 * kStep * a2;
    const double a3 = -upwards(depth + 0.5 * kStep * v2, v3);
    const double v4 = sinking + kStep * a3;
    const double a4 = -upwards(depth + kStep * v3, v4);
    depth += kStep / 6.0 * (sinking + 2.0 * v2 + 2.0 * v3 + v4);
    sinking += kStep / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    time += kStep;
  } while (depth > 0.0);
  return {-sinking, time};
}

/// How far the face under the body leans forwards, rad.
double tiltOf(const EngineSample& sample, const Eigen::Vector3d& along) {
  return std::asin(sample.world_from_body.col(2).dot(along));
}

struct Impact {
  double begin = 0.0;
  double lever = 0.0;  ///< x of the contact from the centre of mass, m
  EngineSample after;
};

/// By what pushes the body up between two samples, which also shows impacts shorter than that.
std::vector<Impact> impactsOf(const ComparedScene& scene, const Trajectory& trajectory) {
  constexpr double kLeastPush = 20.0;  // m/s^2
  const double gravity = -scene.settings().gravity.z();
  std::vector<Impact> impacts;
  bool was_pushed = false;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const EngineSample& before = trajectory[i - 1];
    const EngineSample& sample = trajectory[i];
    const double push = (sample.velocity.z() - before.velocity.z()) / (sample.time - before.time) + gravity;
    const bool is_pushed = push > kLeastPush;
    if (is_pushed && !was_pushed) {
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      lowestPoint(scene, before, &place);
      impacts.push_back(
          {before.time, (before.world_from_body * (place - scene.mass.centre_in_body)).x(), {}});
    }
    if (is_pushed) impacts.back().after = sample;
    was_pushed = is_pushed;
  }
  return impacts;
}

}  // namespace

void printBall(const ComparedScene& scene, const std::vector<Run>& runs) {
  const double gravity = -scene.settings().gravity.z();
  const double touch = runs[0].trajectory[0].centre.z() - lowestPoint(scene, runs[0].trajectory[0]);
  const double start = runs[0].trajectory[0].centre.z() - touch;
  std::printf(
      "  dissipation %.3g s/m, E* %.4g Pa, mass %.5g kg, first impact at %.4f m/s, coefficient for ode "
      "%.5f\n",
      scene.material.dissipation, scene.material.contact_modulus, scene.mass.mass,
      std::sqrt(2.0 * gravity * start), scene.restitution);
  std::printf("  rebound heights of the ball's lowest point, mm          first contact, ms\n");
  const auto line = [](const std::string& label, const std::vector<double>& heights, double contact) {
    std::printf("  %-32s", label.c_str());
    for (std::size_t i = 0; i < kBounces; ++i) {
      std::printf(" %9.4f", i < heights.size() ? 1e3 * heights[i] : kNotComputed);
    }
    std::printf(std::isnan(contact) ? "          -\n" : "  %9.3f\n", 1e3 * contact);
  };
  std::vector<double> closed;
  std::vector<double> constant;
  double height = start;
  for (std::size_t i = 0; i < kBounces; ++i) {
    const double speed =
        test::huntCrossleyRebound(std::sqrt(2.0 * gravity * height), scene.material.dissipation);
    height = 0.5 * speed * speed / gravity;
    closed.push_back(height);
    constant.push_back((i == 0 ? start : constant.back()) * scene.restitution * scene.restitution);
  }
  // Hertz without damping (Johnson 1985, sec. 11.4): 2.9432 of the depth over the speed.
  const double speed = std::sqrt(2.0 * gravity * start);
  const double stiffness = 4.0 / 3.0 * scene.material.contact_modulus * std::sqrt(scene.radius);
  const double depth = std::pow(1.25 * scene.mass.mass * speed * speed / stiffness, 0.4);
  line("closed form, Hunt and Crossley", closed, 2.9432 * depth / speed);
  std::vector<double> weighed;
  double contact = 0.0;
  for (std::size_t i = 0; i < kBounces; ++i) {
    const double from = i == 0 ? start : weighed.back();
    const Bounce bounce = bounceUnderItsWeight(scene, std::sqrt(2.0 * gravity * from));
    if (i == 0) contact = bounce.contact;
    weighed.push_back(0.5 * bounce.speed * bounce.speed / gravity);
  }
  line("the same law with the weight", weighed, contact);
  line("closed form, constant coefficient", constant, 0.0);
  for (const Run& run : runs) {
    std::vector<double> heights = apexHeights(run.trajectory, gravity);
    for (double& apex : heights) apex -= touch;
    line(run.engine, heights, timeBelow(run.trajectory, touch));
  }
}

void printSlope(const ComparedScene& scene, const std::vector<Run>& runs) {
  const Eigen::Vector3d& gravity = scene.settings().gravity;
  const Eigen::Vector3d down(gravity.x(), gravity.y(), 0.0);
  const double pull = down.norm();
  const double duration = runs[0].trajectory.back().time;
  const double tangent = pull / -gravity.z();
  const double acceleration = std::max(0.0, pull + scene.friction * gravity.z());
  std::printf("  slope %.4f rad (tan %.4f), friction %.3g\n", std::atan(tangent), tangent, scene.friction);
  std::printf("  %-32s %14s %14s %14s %14s\n", "", "way, m", "speed, m/s", "settled, mm", "tilt, mrad");
  std::printf("  %-32s %14.6g %14.6g\n", "closed form, Coulomb", 0.5 * acceleration * duration * duration,
              acceleration * duration);
  // A bed of springs under a load N, and a friction of mu N (or N tan) below the centre: its moment leans on
  // it.
  const double area = scene.box_size.x() * scene.box_size.y();
  const double load = -scene.mass.mass * gravity.z();
  const double side = scene.box_size.x();
  std::printf("  %-32s %14s %14s %14.4f %14.4f\n", "closed form, bed of springs", "", "",
              1e3 * load / (scene.foundation_stiffness * area),
              1e3 * load * std::min(tangent, scene.friction) * 0.5 * scene.box_size.z() /
                  (scene.foundation_stiffness * area * side * side / 12.0));
  if (acceleration == 0.0) {
    const SimbodyOptions options;
    const double bristles = tangent / scene.scene.pairs[0].settings.effects.friction.bristle_stiffness;
    const double creep = options.transition_speed * tangent / scene.friction;
    std::printf("  %-32s %14.6g %14.6g\n", "closed form, bristles", bristles, 0.0);
    // f = mu v / v_t (1 + ...) with equal coefficients: mu min(v / v_t, 1).
    std::printf("  %-32s %14.6g %14.6g\n", "closed form, Simbody's creep", creep * duration, creep);
    // mu v / sqrt(v^2 + v_r^2) = tan
    const double own_creep = scene.scene.pairs[0].settings.effects.friction.regularisation_speed * tangent /
                             std::sqrt(scene.friction * scene.friction - tangent * tangent);
    std::printf("  %-32s %14.6g %14.6g\n", "closed form, our creep", own_creep * duration, own_creep);
  }
  const Eigen::Vector3d along = down / pull;
  for (const Run& run : runs) {
    const EngineSample& end = run.trajectory.back();
    const Eigen::Vector3d displacement = end.centre - run.trajectory.front().centre;
    std::printf("  %-32s %14.6g %14.6g %14.4f %14.4f\n", run.engine.c_str(), displacement.dot(along),
                end.velocity.dot(along), -1e3 * displacement.z(), 1e3 * tiltOf(end, along));
  }
}

void printFeet(const ComparedScene& scene, const std::vector<Run>& runs) {
  std::printf("  mass %.5g kg, inertia about y %.5g kg m^2, foundation %.3g Pa/m, coefficient for ode %.5f\n",
              scene.mass.mass, scene.mass.inertia(1, 1), scene.foundation_stiffness, scene.restitution);
  std::printf(
      "  contacts: from when, ms (a sample each ms); on which foot; after it the centre's upward speed, m/s, "
      "and "
      "the turning, rad/s\n");
  const std::vector<Impact> own = impactsOf(scene, runs[0].trajectory);
  if (!own.empty()) {
    const EngineSample& start = runs[0].trajectory.front();
    const double gravity = -scene.settings().gravity.z();
    const double speed = std::sqrt(2.0 * gravity * lowestPoint(scene, start));
    const double lever = own.front().lever;
    const double mass = 1.0 / (1.0 / scene.mass.mass + lever * lever / scene.mass.inertia(1, 1));
    const double impulse = mass * (speed + test::huntCrossleyRebound(speed, scene.material.dissipation));
    std::printf("  %-32s %5.0f %s %8.4f %8.4f\n", "closed form, one rigid impact", 1e3 * speed / gravity,
                lever > 0.0 ? "right" : "left ", impulse / scene.mass.mass - speed,
                -impulse * lever / scene.mass.inertia(1, 1));
  }
  for (const Run& run : runs) {
    std::printf("  %-32s", run.engine.c_str());
    const std::vector<Impact> impacts = impactsOf(scene, run.trajectory);
    for (std::size_t i = 0; i < std::min(kContacts, impacts.size()); ++i) {
      const Impact& impact = impacts[i];
      std::printf(" %5.0f %s %8.4f %8.4f%s", 1e3 * impact.begin, impact.lever > 0.0 ? "right" : "left ",
                  impact.after.velocity.z(), impact.after.angular_velocity.y(),
                  i + 1 < std::min(kContacts, impacts.size()) ? " |" : "");
    }
    std::printf("\n");
  }
}

}  // namespace concave_distance::benchmark

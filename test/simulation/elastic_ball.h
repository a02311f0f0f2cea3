#pragma once

#include <cmath>
#include <vector>

#include "base/constants.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "simulation/scene_builder.h"

namespace concave_distance::test {

/// An exact ball without any loss but friction's, on a body of the same material. All lengths go with the
/// radius, and Young's modulus too, so that the ball sinks in by the same share of it at every scale.
struct ElasticBall {
  double radius = 1.0;  ///< metres
  FrictionModel friction = FrictionModel::Bristle;
  /// Of the defaults' bristles, which suit a radius of about 0.1 m: this many times as stiff, and damped so
  /// that they decay in the same number of the scene's own times.
  double bristles = 1.0;

  double modulus() const { return inContact(material(), material()).contact_modulus; }
  Material material() const {
    Material material;
    material.youngs_modulus = 1e8 * radius;
    material.poissons_ratio = 0.3;
    material.dissipation = 0.0;
    material.static_friction = material.dynamic_friction = 0.6;
    return material;
  }
  double mass() const { return 1000.0 * 4.0 / 3.0 * kPi * radius * radius * radius; }
  /// Hertz's, of the load on a body whose surface and the ball's make this radius.
  double depthUnder(double load, double relative_radius) const {
    return std::pow(0.75 * load / (modulus() * std::sqrt(relative_radius)), 2.0 / 3.0);
  }

  EffectSettings effects() const {
    EffectSettings effects;
    effects.normal_force.emplace();
    effects.normal_force->model = NormalForceModel::Hertz;
    effects.friction.model = friction;
    effects.friction.bristle_stiffness *= bristles;
    effects.friction.bristle_damping *= std::sqrt(bristles);
    return effects;
  }
  /// Returns its settings, which are valid until the next body is added.
  SimulatedBodySettings& addTo(SceneBuilder& builder, const std::string& name,
                               const Eigen::Vector3d& centre) const {
    RoundShape shape;
    shape.radius = radius;
    shape.chord_error = 0.01 * radius;
    builder.addRoundBody(name, shape).material = material();
    SimulatedBodySettings& ball = builder.setFree(name, mass());
    ball.pose = at(centre.x(), centre.y(), centre.z());
    return ball;
  }

  /// On the body "ground"; the ball is body 1.
  SceneBuilder on(SurfaceMesh ground, const Eigen::Vector3d& centre) const {
    SceneBuilder builder;
    builder.addBody("ground", std::move(ground)).material = material();
    addTo(builder, "ball", centre);
    builder.addPair().effects = effects();
    builder.settings.tracking = SimulationTracking::SingleMinimum;
    return builder;
  }

  /// Over a plane at z = 0, `height` below its lowest point.
  SceneBuilder overPlane(double height) const {
    SceneBuilder builder = on(makeBox({20.0 * radius, 20.0 * radius, 4.0 * radius}), {0, 0, radius + height});
    builder.setFixed("ground", at(0.0, 0.0, -2.0 * radius));
    return builder;
  }

  /// Rolls along x on a plane that is long enough for that time.
  SceneBuilder rollingOnPlane(double speed, double duration) const {
    const double length = 2.0 * (speed * duration + 4.0 * radius);
    SceneBuilder builder =
        on(makeBox({length, 8.0 * radius, 4.0 * radius}), {0, 0, radius - depthUnder(9.81 * mass(), radius)});
    SimulatedBodySettings& ball = builder.settings.bodies.back();
    ball.velocity = {speed, 0.0, 0.0};
    ball.angular_velocity = {0.0, speed / radius, 0.0};
    builder.setFixed("ground", at(0.0, 0.0, -2.0 * radius));
    return builder;
  }

  /// At rest in a bowl of five times its radius, `angle` from the bowl's lowest point.
  SceneBuilder inBowl(double angle) const;

  /// Two free balls without gravity. Their centres are `apart` along z and `beside` each other along x; each
  /// moves towards the other with `speed`, and they turn so that where they touch nothing slides.
  SceneBuilder meeting(double apart, double beside, double speed) const {
    SceneBuilder builder;
    builder.settings.gravity.setZero();
    builder.settings.tracking = SimulationTracking::SingleMinimum;
    const double across = beside / (2.0 * radius);  // sine of the angle between normal and path
    for (const double side : {-1.0, 1.0}) {
      SimulatedBodySettings& ball =
          addTo(builder, side < 0.0 ? "first" : "second", {0.5 * side * beside, 0.0, 0.5 * side * apart});
      ball.velocity = {0.0, 0.0, -side * speed};
      ball.angular_velocity = {0.0, speed * across / radius, 0.0};
    }
    builder.addPair().effects = effects();
    return builder;
  }

  /// Rolls along x, as in rollingOnPlane(), on a plate as heavy as it is large, which lies on a floor and is
  /// body 1; the ball is body 2.
  SceneBuilder rollingOnFreePlate(double speed, double duration) const {
    const double length = 2.0 * (speed * duration + 4.0 * radius);
    const Eigen::Vector3d size(length, 8.0 * radius, 4.0 * radius);
    const double sunk = 1e-4 * radius;
    SceneBuilder builder;
    builder.settings.tracking = SimulationTracking::SingleMinimum;
    builder.addBody("ground", makeBox({1.1 * size.x(), 1.1 * size.y(), size.z()})).material = material();
    builder.addBody("plate", makeBox(size)).material = material();
    builder.setFixed("ground", at(0.0, 0.0, -6.0 * radius + sunk));
    builder.setFree("plate", 1000.0 * size.prod()).pose = at(0.0, 0.0, -2.0 * radius);
    SimulatedBodySettings& ball =
        addTo(builder, "ball", {0.0, 0.0, radius - depthUnder(9.81 * mass(), radius)});
    ball.velocity = {speed, 0.0, 0.0};
    ball.angular_velocity = {0.0, speed / radius, 0.0};
    EffectSettings& bed = builder.addPair().effects;
    bed = effects();
    bed.normal_force->model = NormalForceModel::ElasticFoundation;
    bed.normal_force->foundation_stiffness = 1000.0 * 9.81 * size.z() / sunk;
    ScenePair pair;
    pair.name = "plate/ball";
    pair.body_a = 1;
    pair.body_b = 2;
    pair.settings.effects = effects();
    builder.scene.pairs.push_back(pair);
    return builder;
  }
};

/// A spherical shell that is open above: the centre is the origin, the rim 1.1 rad from the lowest point.
inline SurfaceMesh makeBowl(double inner_radius, double outer_radius) {
  constexpr std::size_t kRings = 40;
  constexpr std::size_t kAround = 120;
  constexpr double kRim = 1.1;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<NodeIndex, 3>> triangles;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c, bool turned) {
    triangles.push_back({NodeIndex(a), NodeIndex(turned ? c : b), NodeIndex(turned ? b : c)});
  };
  // Numbers the vertices of the sheet that begins at `first` with its lowest point.
  const auto index = [&](std::size_t first, std::size_t ring, std::size_t k) {
    return ring == 0 ? first : first + 1 + (ring - 1) * kAround + k % kAround;
  };
  for (const double radius : {inner_radius, outer_radius}) {
    const std::size_t first = vertices.size();
    const bool turned = first > 0;
    vertices.emplace_back(0.0, 0.0, -radius);
    for (std::size_t ring = 1; ring <= kRings; ++ring) {
      const double angle = kRim * static_cast<double>(ring) / kRings;
      for (std::size_t k = 0; k < kAround; ++k) {
        const double turn = 2.0 * kPi * static_cast<double>(k) / kAround;
        vertices.push_back(radius * Eigen::Vector3d(std::sin(angle) * std::cos(turn),
                                                    std::sin(angle) * std::sin(turn), -std::cos(angle)));
      }
      for (std::size_t k = 0; k < kAround; ++k) {
        add(index(first, ring - 1, k), index(first, ring, k), index(first, ring, k + 1), turned);
        if (ring > 1)
          add(index(first, ring - 1, k), index(first, ring, k + 1), index(first, ring - 1, k + 1), turned);
      }
    }
  }
  const std::size_t outer = vertices.size() / 2;
  for (std::size_t k = 0; k < kAround; ++k) {
    add(index(0, kRings, k), index(outer, kRings, k), index(outer, kRings, k + 1), false);
    add(index(0, kRings, k), index(outer, kRings, k + 1), index(0, kRings, k + 1), false);
  }
  return SurfaceMesh(vertices, triangles, "bowl");
}

inline SceneBuilder ElasticBall::inBowl(double angle) const {
  const double bowl = 5.0 * radius;
  const double relative_radius = 1.0 / (1.0 / radius - 1.0 / bowl);
  const double arm = bowl - radius + depthUnder(9.81 * mass() * std::cos(angle), relative_radius);
  SceneBuilder builder =
      on(makeBowl(bowl, 6.0 * radius), {arm * std::sin(angle), 0.0, -arm * std::cos(angle)});
  builder.setFixed("ground", at(0.0, 0.0, 0.0));
  return builder;
}

}  // namespace concave_distance::test

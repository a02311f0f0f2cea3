#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/random_engine.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/concave_shapes.h"
#include "support/plain_shapes.h"
#include "support/triangle_pairs.h"

namespace concave_distance::test {

// Random concave solids about a metre across: closed, outward oriented, not crossing themselves.

/// The triangles, each with corners of its own.
inline SurfaceMesh surfaceOf(const std::vector<TrianglePoints>& triangles) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> nodes;
  for (const TrianglePoints& t : triangles) {
    for (const Eigen::Vector3d& corner : t) vertices.push_back(corner);
    const auto first = static_cast<std::uint32_t>(vertices.size() - 3);
    nodes.push_back({NodeIndex{first}, NodeIndex{first + 1}, NodeIndex{first + 2}});
  }
  return SurfaceMesh(std::move(vertices), std::move(nodes), "soup");
}

/// A prism over a star-shaped outline of random radii: concave, at times with very thin spikes.
inline SurfaceMesh spikyPrism(RandomEngine& engine) {
  const std::uint32_t corners = 3 + uniformIndex(engine, 9);
  const double least = powerOfTen(engine, -3.0, 0.0);
  Outline outline;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.8 * uniformUnit(engine)) / corners;
    const double radius = uniformIn(engine, least, 1.0);
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return makeExtrusion(outline, powerOfTen(engine, -3.0, 0.5));
}

/// A prism over a star with points of random length.
inline SurfaceMesh randomStar(RandomEngine& engine) {
  const std::uint32_t corners = 5 + uniformIndex(engine, 8);
  Outline outline;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.6 * uniformUnit(engine)) / corners;
    outline.emplace_back(Eigen::Vector2d(std::cos(angle), std::sin(angle)) * uniformIn(engine, 0.15, 0.6));
  }
  return makeExtrusion(outline, uniformIn(engine, 0.1, 0.8));
}

inline SurfaceMesh randomRing(RandomEngine& engine) {
  const double radius = uniformIn(engine, 0.25, 0.4);
  const double tube = uniformIn(engine, 0.05, 0.2);
  const double lobes = 2.0 + uniformIndex(engine, 4);
  const double depth = uniformIn(engine, 0.0, 0.6);
  const std::uint32_t around = 8 + uniformIndex(engine, 9);
  return makeRingOfTube(radius, around, 4 + uniformIndex(engine, 5), [&](double along, double over) {
    return tube * (1.0 - depth * std::abs(std::sin(lobes * along + over)));
  });
}

inline SurfaceMesh randomBumpySphere(RandomEngine& engine) {
  const double radius = uniformIn(engine, 0.25, 0.5);
  const SurfaceMesh sphere = makeSphere(radius, uniformIn(engine, 0.01, 0.05));
  return makeBumpy(sphere, uniformIn(engine, 0.1, 0.5));
}

/// A box with a cavity of the shape of another.
inline SurfaceMesh randomHollowBox(RandomEngine& engine) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.25) + 0.5 * uniformInCube(engine, 0.2);
  const Eigen::Vector3d inner = half * uniformIn(engine, 0.2, 0.9);
  return makeJoined(makeCuboid(-half, half), makeTurned(makeCuboid(-inner, inner)), Eigen::Vector3d::Zero());
}

inline SurfaceMesh randomSolid(RandomEngine& engine) {
  const std::uint32_t kind = uniformIndex(engine, 8);
  const int count = 2 + static_cast<int>(uniformIndex(engine, 4));
  // Drawn in this order on every compiler, unlike a function's arguments.
  const double share[3] = {uniformUnit(engine), uniformUnit(engine), uniformUnit(engine)};
  switch (kind) {
    case 0:
      return makeComb(count, 0.05 + 0.1 * share[0], 0.05 + 0.15 * share[1], 0.2 + 0.3 * share[2]);
    case 1:
      return makeStairs(count, 0.1 + 0.15 * share[0], 0.1 + 0.1 * share[1], 0.2 + 0.4 * share[2]);
    case 2:
      return makeHook(0.8, 0.2 + 0.3 * share[0], 0.1 + 0.2 * share[1]);
    case 3:
      return randomRing(engine);
    case 4:
      return randomBumpySphere(engine);
    case 5:
      return randomHollowBox(engine);
    case 6:
      return makeJoined(randomStar(engine), makeLShape(), Eigen::Vector3d(0.7, 0.7, 0.0));
    default:
      return randomStar(engine);
  }
}

/// A pose near enough that most pairs of randomSolid overlap.
inline Eigen::Isometry3d randomOverlappingPose(const SurfaceMesh& a, const SurfaceMesh& b,
                                               RandomEngine& engine) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = randomRotation(engine);
  const double reach = 0.15 * (a.diameter() + b.diameter());
  pose.translation() =
      a.boundingBox().center() - pose.linear() * b.boundingBox().center() + uniformInCube(engine, reach);
  return pose;
}

/// A ball with bumps, around the origin: many pairs of places of two of them may face each other.
/// @param sag metres, as for makeSphere()
/// @param waves radians of the bumps over a radius
inline SurfaceMesh makeBumpyBall(double radius, double sag, double waves) {
  const SurfaceMesh ball = makeSphere(radius, sag);
  std::vector<Eigen::Vector3d> vertices;
  for (std::uint32_t k = 0; k < ball.vertexCount(); ++k) {
    const Eigen::Vector3d& v = ball.vertex(NodeIndex{k});
    const Eigen::Vector3d w = waves / radius * v;
    vertices.emplace_back((1.0 + 0.12 * std::sin(w.x()) * std::cos(w.y()) * std::sin(w.z() + 1.0)) * v);
  }
  return SurfaceMesh(std::move(vertices), ball.triangles(), "bumpy ball");
}

}  // namespace concave_distance::test

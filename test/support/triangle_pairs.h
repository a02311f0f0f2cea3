#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "base/random_engine.h"
#include "distance/kernels/triangle_distance.h"
#include "support/plain_shapes.h"

/// Random triangle pairs that are hard for a distance kernel, by family.
namespace concave_distance::test {

using TrianglePair = std::pair<TrianglePoints, TrianglePoints>;

inline double powerOfTen(RandomEngine& engine, double low, double high) {
  return std::pow(10.0, uniformIn(engine, low, high));
}

inline Eigen::Matrix3d randomRotation(RandomEngine& engine) {
  const double z = uniformIn(engine, -1.0, 1.0);
  const double around = uniformIn(engine, 0.0, 2.0 * M_PI);
  const double r = std::sqrt(1.0 - z * z);
  return Eigen::AngleAxisd(uniformIn(engine, 0.0, 2.0 * M_PI),
                           Eigen::Vector3d(r * std::cos(around), r * std::sin(around), z))
      .toRotationMatrix();
}

inline TrianglePoints randomTriangle(RandomEngine& engine) {
  return {uniformInCube(engine, 1.0), uniformInCube(engine, 1.0), uniformInCube(engine, 1.0)};
}

inline TrianglePoints moved(const TrianglePoints& t, const Eigen::Matrix3d& r, const Eigen::Vector3d& v) {
  return {r * t[0] + v, r * t[1] + v, r * t[2] + v};
}

inline TrianglePoints scaled(const TrianglePoints& t, double factor) {
  return {factor * t[0], factor * t[1], factor * t[2]};
}

/// In the plane z = 0, one unit long, as flat as `height`: a needle, a cap, or neither.
inline TrianglePoints flatTriangle(RandomEngine& engine, double height) {
  const std::uint32_t kind = uniformIndex(engine, 3);
  const double x = kind == 0 ? uniformIn(engine, 0.0, height) : uniformIn(engine, 0.0, 1.0);
  TrianglePoints t = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(x, height, 0)};
  const std::uint32_t first = uniformIndex(engine, 3);  // every corner may come first
  return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

/// Both flat in the same plane up to a tilt, one above the other by `gap`.
inline TrianglePair nearlyCoplanar(RandomEngine& engine, double height_a, double height_b, double tilt,
                                   double gap) {
  const TrianglePoints a = flatTriangle(engine, height_a);
  const double turn = uniformIndex(engine, 2) == 0 ? powerOfTen(engine, -17, 0) : uniformIn(engine, 0.0, 6.3);
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(
           tilt, Eigen::Vector3d(uniformIn(engine, -1, 1), uniformIn(engine, -1, 1), 0).normalized()) *
       Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  const double spread = uniformIndex(engine, 2) == 0 ? 1.0 : height_a;
  const TrianglePoints b =
      moved(flatTriangle(engine, height_b), rotation,
            Eigen::Vector3d(uniformIn(engine, -1, 1), uniformIn(engine, -spread, spread), gap));
  const Eigen::Matrix3d together =
      uniformIndex(engine, 2) == 0 ? randomRotation(engine) : Eigen::Matrix3d::Identity();
  return {moved(a, together, Eigen::Vector3d::Zero()), moved(b, together, Eigen::Vector3d::Zero())};
}

inline TrianglePair generalPair(RandomEngine& engine) {
  const Eigen::Vector3d direction = randomRotation(engine).col(0);
  return {randomTriangle(engine), moved(scaled(randomTriangle(engine), powerOfTen(engine, -6, 0)),
                                        Eigen::Matrix3d::Identity(), powerOfTen(engine, -12, 3) * direction)};
}

inline TrianglePair needlePair(RandomEngine& engine) {
  TrianglePair pair = {flatTriangle(engine, powerOfTen(engine, -16, 0)),
                       flatTriangle(engine, powerOfTen(engine, -16, 0))};
  const Eigen::Vector3d shift = powerOfTen(engine, -16, 1) * randomRotation(engine).col(0);
  pair.first = moved(pair.first, randomRotation(engine), uniformInCube(engine, 0.5));
  pair.second = moved(pair.second, randomRotation(engine), shift);
  return pair;
}

inline TrianglePair parallelPair(RandomEngine& engine) {
  const double sign = uniformIndex(engine, 2) == 0 ? 1.0 : -1.0;
  const double tilt = uniformIndex(engine, 3) == 0 ? 0.0 : powerOfTen(engine, -17, -1);
  const double gap = uniformIndex(engine, 4) == 0 ? 0.0 : powerOfTen(engine, -17, 1);
  return nearlyCoplanar(engine, powerOfTen(engine, -16, 0), powerOfTen(engine, -16, 0), tilt, sign * gap);
}

/// Corners on a small lattice: every kind of coincidence, collinearity, contact and crossing, exactly.
inline TrianglePair latticePair(RandomEngine& engine) {
  const std::uint32_t side = 2 + uniformIndex(engine, 3);
  const auto corner = [&] {
    const double x = uniformIndex(engine, side);
    const double y = uniformIndex(engine, side);
    const double z = uniformIndex(engine, side);
    return Eigen::Vector3d(x, y, z);
  };
  TrianglePoints a = {corner(), corner(), corner()};
  TrianglePoints b = {corner(), corner(), corner()};
  return {a, b};
}

/// A lattice pair turned: the same coincidences up to rounding.
inline TrianglePair turnedLatticePair(RandomEngine& engine) {
  const auto [a, b] = latticePair(engine);
  const Eigen::Matrix3d rotation = randomRotation(engine);
  const Eigen::Vector3d shift = uniformInCube(engine, 1.0);
  return {moved(a, rotation, shift), moved(b, rotation, shift)};
}

/// A point of b placed on a, and b pulled away a little.
inline TrianglePair touchingPair(RandomEngine& engine) {
  TrianglePoints a = randomTriangle(engine);
  if (uniformIndex(engine, 2) == 0)
    a = moved(flatTriangle(engine, powerOfTen(engine, -16, 0)), randomRotation(engine),
              uniformInCube(engine, 1.0));
  TrianglePoints b = randomTriangle(engine);
  if (uniformIndex(engine, 2) == 0)
    b = moved(flatTriangle(engine, powerOfTen(engine, -16, 0)), randomRotation(engine),
              uniformInCube(engine, 1.0));
  const auto point_of = [&](const TrianglePoints& t) {
    double s = uniformUnit(engine);
    double r = uniformUnit(engine);
    if (s + r > 1.0) {
      s = 1.0 - s;
      r = 1.0 - r;
    }
    const std::uint32_t kind = uniformIndex(engine, 3);
    if (kind < 2) r = 0.0;
    if (kind < 1) s = 0.0;
    return Eigen::Vector3d(t[0] + s * (t[1] - t[0]) + r * (t[2] - t[0]));
  };
  const Eigen::Vector3d pull =
      uniformIndex(engine, 2) == 0
          ? Eigen::Vector3d(Eigen::Vector3d::Zero())
          : Eigen::Vector3d(powerOfTen(engine, -17, -1) * randomRotation(engine).col(0));
  return {a, moved(b, Eigen::Matrix3d::Identity(), point_of(a) - point_of(b) + pull)};
}

struct TrianglePairFamily {
  const char* name;
  TrianglePair (*draw)(RandomEngine&);
};

inline constexpr std::array<TrianglePairFamily, 7> kTrianglePairFamilies = {
    {{"general", generalPair},
     {"needles and caps", needlePair},
     {"nearly parallel", parallelPair},
     {"lattice", latticePair},
     {"turned lattice", turnedLatticePair},
     {"touching", touchingPair},
     {"far offset", [](RandomEngine& engine) {
        TrianglePair pair = touchingPair(engine);
        const Eigen::Vector3d far = powerOfTen(engine, 0, 6) * randomRotation(engine).col(0);
        return TrianglePair{moved(pair.first, Eigen::Matrix3d::Identity(), far),
                            moved(pair.second, Eigen::Matrix3d::Identity(), far)};
      }}}};

}  // namespace concave_distance::test

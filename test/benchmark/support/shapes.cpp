#include "benchmark/support/shapes.h"

#include <cmath>

#include "base/constants.h"
#include "base/random_engine.h"
#include "support/concave_shapes.h"

namespace concave_distance::benchmark {
namespace {

using Ring = std::vector<Eigen::Vector3d>;

// Joins rings of equal length into a surface; the winding is outward when the rings turn positively about
// the direction of travel.
struct RingSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  std::size_t ring_size = 0;

  void addRing(const Ring& ring) {
    ring_size = ring.size();
    vertices.insert(vertices.end(), ring.begin(), ring.end());
  }
  void joinRings(std::size_t first, std::size_t second) {
    for (std::size_t k = 0; k < ring_size; ++k) {
      const std::size_t next = (k + 1) % ring_size;
      const NodeIndex a{first * ring_size + k};
      const NodeIndex b{first * ring_size + next};
      const NodeIndex c{second * ring_size + next};
      const NodeIndex d{second * ring_size + k};
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  void cap(std::size_t ring, bool forwards) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < ring_size; ++k) {
      centre += vertices[ring * ring_size + k] / static_cast<double>(ring_size);
    }
    const NodeIndex middle{vertices.size()};
    vertices.push_back(centre);
    for (std::size_t k = 0; k < ring_size; ++k) {
      const NodeIndex a{ring * ring_size + k};
      const NodeIndex b{ring * ring_size + (k + 1) % ring_size};
      triangles.push_back(forwards ? TriangleNodes{a, b, middle} : TriangleNodes{b, a, middle});
    }
  }
};

}  // namespace

SurfaceMesh makeTube(double outer_radius, double inner_radius, double length, int segments) {
  // The profile is a rectangle; each of its corners is a ring around z.
  const double profile[4][2] = {{outer_radius, -0.5 * length},
                                {outer_radius, 0.5 * length},
                                {inner_radius, 0.5 * length},
                                {inner_radius, -0.5 * length}};
  RingSurface tube;
  for (const auto& corner : profile) {
    Ring ring;
    for (int k = 0; k < segments; ++k) {
      const double angle = 2.0 * kPi * k / segments;
      ring.emplace_back(corner[0] * std::cos(angle), corner[0] * std::sin(angle), corner[1]);
    }
    tube.addRing(ring);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    tube.joinRings(k, (k + 1) % 4);
  }
  return {std::move(tube.vertices), std::move(tube.triangles), "tube"};
}

SurfaceMesh makeHook(double ring_radius, double wire_radius, double open_share, int ring_segments,
                     int wire_segments) {
  RingSurface hook;
  for (int i = 0; i <= ring_segments; ++i) {
    const double angle = 2.0 * kPi * (1.0 - open_share) * i / ring_segments;
    const Eigen::Vector3d outwards(std::cos(angle), std::sin(angle), 0.0);
    Ring ring;
    for (int k = 0; k < wire_segments; ++k) {
      const double turn = -2.0 * kPi * k / wire_segments;
      ring.push_back((ring_radius + wire_radius * std::cos(turn)) * outwards +
                     wire_radius * std::sin(turn) * Eigen::Vector3d::UnitZ());
    }
    hook.addRing(ring);
    if (i > 0) {
      hook.joinRings(static_cast<std::size_t>(i - 1), static_cast<std::size_t>(i));
    }
  }
  hook.cap(0, false);
  hook.cap(static_cast<std::size_t>(ring_segments), true);
  return {std::move(hook.vertices), std::move(hook.triangles), "hook"};
}

SurfaceMesh makePyramidField(int rows, int columns, double pitch, unsigned seed) {
  RandomEngine engine(seed);
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  const auto add_box = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    for (std::uint32_t k = 0; k < 8; ++k) {
      vertices.emplace_back((k & 1U) != 0 ? high.x() : low.x(), (k & 2U) != 0 ? high.y() : low.y(),
                            (k & 4U) != 0 ? high.z() : low.z());
    }
    constexpr std::uint32_t kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                             {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                             {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& face : kFaces) {
      triangles.push_back({NodeIndex{base + face[0]}, NodeIndex{base + face[1]}, NodeIndex{base + face[2]}});
    }
  };
  const double half_x = 0.5 * columns * pitch;
  const double half_y = 0.5 * rows * pitch;
  add_box({-half_x, -half_y, -0.5 * pitch}, {half_x, half_y, 0.0});
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector3d foot((column + 0.5) * pitch - half_x, (row + 0.5) * pitch - half_y, 0.01 * pitch);
      const double half = 0.35 * pitch;
      const double height = pitch * (0.6 + 0.6 * uniformUnit(engine));
      const auto base = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(foot + Eigen::Vector3d(-half, -half, 0.0));
      vertices.push_back(foot + Eigen::Vector3d(half, -half, 0.0));
      vertices.push_back(foot + Eigen::Vector3d(half, half, 0.0));
      vertices.push_back(foot + Eigen::Vector3d(-half, half, 0.0));
      vertices.push_back(foot + Eigen::Vector3d(0.1 * pitch * (uniformUnit(engine) - 0.5),
                                                0.1 * pitch * (uniformUnit(engine) - 0.5), height));
      constexpr std::uint32_t kFaces[6][3] = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4},
                                              {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
      for (const auto& face : kFaces) {
        triangles.push_back(
            {NodeIndex{base + face[0]}, NodeIndex{base + face[1]}, NodeIndex{base + face[2]}});
      }
    }
  }
  return {std::move(vertices), std::move(triangles), "pyramid field"};
}

SurfaceMesh makeBumpyRing(std::size_t triangles) {
  const auto around = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles))));
  return test::makeRingOfTube(0.5, around, around / 2, [](double along, double over) {
    return 0.2 + 0.02 * std::sin(9.0 * along) * std::cos(5.0 * over);
  });
}

SurfaceMesh moved(const SurfaceMesh& surface, const Eigen::Isometry3d& motion) {
  std::vector<Eigen::Vector3d> vertices = surface.vertices();
  for (Eigen::Vector3d& vertex : vertices) {
    vertex = motion * vertex;
  }
  return {std::move(vertices), surface.triangles(), "moved surface"};
}

Eigen::Isometry3d ringPassingBy(double t) {
  const double angle = 0.3 + 0.15 * t;
  Eigen::Isometry3d pose(Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 1.0, 0.0).normalized()));
  pose.translation() = 1.6 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.06);
  return pose;
}

}  // namespace concave_distance::benchmark

#include "concave_distance/mesh/surface/primitives.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

/// A finer mesh than this is surely a chord error given in the wrong unit.
constexpr double kMaxTriangles = 4e6;

/// A capsule's corners are a radius and half a length from its centre.
constexpr double kLongest = 0.5 * kLargestCoordinate;

void requirePositive(double value, const char* name, const std::string& where) {
  if (!(value > 0.0) || !(value <= kLongest)) {
    TextStream seen;
    seen << name << " is " << value;
    throw Error(where, seen.str(), "give a positive length of at most 5e17 m");
  }
}

[[noreturn]] void throwTooFine(double radius, double chord_error, const std::string& where) {
  TextStream seen;
  seen << "a chord error of " << chord_error << " m on a radius of " << radius << " m needs more than "
       << kMaxTriangles << " triangles";
  throw Error(where, seen.str(), "give a larger chord error");
}

/// A regular polygon around the z axis; `count` is 1 (a point on the axis) or a multiple of 4.
struct Ring {
  double z;
  double radius;
  std::uint32_t count;
};

/// Corner `k` of the unit polygon. Built from one quadrant by exact quarter turns, so that the corners on
/// the x and y axes are exact and the mesh has the symmetry of the solid.
Eigen::Vector2d unitCorner(std::uint32_t k, std::uint32_t count) {
  if (count == 1) {
    return Eigen::Vector2d::Zero();
  }
  const std::uint32_t quarter = count / 4;
  const double angle = 2.0 * kPi * (k % quarter) / count;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  switch (k / quarter) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

/// The closed surface through `rings`, lowest pole first, highest pole last; outward. Neighbouring rings are
/// joined by a strip that always advances on the ring whose next corner comes first.
SurfaceMesh joinRings(const std::vector<Ring>& rings, const std::string& where) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  std::vector<std::uint32_t> first_corner;
  for (const Ring& ring : rings) {
    first_corner.push_back(static_cast<std::uint32_t>(vertices.size()));
    for (std::uint32_t k = 0; k < ring.count; ++k) {
      const Eigen::Vector2d corner = ring.radius * unitCorner(k, ring.count);
      vertices.emplace_back(corner.x(), corner.y(), ring.z);
    }
  }
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    const std::uint64_t lower_count = rings[r].count;
    const std::uint64_t upper_count = rings[r + 1].count;
    const auto lower = [&](std::uint64_t k) {
      return NodeIndex{first_corner[r] + (k == lower_count ? 0 : k)};
    };
    const auto upper = [&](std::uint64_t k) {
      return NodeIndex{first_corner[r + 1] + (k == upper_count ? 0 : k)};
    };
    std::uint64_t i = lower_count == 1 ? 1 : 0;  // a pole has no edges of its own to advance along
    std::uint64_t j = upper_count == 1 ? 1 : 0;
    while (i < lower_count || j < upper_count) {
      // Compares the middles of the two candidate edges as fractions of a turn, in whole numbers.
      const bool advance_lower =
          j == upper_count || (i < lower_count && (2 * i + 1) * upper_count <= (2 * j + 1) * lower_count);
      if (advance_lower) {
        triangles.push_back({lower(i), lower(i + 1), upper(j)});
        ++i;
      } else {
        triangles.push_back({lower(i), upper(j + 1), upper(j)});
        ++j;
      }
    }
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), where);
}

/// Rings of the lower half of a sphere, pole to equator: 4 i corners at polar angle i 90 / n degrees, the
/// pattern of an octahedron with near equal angular steps, so that no triangle is a sliver.
std::vector<Ring> lowerHemisphere(double radius, std::uint32_t steps) {
  std::vector<Ring> rings{{-radius, 0.0, 1}};
  for (std::uint32_t i = 1; i < steps; ++i) {
    const double polar = 0.5 * kPi * i / steps;
    rings.push_back({-radius * std::cos(polar), radius * std::sin(polar), 4 * i});
  }
  rings.push_back({0.0, radius, 4 * steps});
  return rings;
}

/// The lower rings moved by -offset, then their mirror image: one equator when offset is 0.
std::vector<Ring> mirrorUp(std::vector<Ring> rings, double offset) {
  const std::size_t lower_count = rings.size();
  for (Ring& ring : rings) {
    ring.z -= offset;
  }
  for (std::size_t i = offset == 0.0 ? lower_count - 1 : lower_count; i-- > 0;) {
    rings.push_back({-rings[i].z, rings[i].radius, rings[i].count});
  }
  return rings;
}

/// Largest distance from a point of the unit sphere to the mesh: at most 1 minus the least distance of a
/// triangle's plane from the centre, because every ray from the centre meets the mesh between the two.
double unitSphereError(std::uint32_t steps) {
  const SurfaceMesh mesh = joinRings(mirrorUp(lowerHemisphere(1.0, steps), 0.0), "unit sphere");
  double least = 1.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const Eigen::Vector3d& a = mesh.corner(triangle, 0);
    const Eigen::Vector3d normal = (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a);
    least = std::min(least, normal.dot(a) / normal.norm());
  }
  return 1.0 - least;
}

std::uint32_t hemisphereSteps(double radius, double chord_error, const std::string& where) {
  const double relative_error = chord_error / radius;
  // The error falls with the square of the steps, so two or three corrections find the least number.
  double wanted = 2.0;
  for (;;) {
    if (8.0 * wanted * wanted > kMaxTriangles) {
      throwTooFine(radius, chord_error, where);
    }
    const auto steps = static_cast<std::uint32_t>(wanted);
    const double error = unitSphereError(steps);
    if (error <= relative_error) {
      return steps;
    }
    wanted = std::max(wanted + 1.0, std::floor(wanted * std::sqrt(error / relative_error)));
  }
}

/// Corners of the polygon inscribed in a circle that stays within `chord_error` of it.
std::uint32_t circleCorners(double radius, double chord_error, const std::string& where) {
  const double half_angle = std::acos(std::max(0.0, 1.0 - chord_error / radius));
  const double corners = kPi / half_angle;
  if (!(8.0 * corners < kMaxTriangles)) {
    throwTooFine(radius, chord_error, where);
  }
  auto quarter = std::max(2U, static_cast<std::uint32_t>(std::ceil(corners / 4.0)));
  while (radius * (1.0 - std::cos(0.25 * kPi / quarter)) > chord_error) {
    ++quarter;  // the arc cosine may have been rounded the wrong way
  }
  return 4 * quarter;
}

/// Rings of a disc that faces down, its centre first, the circle last. Their corners are halved from ring to
/// ring inwards, a ring's width being one of its edges: a plain fan would be all slivers.
std::vector<Ring> lowerCap(double radius, double chord_error, const std::string& where) {
  std::vector<Ring> cap{{0.0, radius, circleCorners(radius, chord_error, where)}};
  while (cap.back().count > 8) {
    const Ring& outer = cap.back();
    cap.push_back({0.0, outer.radius * (1.0 - 2.0 * kPi / outer.count), 4 * ((outer.count + 7) / 8)});
  }
  cap.push_back({0.0, 0.0, 1});
  std::reverse(cap.begin(), cap.end());
  return cap;
}

}  // namespace

SurfaceMesh makeBox(const Eigen::Vector3d& size, const std::string& where) {
  requirePositive(size.x(), "the size along x", where);
  requirePositive(size.y(), "the size along y", where);
  requirePositive(size.z(), "the size along z", where);
  std::vector<Eigen::Vector3d> vertices;
  for (unsigned i = 0; i < 8; ++i) {  // bit 0: +x, bit 1: +y, bit 2: +z
    vertices.emplace_back(0.5 * size.x() * ((i & 1U) != 0U ? 1.0 : -1.0),
                          0.5 * size.y() * ((i & 2U) != 0U ? 1.0 : -1.0),
                          0.5 * size.z() * ((i & 4U) != 0U ? 1.0 : -1.0));
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  std::vector<TriangleNodes> triangles;
  for (const auto& face : kFaces) {
    triangles.push_back({NodeIndex{face[0]}, NodeIndex{face[1]}, NodeIndex{face[2]}});
    triangles.push_back({NodeIndex{face[0]}, NodeIndex{face[2]}, NodeIndex{face[3]}});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), where);
}

SurfaceMesh makeSphere(double radius, double chord_error, const std::string& where) {
  requirePositive(radius, "the radius", where);
  requirePositive(chord_error, "the chord error", where);
  const std::uint32_t steps = hemisphereSteps(radius, chord_error, where);
  return joinRings(mirrorUp(lowerHemisphere(radius, steps), 0.0), where);
}

SurfaceMesh makeCylinder(double radius, double length, double chord_error, const std::string& where) {
  requirePositive(radius, "the radius", where);
  requirePositive(length, "the length", where);
  requirePositive(chord_error, "the chord error", where);
  return joinRings(mirrorUp(lowerCap(radius, chord_error, where), 0.5 * length), where);
}

SurfaceMesh makeCone(double radius, double length, double chord_error, const std::string& where) {
  requirePositive(radius, "the radius", where);
  requirePositive(length, "the length", where);
  requirePositive(chord_error, "the chord error", where);
  std::vector<Ring> rings = lowerCap(radius, chord_error, where);
  for (Ring& ring : rings) ring.z = -0.5 * length;
  rings.push_back({0.5 * length, 0.0, 1});
  return joinRings(rings, where);
}

SurfaceMesh makeCapsule(double radius, double length, double chord_error, const std::string& where) {
  requirePositive(radius, "the radius", where);
  requirePositive(length, "the length", where);
  requirePositive(chord_error, "the chord error", where);
  const std::uint32_t steps = hemisphereSteps(radius, chord_error, where);
  return joinRings(mirrorUp(lowerHemisphere(radius, steps), 0.5 * length), where);
}

}  // namespace concave_distance

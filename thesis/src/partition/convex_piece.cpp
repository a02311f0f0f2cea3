#include "convex_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

/// Twice the facet's area times its outward unit normal (Newell's sum).
Eigen::Vector3d facetNormal(const std::vector<Eigen::Vector3d>& vertices,
                            const std::vector<std::uint32_t>& facet) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = vertices[facet[0]];
  for (std::size_t k = 1; k + 1 < facet.size(); ++k) {
    sum += (vertices[facet[k]] - origin).cross(vertices[facet[k + 1]] - origin);
  }
  return sum;
}

void checkIndices(const ConvexPiece& piece, const std::string& where) {
  if (piece.vertices.size() < 4 || piece.facets.size() < 4) {
    throw Error(where,
                "a convex piece has " + std::to_string(piece.vertices.size()) + " corners and " +
                    std::to_string(piece.facets.size()) + " facets",
                "a solid has at least four of each");
  }
  for (const Eigen::Vector3d& vertex : piece.vertices) {
    if (!vertex.allFinite()) {
      throw Error(where, "a corner is not finite", "check the file's numbers");
    }
  }
  for (const std::vector<std::uint32_t>& facet : piece.facets) {
    if (facet.size() < 3) {
      throw Error(where, "a facet has " + std::to_string(facet.size()) + " corners", "it needs three");
    }
    for (const std::uint32_t corner : facet) {
      if (corner >= piece.vertices.size()) {
        throw Error(where, "a facet names corner " + std::to_string(corner) + ", which does not exist",
                    "corners are counted within their piece");
      }
    }
  }
}

void measureSphere(ConvexPiece& piece) {
  for (const Eigen::Vector3d& vertex : piece.vertices) {
    piece.centre += vertex / static_cast<double>(piece.vertices.size());
  }
  for (const Eigen::Vector3d& vertex : piece.vertices) {
    piece.radius = std::max(piece.radius, (vertex - piece.centre).norm());
  }
}

}  // namespace

ConvexPiece makeConvexPiece(std::vector<Eigen::Vector3d> vertices,
                            std::vector<std::vector<std::uint32_t>> facets,
                            const std::vector<Eigen::Vector3d>& outward, const std::string& where) {
  ConvexPiece piece;
  piece.vertices = std::move(vertices);
  piece.facets = std::move(facets);
  checkIndices(piece, where);
  if (outward.size() != piece.facets.size()) {
    throw Error(where, "there are not as many directions as facets", "give one a facet");
  }
  measureSphere(piece);
  const auto count = static_cast<Eigen::Index>(piece.facets.size());
  piece.normals.resize(count, 3);
  piece.offsets.resize(count);
  for (Eigen::Index f = 0; f < count; ++f) {
    const Eigen::Vector3d direction = outward[static_cast<std::size_t>(f)].normalized();
    piece.normals.row(f) = -direction;
    piece.offsets[f] = support(piece, direction);
  }
  return piece;
}

ConvexPiece makeConvexPiece(std::vector<Eigen::Vector3d> vertices,
                            std::vector<std::vector<std::uint32_t>> facets, const std::string& where,
                            double tolerance) {
  ConvexPiece indexed;
  indexed.vertices = std::move(vertices);
  indexed.facets = std::move(facets);
  checkIndices(indexed, where);
  std::vector<Eigen::Vector3d> outward;
  for (std::size_t f = 0; f < indexed.facets.size(); ++f) {
    outward.push_back(facetNormal(indexed.vertices, indexed.facets[f]));
    if (outward.back().norm() == 0.0) {
      throw Error(where, "facet " + std::to_string(f) + " has no area", "leave it out");
    }
  }
  ConvexPiece piece = makeConvexPiece(std::move(indexed.vertices), std::move(indexed.facets), outward, where);
  for (std::size_t f = 0; f < piece.facets.size(); ++f) {
    const auto row = static_cast<Eigen::Index>(f);
    for (const std::uint32_t corner : piece.facets[f]) {
      const double inside = piece.normals.row(row).dot(piece.vertices[corner]) + piece.offsets[row];
      if (inside > tolerance * piece.radius) {
        throw Error(
            where,
            "another corner lies " + std::to_string(inside) + " m outside of facet " + std::to_string(f),
            "a piece must be convex, its facets flat and counter-clockwise seen from outside");
      }
    }
  }
  return piece;
}

double volume(const ConvexPiece& piece) {
  double sum = 0.0;
  for (const std::vector<std::uint32_t>& facet : piece.facets) {
    const Eigen::Vector3d a = piece.vertices[facet[0]] - piece.centre;
    for (std::size_t k = 1; k + 1 < facet.size(); ++k) {
      const Eigen::Vector3d b = piece.vertices[facet[k]] - piece.centre;
      const Eigen::Vector3d c = piece.vertices[facet[k + 1]] - piece.centre;
      sum += a.dot(b.cross(c)) / 6.0;
    }
  }
  return sum;
}

double depth(const ConvexPiece& piece, const Eigen::Vector3d& point) {
  return (piece.normals * point + piece.offsets).minCoeff();
}

double support(const ConvexPiece& piece, const Eigen::Vector3d& direction) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& vertex : piece.vertices) {
    highest = std::max(highest, direction.dot(vertex));
  }
  return highest;
}

}  // namespace concave_distance

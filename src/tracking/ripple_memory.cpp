#include "concave_distance/tracking/ripple_memory.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "concave_distance/distance/surface_walk.h"

namespace concave_distance {
namespace {

constexpr std::size_t kVertexLimit = 48;
// Vertices on a body that a refinement starts beyond.
constexpr std::size_t kStartsPerBody = 3;

// The vertices of the triangles at a witness and their neighbours.
struct Surroundings {
  std::array<NodeIndex, kVertexLimit> vertices;
  std::size_t count = 0;

  void add(NodeIndex vertex) {
    if (count < kVertexLimit &&
        std::find(vertices.begin(), vertices.begin() + count, vertex) == vertices.begin() + count) {
      vertices[count++] = vertex;
    }
  }
  Surroundings(const BodyMesh& body, TriangleIndex triangle) {
    for (const NodeIndex corner : body.surface().triangle(triangle)) {
      add(corner);
    }
    for (const NodeIndex corner : body.surface().triangle(triangle)) {
      for (const NodeIndex neighbour : body.topology().neighbours_of_vertex.row(corner.value)) {
        add(neighbour);
      }
    }
  }
};

struct Start {
  double squared_distance = std::numeric_limits<double>::infinity();
  NodeIndex vertex;
  TriangleIndex opposite;
};

// The triangle at a vertex that reaches farthest away from a point: a refinement that starts there does not
// look back over the ripple it has come over.
TriangleIndex triangleBeyond(const BodyMesh& body, NodeIndex vertex, const Eigen::Vector3d& point) {
  TriangleIndex beyond;
  double farthest = -1.0;
  for (const TriangleIndex triangle : body.topology().triangles_of_vertex.row(vertex.value)) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const NodeIndex corner : body.surface().triangle(triangle)) {
      sum += body.surface().vertex(corner);
    }
    const double away = (sum / 3.0 - point).squaredNorm();
    if (away > farthest) {
      farthest = away;
      beyond = triangle;
    }
  }
  return beyond;
}

struct OneSide {
  const BodyMesh& own;
  const BodyMesh& other;
  const Eigen::Isometry3d& other_from_own;
  TriangleIndex own_triangle;
  Feature own_feature;
  TriangleIndex other_triangle;
  Eigen::Vector3d own_point;  // own frame
};

// Whether a vertex is the one, or an end of the edge, that the witness lies on.
bool isOnFeature(const OneSide& side, NodeIndex vertex) {
  const FeatureKey key = featureKey(side.own.surface(), side.own_triangle, side.own_feature);
  return (key.kind == Feature::Vertex0 && vertex.value == key.first) ||
         (key.kind == Feature::Edge0 && (vertex.value == key.first || vertex.value == key.second));
}

std::array<Start, kStartsPerBody> closestStarts(const OneSide& side) {
  std::array<Start, kStartsPerBody> starts;
  const Surroundings around(side.own, side.own_triangle);
  for (std::size_t i = 0; i < around.count; ++i) {
    if (isOnFeature(side, around.vertices[i])) {
      continue;  // leads back to where the walk comes from
    }
    const Eigen::Vector3d vertex = side.other_from_own * side.own.surface().vertex(around.vertices[i]);
    const SurfacePoint opposite = walkTowards(side.other, side.other_triangle, vertex);
    Start next{opposite.squared_distance, around.vertices[i], opposite.triangle};
    for (Start& place : starts) {
      if (next.squared_distance < place.squared_distance) {
        std::swap(next, place);
      }
    }
  }
  return starts;
}

}  // namespace

FeatureKey featureKey(const SurfaceMesh& surface, TriangleIndex triangle, Feature feature) {
  const TriangleNodes& nodes = surface.triangle(triangle);
  const auto code = static_cast<std::size_t>(feature);
  if (code < 3) {
    return {Feature::Vertex0, nodes[code].value, 0};
  }
  if (code < 6) {
    const auto [least, most] = std::minmax(nodes[code - 3].value, nodes[(code - 2) % 3].value);
    return {Feature::Edge0, least, most};
  }
  return {Feature::Face, triangle.value, 0};
}

std::array<FeatureKey, 2> featuresOf(const PairGeometry& geometry, const WitnessPair& witness) {
  return {featureKey(geometry.a->surface(), witness.triangle_a, witness.feature_a),
          featureKey(geometry.b->surface(), witness.triangle_b, witness.feature_b)};
}

Ripple* RippleMemory::find(const PairGeometry& geometry, const WitnessPair& witness) {
  const std::array<FeatureKey, 2> features = featuresOf(geometry, witness);
  const auto found = std::find_if(ripples_.begin(), ripples_.end(),
                                  [&](const Ripple& ripple) { return ripple.features == features; });
  return found != ripples_.end() ? &*found : nullptr;
}

void RippleMemory::remember(const PairGeometry& geometry, const WitnessPair& witness, std::uint64_t owner,
                            std::uint64_t cycle) {
  Ripple* place = find(geometry, witness);
  if (place == nullptr && ripples_.size() < kCapacity) {
    ripples_.reserve(kCapacity);
    place = &ripples_.emplace_back();
  } else if (place == nullptr) {
    place = &*std::min_element(ripples_.begin(), ripples_.end(),
                               [](const Ripple& l, const Ripple& r) { return l.judged < r.judged; });
    place->walked = 0;
  }
  place->witness = witness;
  place->features = featuresOf(geometry, witness);
  place->owner = owner;
  place->judged = cycle;
}

void RippleMemory::follow(std::uint64_t owner, const WitnessPair& deepest, PairGeometry& geometry) {
  const std::array<FeatureKey, 2> taken = featuresOf(geometry, deepest);
  for (std::size_t i = 0; i < ripples_.size();) {
    Ripple& ripple = ripples_[i];
    if (ripple.owner != owner) {
      ++i;
      continue;
    }
    ripple.witness = geometry.refine(ripple.witness.triangle_a, ripple.witness.triangle_b).witness;
    const std::array<FeatureKey, 2> features = featuresOf(geometry, ripple.witness);
    bool merged = features == taken;
    for (std::size_t k = 0; k < ripples_.size() && !merged; ++k) {
      merged = k != i && ripples_[k].features == features && ripples_[k].owner == owner;
    }
    if (merged) {
      ripple = ripples_.back();
      ripples_.pop_back();
      continue;
    }
    ripple.features = features;
    ++i;
  }
}

void stepOverRipples(PairGeometry& geometry, const WitnessPair& from,
                     std::vector<NicheCandidate>& candidates) {
  const std::array<FeatureKey, 2> here = featuresOf(geometry, from);
  const auto refine = [&](TriangleIndex triangle_a, TriangleIndex triangle_b) {
    const WitnessRefinement refined = geometry.refine(triangle_a, triangle_b);
    if (!(featuresOf(geometry, refined.witness) == here)) {
      candidates.push_back({refined.witness, geometry.nodePairNear(refined.witness), refined.proven, 0});
    }
  };
  const OneSide on_a{*geometry.a,    *geometry.b,     geometry.b_from_a, from.triangle_a,
                     from.feature_a, from.triangle_b, from.point_a_in_a};
  for (const Start& start : closestStarts(on_a)) {
    if (start.squared_distance < std::numeric_limits<double>::infinity()) {
      refine(triangleBeyond(on_a.own, start.vertex, on_a.own_point), start.opposite);
    }
  }
  const OneSide on_b{*geometry.b,
                     *geometry.a,
                     geometry.a_from_b,
                     from.triangle_b,
                     from.feature_b,
                     from.triangle_a,
                     geometry.b_from_a * from.point_b_in_a};
  for (const Start& start : closestStarts(on_b)) {
    if (start.squared_distance < std::numeric_limits<double>::infinity()) {
      refine(start.opposite, triangleBeyond(on_b.own, start.vertex, on_b.own_point));
    }
  }
}

}  // namespace concave_distance

#include "minima_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cone_pair_bounds.h"
#include "mesh/surface/triangle_adjacency.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Item = NormalConeTree::Item;
using Kind = NormalConeTree::Kind;
using Slot = NormalConeTree::Slot;

/// Radians that the direction between two features may be off before its cone is asked, besides rounding.
constexpr double kDirectionSlack = 1e-6;
/// Sine of the angle between edges below which the direction across them is not believed.
constexpr double kNearlyParallel = 1e-6;

struct Between {
  Vector3d from;  ///< A's closest point
  Vector3d to;    ///< B's
  Vector3d displacement;
  double squared_distance;
};

Between between(const Vector3d& from, const Vector3d& to) {
  const Vector3d displacement = to - from;
  return {from, to, displacement, displacement.squaredNorm()};
}

double unitClamp(double x) {
  return x < 0.0 ? 0.0 : (x > 1.0 ? 1.0 : x);
}

Vector3d closestOnSegment(const Vector3d& point, const Vector3d& from, const Vector3d& to) {
  const Vector3d edge = to - from;
  const double squared_length = edge.squaredNorm();
  return squared_length > 0.0 ? Vector3d(from + unitClamp(edge.dot(point - from) / squared_length) * edge)
                              : from;
}

/// Two segments, as in the triangle kernel: parallel ones may give any of their closest pairs.
Between betweenSegments(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0, const Vector3d& b1) {
  const Vector3d u = a1 - a0;
  const Vector3d v = b1 - b0;
  const Vector3d n = u.cross(v);
  const double nn = n.squaredNorm();
  const double s = nn > 0.0 ? unitClamp((b0 - a0).cross(v).dot(n) / nn) : 0.0;
  const Vector3d on_b = closestOnSegment(a0 + s * u, b0, b1);
  return between(closestOnSegment(on_b, a0, a1), on_b);
}

bool allowed(Kind l, Kind r) {
  // What faces have in common with faces or edges ends at a vertex or an edge of one of them.
  return l == Kind::Vertex || r == Kind::Vertex || (l == Kind::Edge && r == Kind::Edge);
}

/// A cap's axis in the scene's frame.
struct FacingCap {
  Vector3d axis;
  double cosine;
  double sine;

  /// Whether `direction` (of length `length`) lies in it, or may within a turn.
  bool holds(const Vector3d& direction, double length, double turn_cosine, double turn_sine) const {
    const double sine_of_sum = turn_sine * cosine + turn_cosine * sine;
    return sine_of_sum <= 0.0 ||
           direction.dot(axis) >= (turn_cosine * cosine - turn_sine * sine - 1e-14) * length;
  }
};

class Traversal {
 public:
  Traversal(const MinimaScene& scene, NormalSides sides, double cutoff, std::vector<MinimumSeed>& seeds,
            LocalMinimaCost& cost, OpenCones& open, WorkLimit& limit)
      : scene_(scene),
        // Spheres and distances carry the rounding of the scene.
        slack_(4.0 * scene.rounding),
        cutoff_(cutoff + slack_),
        cones_a_(scene.a.normalCones(sides)),
        cones_b_(scene.b.normalCones(sides)),
        limits_a_(slack_, scene.size, cutoff_, cones_a_.unit()),
        limits_b_(slack_, scene.size, cutoff_, cones_b_.unit()),
        turned_(scene.frames.rotation.transpose()),
        seeds_(seeds),
        cost_(cost),
        open_(open),
        limit_(limit) {}

  /// Until every pair is looked at or the budget (groups of cones) is used up; goes on from what is open,
  /// from the roots when nothing is.
  void run(std::size_t budget) {
    if (cones_a_.empty() || cones_b_.empty()) return;
    if (open_.empty()) open_.emplace_back(NormalConeTree::kRoot, NormalConeTree::kRoot);
    const std::uint64_t last = budget < kAll ? cost_.node_pairs + budget : kAll;
    while (!open_.empty() && cost_.node_pairs < last) {
      if (limit_.isOverNow()) return;
      if (!limit_.makeRoom(open_, kWidth) || !limit_.makeRoom(seeds_)) {
        open_.clear();
        return;
      }
      const auto [a, b] = open_.back();
      open_.pop_back();
      const std::uint32_t child_a = cones_a_.child(a);
      const std::uint32_t child_b = cones_b_.child(b);
      const bool ends_a = (child_a & NormalConeTree::kItemFlag) != 0;
      const bool ends_b = (child_b & NormalConeTree::kItemFlag) != 0;
      if (ends_a && ends_b) {
        const Item& item_a = cones_a_.items()[child_a & ~NormalConeTree::kItemFlag];
        const Item& item_b = cones_b_.items()[child_b & ~NormalConeTree::kItemFlag];
        if (allowed(item_a.kind, item_b.kind)) visitPair(item_a, item_b);
        continue;
      }
      ++cost_.node_pairs;
      if (ends_a || (!ends_b && breadth(cones_b_, b) >= breadth(cones_a_, a))) {
        const ConeLanes excluded = excludes(cones_b_.nodes()[child_b], comparedA(a), limits_b_);
        pushChildren(cones_b_.nodes()[child_b], excluded, [&, kept = a](std::uint32_t lane) {
          open_.push_back({kept, child_b * kWidth + lane});
        });
      } else {
        const ConeLanes excluded = excludes(cones_a_.nodes()[child_a], comparedB(b), limits_a_);
        pushChildren(cones_a_.nodes()[child_a], excluded, [&, kept = b](std::uint32_t lane) {
          open_.push_back({child_a * kWidth + lane, kept});
        });
      }
    }
  }

 private:
  static constexpr std::uint32_t kWidth = NormalConeTree::kWidth;
  static constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();

  template <typename Push>
  static void pushChildren(const NormalConeTree::Node& node, const ConeLanes& excluded, const Push& push) {
    for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
      if (node.child[lane] == NormalConeTree::kNoChild) break;
      if (!(excluded[lane] > 0.0F)) push(lane);
    }
  }

  /// How much a child leaves open, in metres: the turn of its normals counts like the turn of directions.
  static double breadth(const NormalConeTree& cones, Slot slot) {
    const NormalConeTree::Node& node = cones.nodes()[slot / kWidth];
    return cones.unit() * node.radius[slot % kWidth] * (1.5 - node.cosine[slot % kWidth]);
  }

  static Vector3d vectorOf(const float (&lanes)[3][kWidth], Slot slot) {
    return {lanes[0][slot % kWidth], lanes[1][slot % kWidth], lanes[2][slot % kWidth]};
  }

  static ComparedCone compared(const NormalConeTree& from, Slot slot, const NormalConeTree& to,
                               const Vector3d& centre, const Vector3d& axis) {
    const NormalConeTree::Node& node = from.nodes()[slot / kWidth];
    const std::uint32_t lane = slot % kWidth;
    const Vector3d in_units = centre / to.unit();
    return {{static_cast<float>(in_units.x()), static_cast<float>(in_units.y()),
             static_cast<float>(in_units.z())},
            static_cast<float>(node.radius[lane] * (from.unit() / to.unit())),
            {static_cast<float>(axis.x()), static_cast<float>(axis.y()), static_cast<float>(axis.z())},
            node.angle[lane],
            node.cosine[lane],
            node.sine[lane]};
  }

  /// Child of A as B's nodes see it; the last one is kept.
  const ComparedCone& comparedA(Slot slot) {
    if (slot != compared_slot_a_) {
      const NormalConeTree::Node& node = cones_a_.nodes()[slot / kWidth];
      const Vector3d centre = cones_a_.unit() * vectorOf(node.centre, slot);
      compared_a_ = compared(cones_a_, slot, cones_b_, turned_ * (centre - scene_.frames.offset),
                             turned_ * vectorOf(node.axis, slot));
      compared_slot_a_ = slot;
    }
    return compared_a_;
  }
  const ComparedCone& comparedB(Slot slot) {
    if (slot != compared_slot_b_) {
      const NormalConeTree::Node& node = cones_b_.nodes()[slot / kWidth];
      const Vector3d centre = cones_b_.unit() * vectorOf(node.centre, slot);
      compared_b_ = compared(cones_b_, slot, cones_a_, scene_.frames.rotation * centre + scene_.frames.offset,
                             scene_.frames.rotation * vectorOf(node.axis, slot));
      compared_slot_b_ = slot;
    }
    return compared_b_;
  }

  void visitPair(const Item& a, const Item& b) {
    ++cost_.feature_pairs;
    const FacingCap cap_a{a.cap.axis, a.cap.cosine, a.cap.sine};
    const FacingCap cap_b{-(scene_.frames.rotation * b.cap.axis), b.cap.cosine, b.cap.sine};
    if (a.kind == Kind::Edge && b.kind == Kind::Edge && !edgesMayFace(a, b, cap_a, cap_b)) return;
    const Between found = closest(a, b);
    if (found.squared_distance > cutoff_ * cutoff_) return;
    const double distance = std::sqrt(found.squared_distance);
    if (distance <= slack_) return;  // meeting triangles are collected apart
    const double turn = std::min(0.5, kDirectionSlack + slack_ / distance);
    const double turn_cosine = 1.0 - 0.5 * turn * turn;
    if (!cap_a.holds(found.displacement, distance, turn_cosine, turn) ||
        !cap_b.holds(found.displacement, distance, turn_cosine, turn)) {
      return;
    }
    if (!isPeak(scene_.a, a, found.from, found.displacement / distance, distance,
                [this](NodeIndex n) { return scene_.vertexOfA(n); }) ||
        !isPeak(scene_.b, b, found.to, -found.displacement / distance, distance,
                [this](NodeIndex n) { return scene_.vertexOfB(n); })) {
      return;
    }
    ++cost_.candidates;
    seeds_.push_back({a.triangle, b.triangle, distance});
  }

  /// Two edges at an angle are closest along the direction across both: whether that lies in the caps of
  /// both needs no closest points.
  bool edgesMayFace(const Item& a, const Item& b, const FacingCap& cap_a, const FacingCap& cap_b) const {
    const Vector3d along_a = edgeOfA(a);
    const Vector3d along_b = edgeOfB(b);
    const Vector3d across = along_a.cross(along_b);
    const double length = across.norm();
    const double lengths = std::sqrt(along_a.squaredNorm() * along_b.squaredNorm());
    if (!(length > kNearlyParallel * lengths)) return true;
    constexpr double kTurnCosine = 1.0 - 0.5 * kDirectionSlack * kDirectionSlack;
    const auto both_hold = [&](const Vector3d& direction) {
      return cap_a.holds(direction, length, kTurnCosine, kDirectionSlack) &&
             cap_b.holds(direction, length, kTurnCosine, kDirectionSlack);
    };
    return both_hold(across) || both_hold(-across);
  }

  /// Whether no vertex next to the feature rises towards the other body by more than rounding: the normal
  /// cone itself, which the cap is around. Points are off by less than the slack, the direction between them
  /// by that over their distance.
  template <typename VertexOf>
  bool isPeak(const BodyMesh& body, const Item& item, const Vector3d& point, const Vector3d& direction,
              double distance, const VertexOf& vertex_of) const {
    const auto rises = [&](NodeIndex node) {
      const Vector3d displacement = vertex_of(node) - point;
      const double over = direction.dot(displacement) - slack_;
      const double turn = slack_ / distance;
      return over > 0.0 && over * over > turn * turn * displacement.squaredNorm();
    };
    const TriangleNodes& nodes = body.surface().triangle(item.triangle);
    // The end of an edge counts with all that is around it.
    for (const NodeIndex node : nodes) {
      if ((vertex_of(node) - point).squaredNorm() > slack_ * slack_) continue;
      const auto around = body.topology().neighbours_of_vertex.row(node.value);
      return std::none_of(around.begin(), around.end(), rises);
    }
    if (std::any_of(nodes.begin(), nodes.end(), rises)) return false;
    if (item.kind == Kind::Face) return true;
    const NodeIndex from = nodes[item.element];
    const NodeIndex to = nodes[(item.element + 1U) % 3];
    for (const AdjacentTriangle& next : body.adjacency().row(item.triangle.value)) {
      if (next.from != from || next.to != to) continue;
      const TriangleNodes& beyond = body.surface().triangle(next.triangle);
      if (std::any_of(beyond.begin(), beyond.end(), rises)) return false;
    }
    return true;
  }

  TrianglePoints cornersOfA(const Item& item) const { return scene_.cornersOfA(item.triangle); }
  TrianglePoints cornersOfB(const Item& item) const { return scene_.cornersOfB(item.triangle); }
  static Vector3d edgeOf(const SurfaceMesh& mesh, const Item& item) {
    return mesh.corner(item.triangle, (item.element + 1) % 3) - mesh.corner(item.triangle, item.element);
  }
  Vector3d edgeOfA(const Item& item) const { return edgeOf(scene_.a.surface(), item); }
  Vector3d edgeOfB(const Item& item) const {
    return scene_.frames.rotation * edgeOf(scene_.b.surface(), item);
  }

  Between closest(const Item& a, const Item& b) const {
    const TrianglePoints ta = cornersOfA(a);
    const TrianglePoints tb = cornersOfB(b);
    const Vector3d& a0 = ta[a.element];
    const Vector3d& b0 = tb[b.element];
    const auto next_of = [](const TrianglePoints& t, std::size_t k) -> const Vector3d& {
      return t[k == 2 ? 0 : k + 1];
    };
    if (a.kind == Kind::Vertex) {
      if (b.kind == Kind::Vertex) return between(a0, b0);
      if (b.kind == Kind::Edge) return between(a0, closestOnSegment(a0, b0, next_of(tb, b.element)));
      return between(a0, pointTriangleDistance(a0, tb).point);
    }
    if (b.kind == Kind::Vertex) {
      if (a.kind == Kind::Edge) return between(closestOnSegment(b0, a0, next_of(ta, a.element)), b0);
      return between(pointTriangleDistance(b0, ta).point, b0);
    }
    return betweenSegments(a0, next_of(ta, a.element), b0, next_of(tb, b.element));
  }

  const MinimaScene& scene_;
  double slack_;
  double cutoff_;
  const NormalConeTree& cones_a_;
  const NormalConeTree& cones_b_;
  ConeLimits limits_a_;  ///< for comparisons with A's nodes
  ConeLimits limits_b_;
  Eigen::Matrix3d turned_;  ///< from A's axes to B's
  ComparedCone compared_a_{};
  ComparedCone compared_b_{};
  Slot compared_slot_a_ = NormalConeTree::kNoChild;
  Slot compared_slot_b_ = NormalConeTree::kNoChild;
  std::vector<MinimumSeed>& seeds_;
  LocalMinimaCost& cost_;
  OpenCones& open_;
  WorkLimit& limit_;
};

Eigen::AlignedBox3d movedBox(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& a_from_b) {
  const Vector3d centre = a_from_b * box.center();
  const Vector3d half = 0.5 * (a_from_b.linear().cwiseAbs() * box.sizes());
  return {centre - half, centre + half};
}

}  // namespace

void collectConeSeeds(const MinimaScene& scene, NormalSides sides, double cutoff, std::size_t budget,
                      OpenCones& open, std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost,
                      WorkLimit& limit) {
  Traversal(scene, sides, cutoff, seeds, cost, open, limit).run(budget);
}

void collectMeetingPairs(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost,
                         WorkLimit& limit) {
  const TriangleTree& tree_a = scene.a.tree();
  const TriangleTree& tree_b = scene.b.tree();
  const double slack = 4.0 * scene.rounding;
  // Boxes are compared in A's own frame, far from whose origin coordinates round coarser.
  const double origin = scene.a.surface().boundingBox().center().cwiseAbs().maxCoeff() +
                        scene.b.surface().boundingBox().center().cwiseAbs().maxCoeff();
  const double margin = slack + 1e-14 * (origin + scene.size);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0U, 0U}};
  while (!open.empty()) {
    if (limit.isOverNow() || !limit.makeRoom(open, 2)) return;
    const auto [i, j] = open.back();
    open.pop_back();
    const TriangleTree::Node& a = tree_a.nodes()[i];
    const TriangleTree::Node& b = tree_b.nodes()[j];
    ++cost.node_pairs;
    if (a.box.squaredExteriorDistance(movedBox(b.box, scene.a_from_b)) > margin * margin) continue;
    if (a.count > 0 && b.count > 0) {
      for (std::uint32_t k = a.first; k < a.first + a.count; ++k) {
        for (std::uint32_t l = b.first; l < b.first + b.count; ++l) {
          const TriangleIndex ta = tree_a.order()[k];
          const TriangleIndex tb = tree_b.order()[l];
          ++cost.candidates;
          if (triangleDistance(scene.cornersOfA(ta), scene.cornersOfB(tb)).squared_distance <=
              slack * slack) {
            if (!limit.makeRoom(seeds)) return;
            seeds.push_back({ta, tb, 0.0});
          }
        }
      }
    } else if (b.count > 0 || (a.count == 0 && a.box.sizes().sum() >= b.box.sizes().sum())) {
      open.emplace_back(i + 1, j);
      open.emplace_back(a.first, j);
    } else {
      open.emplace_back(i, j + 1);
      open.emplace_back(i, b.first);
    }
  }
}

}  // namespace concave_distance::detail

#include "minima_candidates.h"

#include <algorithm>
#include <cmath>

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Item = NormalConeTree::Item;
using Kind = NormalConeTree::Kind;
using Node = NormalConeTree::Node;

/// Radians that the direction between two features may be off before its cone is asked, besides rounding.
constexpr double kDirectionSlack = 1e-6;

struct Between {
  Vector3d from;  ///< A's closest point
  Vector3d to;    ///< B's
  Vector3d way;
  double squared_distance;
};

Between between(const Vector3d& from, const Vector3d& to) {
  const Vector3d way = to - from;
  return {from, to, way, way.squaredNorm()};
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

/// An item or a node of B in the scene's frame.
template <typename Part>
std::vector<Part> moved(const std::vector<Part>& parts, const LocalFrames& frames) {
  std::vector<Part> result = parts;
  for (Part& part : result) {
    part.centre = frames.rotation * (part.centre - frames.centre_b) + frames.offset;
    part.cap.axis = frames.rotation * part.cap.axis;
  }
  return result;
}

bool allowed(Kind l, Kind r) {
  // What faces have in common with faces or edges ends at a vertex or an edge of one of them.
  return l == Kind::Vertex || r == Kind::Vertex || (l == Kind::Edge && r == Kind::Edge);
}

class Traversal {
 public:
  Traversal(const MinimaScene& scene, double cutoff, std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost)
      : scene_(scene),
        // Spheres and distances carry the rounding of the scene.
        slack_(4.0 * scene.rounding),
        cutoff_(cutoff + slack_),
        nodes_a_(scene.a.cones().nodes()),
        items_a_(scene.a.cones().items()),
        nodes_b_(moved(scene.b.cones().nodes(), scene.frames)),
        items_b_(moved(scene.b.cones().items(), scene.frames)),
        seeds_(seeds),
        cost_(cost) {}

  void run() {
    if (nodes_a_.empty() || nodes_b_.empty()) return;
    open_.emplace_back(0U, 0U);
    while (!open_.empty()) {
      const auto [i, j] = open_.back();
      open_.pop_back();
      const Node& a = nodes_a_[i];
      const Node& b = nodes_b_[j];
      ++cost_.node_pairs;
      if (!mayHold(a, b)) continue;
      if (a.count > 0 && b.count > 0) {
        visitLeaves(a, b);
      } else if (b.count > 0 || (a.count == 0 && breadth(a) >= breadth(b))) {
        open_.emplace_back(i + 1, j);
        open_.emplace_back(a.first, j);
      } else {
        open_.emplace_back(i, j + 1);
        open_.emplace_back(i, b.first);
      }
    }
  }

 private:
  /// How much a node leaves open: the turn of its normals counts like the turn of directions.
  double breadth(const Node& node) const { return node.radius * (1.5 - node.cap.cosine); }

  template <typename Part>
  bool mayHold(const Part& a, const Part& b) const {
    const double cosine = -a.cap.axis.dot(b.cap.axis);
    if (!capsMeet(cosine, a.cap, b.cap)) return false;
    const Vector3d way = b.centre - (a.centre - scene_.frames.centre_a);
    const double reach = a.radius + b.radius + slack_;
    const double squared = way.squaredNorm();
    const double farthest = cutoff_ + reach;
    if (squared > farthest * farthest) return false;
    if (squared <= reach * reach) return true;
    const double length = std::sqrt(squared);
    const double sine = reach / length;
    const DirectionCap directions{way, std::sqrt(std::max(0.0, 1.0 - sine * sine)), sine};
    return capsMeet(way.dot(a.cap.axis) / length + 1e-14, directions, a.cap) &&
           capsMeet(-way.dot(b.cap.axis) / length + 1e-14, directions, b.cap);
  }

  void visitLeaves(const Node& a, const Node& b) {
    for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
      for (std::uint32_t j = b.first; j < b.first + b.count; ++j) {
        if (allowed(items_a_[i].kind, items_b_[j].kind) && mayHold(items_a_[i], items_b_[j])) {
          visitPair(items_a_[i], items_b_[j]);
        }
      }
    }
  }

  void visitPair(const Item& a, const Item& b) {
    ++cost_.feature_pairs;
    const Between found = closest(a, b);
    if (found.squared_distance > cutoff_ * cutoff_) return;
    const double distance = std::sqrt(found.squared_distance);
    if (distance <= slack_) return;  // meeting triangles are collected apart
    const double turn = std::min(0.5, kDirectionSlack + slack_ / distance);
    const DirectionCap allowance{found.way, std::cos(turn), std::sin(turn)};
    if (!capsMeet(found.way.dot(a.cap.axis) / distance, allowance, a.cap) ||
        !capsMeet(-found.way.dot(b.cap.axis) / distance, allowance, b.cap)) {
      return;
    }
    if (!isPeak(scene_.a, scene_.vertices_a, a, found.from, found.way / distance, distance) ||
        !isPeak(scene_.b, scene_.vertices_b, b, found.to, -found.way / distance, distance)) {
      return;
    }
    ++cost_.candidates;
    // The surfaces around the pair decide. A true minimum does not move by more than rounding.
    const WitnessRefinement refined =
        refineWitness(scene_.a.body(), scene_.b.body(), scene_.a_from_b, a.triangle, b.triangle, refinement_);
    const double settled = std::sqrt(refined.witness.squared_distance);
    if (settled < distance - slack_) return;
    seeds_.push_back({refined.witness.triangle_a, refined.witness.triangle_b, settled});
  }

  /// Whether no vertex next to the feature rises towards the other body by more than rounding: the normal
  /// cone itself, which the cap is around. Points are off by less than the slack, the direction between them
  /// by that over their distance.
  bool isPeak(const MinimaIndex& index, const std::vector<Vector3d>& vertices, const Item& item,
              const Vector3d& point, const Vector3d& direction, double distance) const {
    const auto rises = [&](NodeIndex node) {
      const Vector3d way = vertices[node.value] - point;
      const double over = direction.dot(way) - slack_;
      const double turn = slack_ / distance;
      return over > 0.0 && over * over > turn * turn * way.squaredNorm();
    };
    const TriangleNodes& nodes = index.body().surface().triangle(item.triangle);
    // The end of an edge counts with all that is around it.
    for (const NodeIndex node : nodes) {
      if ((vertices[node.value] - point).squaredNorm() > slack_ * slack_) continue;
      const auto around = index.body().topology().neighbours_of_vertex.row(node.value);
      return std::none_of(around.begin(), around.end(), rises);
    }
    if (std::any_of(nodes.begin(), nodes.end(), rises)) return false;
    if (item.kind == Kind::Face) return true;
    const NodeIndex from = nodes[item.element];
    const NodeIndex to = nodes[(item.element + 1U) % 3];
    for (const AdjacentTriangle& next : index.adjacency().row(item.triangle.value)) {
      if (next.from != from || next.to != to) continue;
      const TriangleNodes& beyond = index.body().surface().triangle(next.triangle);
      if (std::any_of(beyond.begin(), beyond.end(), rises)) return false;
    }
    return true;
  }

  TrianglePoints cornersOfA(const Item& item) const { return scene_.cornersOfA(item.triangle); }
  TrianglePoints cornersOfB(const Item& item) const { return scene_.cornersOfB(item.triangle); }

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
  const std::vector<Node>& nodes_a_;
  const std::vector<Item>& items_a_;
  std::vector<Node> nodes_b_;
  std::vector<Item> items_b_;
  std::vector<MinimumSeed>& seeds_;
  LocalMinimaCost& cost_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open_;
  RefinementWorkspace refinement_;
};

Eigen::AlignedBox3d movedBox(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& a_from_b) {
  const Vector3d centre = a_from_b * box.center();
  const Vector3d half = 0.5 * (a_from_b.linear().cwiseAbs() * box.sizes());
  return {centre - half, centre + half};
}

}  // namespace

void collectConeSeeds(const MinimaScene& scene, double cutoff, std::vector<MinimumSeed>& seeds,
                      LocalMinimaCost& cost) {
  Traversal(scene, cutoff, seeds, cost).run();
}

void collectMeetingPairs(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, LocalMinimaCost& cost) {
  const TriangleTree& tree_a = scene.a.body().tree();
  const TriangleTree& tree_b = scene.b.body().tree();
  const double slack = 4.0 * scene.rounding;
  // Boxes are compared in A's own frame, far from whose origin coordinates round coarser.
  const double origin = scene.a.body().surface().boundingBox().center().cwiseAbs().maxCoeff() +
                        scene.b.body().surface().boundingBox().center().cwiseAbs().maxCoeff();
  const double margin = slack + 1e-14 * (origin + scene.size);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0U, 0U}};
  while (!open.empty()) {
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

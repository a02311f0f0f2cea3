#include "overlay_depth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace concave_distance::detail {
namespace {

/// Below this a face is seen edge-on: its edges say all.
constexpr double kEdgeOn = 1e-12;

Eigen::Vector3d along(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double share) {
  return share <= 0.5 ? Eigen::Vector3d(from + share * (to - from))
                      : Eigen::Vector3d(to + (1.0 - share) * (from - to));
}

}  // namespace

void OverlayDepth::begin(const Eigen::Vector3d& normal, const Eigen::Vector3d& start, double lateral) {
  const Eigen::Vector3d across = normal.unitOrthogonal();
  axes_.row(0) = across.transpose();
  axes_.row(1) = normal.cross(across).transpose();
  axes_.row(2) = normal.transpose();
  start_ = start;
  lateral_ = lateral;
  best_ = 0.0;
  best_a_ = best_b_ = Eigen::Vector3d::Zero();
  for (Pieces& pieces : pieces_) {
    pieces.edges.clear();
    pieces.faces.clear();
  }
}

void OverlayDepth::addFace(Side side, const Eigen::Vector3d& normal) {
  Pieces& pieces = pieces_[at(side)];
  const auto edge = static_cast<std::uint32_t>(pieces.edges.size());
  pieces.faces.push_back({axes_ * normal, edge, edge});
}

void OverlayDepth::addEdge(Side side, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Pieces& pieces = pieces_[at(side)];
  pieces.edges.push_back({axes_ * (from - start_), axes_ * (to - start_)});
  ++pieces.faces.back().last_edge;
}

void OverlayDepth::buildTrees(Pieces& pieces) {
  pieces.edge_boxes.clear();
  pieces.face_boxes.clear();
  for (const Face& face : pieces.faces) {
    FlatBox whole{pieces.edges[face.first_edge].from, pieces.edges[face.first_edge].from};
    for (std::uint32_t e = face.first_edge; e < face.last_edge; ++e) {
      const Edge& edge = pieces.edges[e];
      const FlatBox box{edge.from.array().min(edge.to.array()), edge.from.array().max(edge.to.array())};
      pieces.edge_boxes.push_back(box);
      whole.low = whole.low.min(box.low);
      whole.high = whole.high.max(box.high);
    }
    pieces.face_boxes.push_back(whole);
  }
  pieces.edge_tree.build(pieces.edge_boxes);
  pieces.face_tree.build(pieces.face_boxes);
}

OverlayDepth::Result OverlayDepth::solve() {
  double reach = 0.0;
  for (Pieces& pieces : pieces_) {
    buildTrees(pieces);
    if (pieces.edge_tree.nodes().empty()) return {0.0, start_, start_};
    const FlatBox& box = pieces.edge_tree.nodes()[0].box;
    reach = std::max({reach, box.low.abs().maxCoeff(), box.high.abs().maxCoeff()});
  }
  slack_ = 0x1.0p-50 * reach;
  Pieces& a = pieces_[0];
  Pieces& b = pieces_[1];
  descend(a.edge_tree, b.face_tree,
          [&](std::uint32_t edge, std::uint32_t face) { cornerOverFace(Side::A, a.edges[edge], face); });
  descend(a.face_tree, b.edge_tree,
          [&](std::uint32_t face, std::uint32_t edge) { cornerOverFace(Side::B, b.edges[edge], face); });
  descend(a.edge_tree, b.edge_tree, [&](std::uint32_t edge_a, std::uint32_t edge_b) {
    edgeAcrossEdge(a.edges[edge_a], b.edges[edge_b]);
  });
  const Eigen::Matrix3d back = axes_.transpose();
  return {best_, start_ + back * best_a_, start_ + back * best_b_};
}

template <typename Visit>
void OverlayDepth::descend(const BoxTree& tree_a, const BoxTree& tree_b, const Visit& visit) {
  const auto gain = [&](std::uint32_t a, std::uint32_t b) {
    const FlatBox& box_a = tree_a.nodes()[a].box;
    const FlatBox& box_b = tree_b.nodes()[b].box;
    const bool aside = (box_a.low.head<2>() > box_b.high.head<2>() + lateral_).any() ||
                       (box_b.low.head<2>() > box_a.high.head<2>() + lateral_).any();
    return aside ? -1.0 : box_a.high[2] - box_b.low[2];
  };
  stack_.assign(1, {0U, 0U});
  while (!stack_.empty()) {
    const auto [index_a, index_b] = stack_.back();
    stack_.pop_back();
    if (!(gain(index_a, index_b) > best_ + slack_)) continue;
    const BoxTree::Node& a = tree_a.nodes()[index_a];
    const BoxTree::Node& b = tree_b.nodes()[index_b];
    if (a.count > 0 && b.count > 0) {
      for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
        for (std::uint32_t j = b.first; j < b.first + b.count; ++j)
          visit(tree_a.order()[i], tree_b.order()[j]);
      }
      continue;
    }
    const bool split_a =
        b.count > 0 || (a.count == 0 && (a.box.high - a.box.low).sum() >= (b.box.high - b.box.low).sum());
    std::pair<std::uint32_t, std::uint32_t> near =
        split_a ? std::make_pair(index_a + 1, index_b) : std::make_pair(index_a, index_b + 1);
    std::pair<std::uint32_t, std::uint32_t> far =
        split_a ? std::make_pair(a.first, index_b) : std::make_pair(index_a, b.first);
    if (gain(far.first, far.second) > gain(near.first, near.second)) std::swap(near, far);
    stack_.push_back(far);
    stack_.push_back(near);
  }
}

void OverlayDepth::offer(const Eigen::Vector3d& on_a, const Eigen::Vector3d& on_b) {
  const double gap = on_a[2] - on_b[2];
  if (!(gap > best_)) return;
  best_ = gap;
  best_a_ = on_a;
  best_b_ = on_b;
}

void OverlayDepth::cornerOverFace(Side corner_side, const Edge& edge, std::uint32_t face) {
  const Pieces& pieces = pieces_[at(other(corner_side))];
  const Face& f = pieces.faces[face];
  const Eigen::Vector3d& corner = edge.from;
  if (std::abs(f.normal[2]) < kEdgeOn) return;
  const Eigen::Vector3d& origin = pieces.edges[f.first_edge].from;
  const double height =
      origin[2] -
      (f.normal[0] * (corner[0] - origin[0]) + f.normal[1] * (corner[1] - origin[1])) / f.normal[2];
  const FlatBox& box = pieces.face_boxes[face];
  const Eigen::Vector3d below(corner[0], corner[1], std::clamp(height, box.low[2], box.high[2]));
  const double gap = corner_side == Side::A ? corner[2] - below[2] : below[2] - corner[2];
  if (!(gap > best_ + slack_)) return;
  bool inside = false;
  for (std::uint32_t e = f.first_edge; e < f.last_edge; ++e) {
    const Edge& side = pieces.edges[e];
    if ((side.from[1] <= corner[1]) == (side.to[1] <= corner[1])) continue;
    const double share = (corner[1] - side.from[1]) / (side.to[1] - side.from[1]);
    if (side.from[0] + share * (side.to[0] - side.from[0]) > corner[0]) inside = !inside;
  }
  if (!inside) return;
  if (corner_side == Side::A) {
    offer(corner, below);
  } else {
    offer(below, corner);
  }
}

void OverlayDepth::edgeAcrossEdge(const Edge& a, const Edge& b) {
  if (!(std::max(a.from[2], a.to[2]) - std::min(b.from[2], b.to[2]) > best_ + slack_)) return;
  const Eigen::Vector2d along_a = (a.to - a.from).head<2>();
  const Eigen::Vector2d along_b = (b.to - b.from).head<2>();
  const double turn = along_a[0] * along_b[1] - along_a[1] * along_b[0];
  const double length_a = along_a.norm();
  const double length_b = along_b.norm();
  if (std::abs(turn) > kEdgeOn * length_a * length_b) {
    const Eigen::Vector2d displacement = (b.from - a.from).head<2>();
    const double share_a = (displacement[0] * along_b[1] - displacement[1] * along_b[0]) / turn;
    const double share_b = (displacement[0] * along_a[1] - displacement[1] * along_a[0]) / turn;
    if (share_a >= 0.0 && share_a <= 1.0 && share_b >= 0.0 && share_b <= 1.0)
      offer(along(a.from, a.to, share_a), along(b.from, b.to, share_b));
  }
  endsOverEdge(a, b, true);
  endsOverEdge(b, a, false);
}

void OverlayDepth::endsOverEdge(const Edge& ends, const Edge& edge, bool ends_on_a) {
  const Eigen::Vector2d direction = (edge.to - edge.from).head<2>();
  const double squared_length = direction.squaredNorm();
  const auto offer_both = [&](const Eigen::Vector3d& end, const Eigen::Vector3d& point) {
    if ((end - point).head<2>().squaredNorm() > lateral_ * lateral_) return;
    if (ends_on_a) {
      offer(end, point);
    } else {
      offer(point, end);
    }
  };
  for (const Eigen::Vector3d* end : {&ends.from, &ends.to}) {
    if (squared_length > lateral_ * lateral_) {
      const double share = direction.dot((*end - edge.from).head<2>()) / squared_length;
      offer_both(*end, along(edge.from, edge.to, std::clamp(share, 0.0, 1.0)));
    } else {
      offer_both(*end, edge.from);
      offer_both(*end, edge.to);
    }
  }
}

}  // namespace concave_distance::detail

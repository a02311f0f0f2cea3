#include "basin_boundary.h"

#include <algorithm>
#include <cmath>

#include "distance/kernels/pair_motion.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Row = Eigen::Array<float, BoundaryPool::kWidth, 1>;

/// Bounds the error of a bound in single precision, relative to the numbers in it (2^-24 for each of 16
/// roundings, and as much to spare).
constexpr double kSingleError = 0x1.0p-18;

/// The corners of an element's part on one body, in the body's own axes and the frame's centre.
struct Part {
  std::array<Vector3d, 4> corners;
  std::size_t count;

  double leastAlong(const Vector3d& direction) const {
    double least = direction.dot(corners[0]);
    for (std::size_t k = 1; k < count; ++k) least = std::min(least, direction.dot(corners[k]));
    return least;
  }
  double radiusOf(const Vector3d& centre) const {
    double most = 0.0;
    for (std::size_t k = 0; k < count; ++k) most = std::max(most, (corners[k] - centre).squaredNorm());
    return std::sqrt(most);
  }
};

Part partOf(const PairFrame& frame, Side side, const SharedElement& element) {
  if (element.side == side) {
    return {{frame.ownVertex(side, element.from), frame.ownVertex(side, element.to)}, 2};
  }
  const SurfaceMesh& mesh = (side == Side::A ? frame.a : frame.b).surface();
  const Facets& facets = side == Side::A ? *frame.facets_a : *frame.facets_b;
  const Vector3d& centre = side == Side::A ? frame.centre_a : frame.centre_b;
  Part part{{}, facets.isQuad(element.other) ? std::size_t{4} : std::size_t{3}};
  for (std::size_t k = 0; k < part.count; ++k) {
    part.corners[k] = mesh.vertex(facets.nodes[element.other.value][k]) - centre;
  }
  return part;
}

/// The gap between an element's parts along a direction from A to B.
double gapAlong(const PairFrame& frame, const SharedElement& shared, const Vector3d& direction) {
  return partOf(frame, Side::B, shared).leastAlong(frame.rotation.transpose() * direction) +
         direction.dot(frame.offset) + partOf(frame, Side::A, shared).leastAlong(-direction) -
         2.0 * frame.rounding;
}

Row rowOf(const std::array<float, BoundaryPool::kWidth>& row) {
  return Eigen::Map<const Row>(row.data());
}

}  // namespace

/// Says how far an element's parts reach; the body with the smaller radius counts as the one that moves.
struct BasinBoundary::Radii {
  Radii(const Part& a, const Part& b, const std::array<Vector3d, 2>& centres) {
    const double radius_a = a.radiusOf(centres[0]);
    const double radius_b = b.radiusOf(centres[1]);
    fixed_in = radius_b <= radius_a ? Side::A : Side::B;
    smaller = static_cast<float>(std::min(radius_a, radius_b));
  }
  Side fixed_in;
  float smaller;
};

/// Bounds the gaps of a batch at another pose.
class BasinBoundary::Bound {
 public:
  Bound(const PairFrame& frame, const Batch& batch, const Vector3d& moving_centre) {
    const PairMotion motion = motionSince(batch, frame);
    const Vector3d displacement = motion.of(moving_centre);
    const double reach = displacement.norm();
    const double rounding = kSingleError * (reach + motion.stretch() * static_cast<double>(batch.largest));
    less_ = 4.0 * frame.rounding + rounding + (batch.directed ? 0.0 : reach);
    turn_ = static_cast<float>(motion.stretch());
    along_ = batch.directed ? Eigen::Vector3f(displacement.cast<float>()) : Eigen::Vector3f::Zero();
  }

  /// Returns what of() must be above for a level (metres) to be certain.
  float needed(double level) const { return static_cast<float>((level + less_) * (1.0 + kSingleError)); }

  Row of(const BoundaryPool::Chunk& chunk) const {
    return rowOf(chunk.gap) - turn_ * rowOf(chunk.radius) + along_[0] * rowOf(chunk.direction[0]) +
           along_[1] * rowOf(chunk.direction[1]) + along_[2] * rowOf(chunk.direction[2]);
  }

  /// Certain gaps at the pose.
  Row gapsOf(const BoundaryPool::Chunk& chunk) const {
    const auto error = static_cast<float>(2.0 * kSingleError);
    return (of(chunk) - static_cast<float>(less_)) - error * rowOf(chunk.gap).abs();
  }

 private:
  /// Returns the motion of the body that counts as the one that moves.
  static PairMotion motionSince(const Batch& batch, const PairFrame& frame) {
    if (batch.fixed_in == Side::A) {
      return {batch.rotation, batch.offset, frame.rotation, frame.offset};
    }
    return {batch.rotation.transpose(), -(batch.rotation.transpose() * batch.offset),
            frame.rotation.transpose(), -(frame.rotation.transpose() * frame.offset)};
  }

  double less_;  ///< metres
  float turn_;
  Eigen::Vector3f along_;
};

void BasinBoundary::begin(BoundaryPool& pool, const Vector3d& centre_a, const Vector3d& centre_b) {
  clear(pool);
  centres_ = {centre_a, centre_b};
}

void BasinBoundary::clear(BoundaryPool& pool) {
  for (std::uint32_t i = 0; i < used_; ++i) pool.release(batches_[i].first);
  used_ = 0;
}

std::size_t BasinBoundary::size(const BoundaryPool& pool) const {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < used_; ++i) {
    for (std::uint32_t c = batches_[i].first; c != BoundaryPool::kNone; c = pool[c].next)
      count += pool[c].count;
  }
  return count;
}

BasinBoundary::Batch& BasinBoundary::batchAt(const PairFrame& frame, Side fixed_in, bool directed) {
  for (std::uint32_t i = used_; i-- > 0;) {
    Batch& batch = batches_[i];
    if (batch.fixed_in == fixed_in && batch.directed == directed && batch.rotation == frame.rotation &&
        batch.offset == frame.offset) {
      return batch;
    }
  }
  Batch& batch = batches_[used_++];
  batch = {fixed_in, directed, frame.rotation, frame.offset, 0.0F, BoundaryPool::kNone};
  return batch;
}

std::uint32_t BasinBoundary::placeIn(BoundaryPool& pool, Batch& batch) {
  if (batch.first == BoundaryPool::kNone || pool[batch.first].count == BoundaryPool::kWidth) {
    batch.first = pool.take(batch.first);
  }
  return pool[batch.first].count++;
}

BoundaryPool::Entry BasinBoundary::takeFrom(BoundaryPool::Chunk& chunk, std::uint32_t k) {
  const BoundaryPool::Entry entry{chunk.gap[k],
                                  chunk.radius[k],
                                  {chunk.direction[0][k], chunk.direction[1][k], chunk.direction[2][k]},
                                  chunk.elements[k]};
  const std::uint32_t last = --chunk.count;
  chunk.gap[k] = chunk.gap[last];
  chunk.radius[k] = chunk.radius[last];
  for (std::array<float, BoundaryPool::kWidth>& component : chunk.direction) component[k] = component[last];
  chunk.elements[k] = chunk.elements[last];
  return entry;
}

void BasinBoundary::put(BoundaryPool& pool, Batch& batch, const BoundaryPool::Entry& entry) {
  const std::uint32_t k = placeIn(pool, batch);
  BoundaryPool::Chunk& chunk = pool[batch.first];
  chunk.gap[k] = entry.gap;
  chunk.radius[k] = entry.radius;
  for (std::size_t d = 0; d < 3; ++d) chunk.direction[d][k] = entry.direction[static_cast<Eigen::Index>(d)];
  chunk.elements[k] = entry.element;
  batch.largest = std::max(batch.largest, entry.radius);
}

void BasinBoundary::add(BoundaryPool& pool, const PairFrame& frame, const BoundaryElement& element,
                        double level) {
  const Radii radii(partOf(frame, Side::A, element.shared), partOf(frame, Side::B, element.shared), centres_);
  if (used_ == kMostBatches) rebase(pool, frame);
  // Twice for the level, and as much for quadrangles that are not quite flat.
  const auto gap = static_cast<float>(level - 4.0 * frame.rounding);
  put(pool, batchAt(frame, radii.fixed_in, false), {gap, radii.smaller, Eigen::Vector3f::Zero(), element});
}

/// Takes out of the batch what may be nearer than the level: it is looked at along its direction, and
/// measured where that does not suffice.
std::uint32_t BasinBoundary::look(BoundaryPool& pool, const PairFrame& frame, Batch& batch, double level,
                                  WorkLimit& limit) const {
  const Bound bound(frame, batch, centres_[batch.fixed_in == Side::A ? 1 : 0]);
  const float needed = bound.needed(level);
  std::uint32_t measured = 0;
  std::uint32_t* at = &batch.first;
  while (*at != BoundaryPool::kNone) {
    BoundaryPool::Chunk& chunk = pool[*at];
    const Row bounds = bound.of(chunk);
    for (std::uint32_t k = chunk.count; k-- > 0;) {
      if (bounds[k] > needed) continue;
      if (limit.isOverNow()) {
        pool.has_unmeasured = true;
        continue;
      }
      BoundaryPool::Entry entry = takeFrom(chunk, k);
      const auto enter = [&](const Vector3d& direction, double gap) {
        const Vector3d along =
            batch.fixed_in == Side::A ? direction : Vector3d(frame.rotation.transpose() * -direction);
        entry.direction = along.cast<float>();
        entry.gap = static_cast<float>(gap);
        pool.anew.push_back({batch.fixed_in, entry});
      };
      if (batch.directed) {
        const Vector3d along = entry.direction.cast<double>().normalized();
        const Vector3d direction = batch.fixed_in == Side::A ? along : Vector3d(frame.rotation * -along);
        const double gap = gapAlong(frame, entry.element.shared, direction);
        if (gap > level) {
          enter(direction, gap);
          continue;
        }
      }
      ++measured;
      const TrianglePairDistance closest = closestOver(frame, entry.element.shared);
      if (closest.squared_distance < level * level) {
        pool.crossed.push_back(entry.element);
      } else {
        const Vector3d direction = (closest.point_b - closest.point_a).normalized();
        enter(direction, gapAlong(frame, entry.element.shared, direction));
      }
    }
    if (chunk.count > 0) {
      at = &chunk.next;
      continue;
    }
    const std::uint32_t empty = *at;
    *at = chunk.next;
    pool[empty].next = BoundaryPool::kNone;
    pool.release(empty);
  }
  return measured;
}

/// All elements to this pose: their bounds at it are gaps.
void BasinBoundary::rebase(BoundaryPool& pool, const PairFrame& frame) {
  const std::array<Batch, kMostBatches> before = batches_;
  const std::uint32_t count = used_;
  used_ = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Batch& batch = before[i];
    if (batch.first == BoundaryPool::kNone) continue;
    const Bound bound(frame, batch, centres_[batch.fixed_in == Side::A ? 1 : 0]);
    Batch& at_this_pose = batchAt(frame, batch.fixed_in, batch.directed);
    for (std::uint32_t c = batch.first; c != BoundaryPool::kNone;) {
      BoundaryPool::Chunk chunk = pool[c];
      const Row gaps = bound.gapsOf(chunk);
      pool[c].next = BoundaryPool::kNone;
      pool.release(c);
      c = chunk.next;
      for (std::uint32_t k = chunk.count; k-- > 0;) {
        BoundaryPool::Entry entry = takeFrom(chunk, k);
        entry.gap = gaps[k];
        put(pool, at_this_pose, entry);
      }
    }
  }
}

std::uint32_t BasinBoundary::takeCrossed(BoundaryPool& pool, const PairFrame& frame, double level,
                                         WorkLimit& limit) {
  pool.anew.clear();
  pool.crossed.clear();
  pool.has_unmeasured = false;
  std::uint32_t measured = 0;
  for (std::uint32_t i = 0; i < used_; ++i) measured += look(pool, frame, batches_[i], level, limit);
  if (pool.anew.empty()) return measured;
  std::uint32_t rest = 0;
  for (std::uint32_t i = 0; i < used_; ++i) {
    if (batches_[i].first == BoundaryPool::kNone) continue;
    if (i != rest) std::swap(batches_[i], batches_[rest]);
    ++rest;
  }
  used_ = rest;
  if (used_ + 2 > kMostBatches) rebase(pool, frame);
  for (const BoundaryPool::Directed& directed : pool.anew) {
    put(pool, batchAt(frame, directed.fixed_in, true), directed.entry);
  }
  return measured;
}

}  // namespace concave_distance::detail

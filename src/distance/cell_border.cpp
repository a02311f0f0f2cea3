#include "cell_border.h"

#include <algorithm>
#include <cmath>

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using FloatRow = Eigen::Map<const Eigen::ArrayXf>;

/// Batches that the elements of a border are spread over, at most: then all are measured anew.
constexpr std::uint32_t kMostBatches = 8;

/// What single precision may make of a bound, relative to the numbers in it (2^-24 for each of 16 roundings,
/// and as much to spare).
constexpr double kSingleError = 0x1.0p-18;

/// The corners of an element's part on one body, in the body's own axes and the scene's centre.
struct Part {
  std::array<Vector3d, 3> corners;

  double leastAlong(const Vector3d& direction) const {
    return std::min({direction.dot(corners[0]), direction.dot(corners[1]), direction.dot(corners[2])});
  }
  double leverOf(const Vector3d& centre) const {
    return std::sqrt(std::max({(corners[0] - centre).squaredNorm(), (corners[1] - centre).squaredNorm(),
                               (corners[2] - centre).squaredNorm()}));
  }
};

Part partOf(const MinimaScene& scene, Side side, const SharedElement& element) {
  const SurfaceMesh& mesh = (side == Side::A ? scene.a : scene.b).surface();
  const Vector3d& centre = side == Side::A ? scene.frames.centre_a : scene.frames.centre_b;
  if (element.side != side) return {localCorners(mesh, element.other, centre)};
  const Vector3d to = mesh.vertex(element.to) - centre;
  return {{mesh.vertex(element.from) - centre, to, to}};
}

/// A point of the body that moves, as the other sees it.
Vector3d seen(Side fixed_in, const Eigen::Matrix3d& rotation, const Vector3d& offset, const Vector3d& point) {
  return fixed_in == Side::A ? Vector3d(rotation * point + offset)
                             : Vector3d(rotation.transpose() * (point - offset));
}

FloatRow rowOf(const std::vector<float>& row) {
  return {row.data(), static_cast<Eigen::Index>(row.size())};
}

}  // namespace

/// How far an element's parts reach; the body with the shorter lever counts as the one that moves.
struct CellBorder::Levers {
  Levers(const Part& a, const Part& b, const std::array<Vector3d, 2>& centres) {
    const double lever_a = a.leverOf(centres[0]);
    const double lever_b = b.leverOf(centres[1]);
    fixed_in = lever_b <= lever_a ? Side::A : Side::B;
    shorter = static_cast<float>(std::min(lever_a, lever_b));
  }
  Side fixed_in;
  float shorter;
};

void CellBorder::begin(const Vector3d& centre_a, const Vector3d& centre_b) {
  centres_ = {centre_a, centre_b};
  used_ = 0;
}

std::size_t CellBorder::size() const {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < used_; ++i) count += batches_[i].elements.size();
  return count;
}

std::size_t CellBorder::memoryBytes() const {
  std::size_t bytes = batches_.capacity() * sizeof(Batch) + anew_.capacity() * sizeof(Measured) +
                      crossed_.capacity() * sizeof(BorderElement);
  for (const Batch& batch : batches_) {
    bytes +=
        (batch.gap.capacity() + batch.lever.capacity() + 3 * batch.direction[0].capacity()) * sizeof(float) +
        batch.elements.capacity() * sizeof(BorderElement);
  }
  return bytes;
}

CellBorder::Batch& CellBorder::batchAt(const MinimaScene& scene, Side fixed_in, bool directed) {
  for (std::uint32_t i = used_; i-- > 0;) {
    Batch& batch = batches_[i];
    if (batch.fixed_in == fixed_in && batch.directed == directed && batch.rotation == scene.frames.rotation &&
        batch.offset == scene.frames.offset) {
      return batch;
    }
  }
  if (used_ == batches_.size()) batches_.emplace_back();
  Batch& batch = batches_[used_++];
  batch.fixed_in = fixed_in;
  batch.directed = directed;
  batch.rotation = scene.frames.rotation;
  batch.offset = scene.frames.offset;
  batch.longest = 0.0F;
  batch.gap.clear();
  for (std::vector<float>& component : batch.direction) component.clear();
  batch.lever.clear();
  batch.elements.clear();
  return batch;
}

bool CellBorder::add(const MinimaScene& scene, const BorderElement& element, double level, WorkLimit& limit) {
  const Levers levers(partOf(scene, Side::A, element.shared), partOf(scene, Side::B, element.shared),
                      centres_);
  Batch& batch = batchAt(scene, levers.fixed_in, false);
  if (!limit.makeRoom(batch.gap) || !limit.makeRoom(batch.lever) || !limit.makeRoom(batch.elements)) {
    return false;
  }
  batch.gap.push_back(static_cast<float>(level - 2.0 * scene.rounding));
  batch.lever.push_back(levers.shorter);
  batch.longest = std::max(batch.longest, levers.shorter);
  batch.elements.push_back(element);
  return true;
}

bool CellBorder::addDirected(const MinimaScene& scene, const BorderElement& element,
                             const TrianglePairDistance& closest, WorkLimit& limit) {
  const Part part_a = partOf(scene, Side::A, element.shared);
  const Part part_b = partOf(scene, Side::B, element.shared);
  const Levers levers(part_a, part_b, centres_);
  const Vector3d direction = (closest.point_b - closest.point_a).normalized();
  const Vector3d direction_in_b = scene.frames.rotation.transpose() * direction;
  const double gap = part_b.leastAlong(direction_in_b) + direction.dot(scene.frames.offset) +
                     part_a.leastAlong(-direction) - 2.0 * scene.rounding;
  Batch& batch = batchAt(scene, levers.fixed_in, true);
  const Vector3d along = levers.fixed_in == Side::A ? direction : Vector3d(-direction_in_b);
  if (!limit.makeRoom(batch.gap) || !limit.makeRoom(batch.lever) || !limit.makeRoom(batch.elements)) {
    return false;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!limit.makeRoom(batch.direction[k])) return false;
  }
  batch.gap.push_back(static_cast<float>(gap));
  batch.lever.push_back(levers.shorter);
  batch.longest = std::max(batch.longest, levers.shorter);
  for (std::size_t k = 0; k < 3; ++k) {
    batch.direction[k].push_back(static_cast<float>(along[static_cast<Eigen::Index>(k)]));
  }
  batch.elements.push_back(element);
  return true;
}

/// What may be nearer than the level is measured and leaves the batch.
void CellBorder::look(const MinimaScene& scene, Batch& batch, double level) {
  const Eigen::Matrix3d& rotation = scene.frames.rotation;
  const Vector3d& centre = centres_[batch.fixed_in == Side::A ? 1 : 0];
  const Vector3d motion = seen(batch.fixed_in, rotation, scene.frames.offset, centre) -
                          seen(batch.fixed_in, batch.rotation, batch.offset, centre);
  const double turn = (rotation - batch.rotation).norm() * std::sqrt(0.5);
  const double reach = motion.norm();
  double needed = level + 4.0 * scene.rounding;
  needed += kSingleError * (needed + reach + turn * static_cast<double>(batch.longest));
  if (!batch.directed) needed += reach;
  const auto need = static_cast<float>(needed);
  const auto turn_per_lever = static_cast<float>(turn);
  const Eigen::Vector3f along = motion.cast<float>();
  const auto boundOf = [&](std::size_t i) {
    const float undirected = batch.gap[i] - turn_per_lever * batch.lever[i];
    if (!batch.directed) return undirected;
    return undirected + batch.direction[0][i] * along[0] + batch.direction[1][i] * along[1] +
           batch.direction[2][i] * along[2];
  };
  const auto undirected = rowOf(batch.gap) - turn_per_lever * rowOf(batch.lever);
  const float least = batch.directed
                          ? (undirected + along[0] * rowOf(batch.direction[0]) +
                             along[1] * rowOf(batch.direction[1]) + along[2] * rowOf(batch.direction[2]))
                                .minCoeff()
                          : undirected.minCoeff();
  if (least > need) return;
  for (std::size_t i = batch.elements.size(); i-- > 0;) {
    // The two sums above may be rounded differently: one of them has to be clear.
    if (boundOf(i) > need) continue;
    ++measured_;
    const BorderElement element = batch.elements[i];
    const TrianglePairDistance closest = closestOver(scene, element.shared);
    if (closest.squared_distance < level * level) {
      crossed_.push_back(element);
    } else {
      anew_.push_back({element, closest});
    }
    const auto drop = [i](auto& row) {
      row[i] = row.back();
      row.pop_back();
    };
    drop(batch.gap);
    drop(batch.lever);
    if (batch.directed) {
      for (std::vector<float>& component : batch.direction) drop(component);
    }
    drop(batch.elements);
  }
}

const std::vector<BorderElement>& CellBorder::takeCrossed(const MinimaScene& scene, double level) {
  WorkLimit none;
  measured_ = 0;
  anew_.clear();
  crossed_.clear();
  for (std::uint32_t i = 0; i < used_; ++i) {
    if (!batches_[i].elements.empty()) look(scene, batches_[i], level);
  }
  if (anew_.empty()) return crossed_;
  std::uint32_t rest = 0;
  for (std::uint32_t i = 0; i < used_; ++i) {
    if (batches_[i].elements.empty()) continue;
    if (i != rest) std::swap(batches_[i], batches_[rest]);
    ++rest;
  }
  used_ = rest;
  if (used_ + 2 > kMostBatches) {
    for (std::uint32_t i = 0; i < used_; ++i) {
      for (const BorderElement& element : batches_[i].elements) {
        ++measured_;
        anew_.push_back({element, closestOver(scene, element.shared)});
      }
    }
    used_ = 0;
  }
  for (const Measured& measured : anew_) addDirected(scene, measured.element, measured.closest, none);
  return crossed_;
}

}  // namespace concave_distance::detail

#include "contact_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/across_normal.h"
#include "friction_linearisation.h"
#include "patch_gradient.h"

namespace concave_distance {
namespace {

// Sites along the width of a patch, about.
constexpr double kSitesAcross = 8.0;
// Cells change their size when they are this much too large or too small.
constexpr double kCellSlack = 2.5;
// Bristles of other cells go on at a site that is nearer than this many cells.
constexpr double kBristleReach = 2.0;
// A patch pushes one way while its pressures add up to this share of their sum, and any way below the second.
constexpr double kOneWay = 0.5;
constexpr double kAnyWay = 0.3;

double cellSize(double area, double now) {
  const double wanted = std::sqrt(area) / kSitesAcross;
  if (now > wanted / kCellSlack && now < wanted * kCellSlack) return now;
  return std::exp2(std::round(std::log2(wanted)));
}

/// The axis that the push is nearest to, with its sign, and a cell of the plane across it: the two walls of a
/// slot do not share a site, the two surfaces of one contact do. Places and pushes at round numbers are
/// common, so that no limit between cells is at one: else rounding would decide.
std::uint64_t cellOf(const Eigen::Vector3d& point, const Eigen::Vector3d& push, double size) {
  constexpr double kOffset = 0.381966;
  constexpr std::int64_t kHalf = 1 << 29;
  Eigen::Index axis = 0;
  push.cwiseAbs().cwiseProduct(Eigen::Vector3d(1.0, 1.03, 1.07)).maxCoeff(&axis);
  std::uint64_t key = static_cast<std::uint64_t>(2 * axis + (push[axis] < 0.0 ? 1 : 0));
  for (const Eigen::Index across : {(axis + 1) % 3, (axis + 2) % 3}) {
    const double cell = std::clamp(std::floor(point[across] / size + kOffset), -static_cast<double>(kHalf),
                                   static_cast<double>(kHalf - 1));
    key = key << 30U | static_cast<std::uint64_t>(static_cast<std::int64_t>(cell) + kHalf);
  }
  return key;
}

std::uint64_t wayOf(std::uint64_t cell) {
  return cell >> 60U;
}

/// Adds the sums of one share to those of another.
void join(const PatchSite& share, PatchSite& sum) {
  sum.point_in_a += share.point_in_a;
  sum.push_in_a += share.push_in_a;
  sum.force += share.force;
  sum.stiffness += share.stiffness;
  sum.damping += share.damping;
}

/// B has come out of A on the side away from where it entered, or A of B.
bool isPierced(const Eigen::Vector3d* first_loop, const Eigen::Vector3d* last_loop,
               const Eigen::Vector3d& entered) {
  return std::any_of(first_loop, last_loop,
                     [&](const Eigen::Vector3d& area) { return area.dot(entered) < -kOneWay * area.norm(); });
}

/// The nearest bristles that are pushed the same way.
class NearestBristles {
 public:
  NearestBristles(const PatchSite& site, double cell_size) : site_(site), cell_size_(cell_size) {}
  void consider(const SiteBristles& known, double cell_size) {
    const double reach = kBristleReach * std::max(cell_size, cell_size_);
    const double squared_distance = (known.point_in_a - site_.point_in_a).squaredNorm();
    if (wayOf(known.cell) != wayOf(site_.cell) || squared_distance > std::min(least_, reach * reach)) return;
    least_ = squared_distance;
    nearest_ = &known.bristles;
  }
  const BristleState* found() const { return nearest_; }

 private:
  const PatchSite& site_;
  double cell_size_;
  double least_ = std::numeric_limits<double>::infinity();
  const BristleState* nearest_ = nullptr;
};

/// @param last_cell_size of the bristles in `memory`
const BristleState* findBristles(const PatchMemory& memory, double last_cell_size, const PatchSite& site) {
  if (last_cell_size == memory.cell_size) {
    const auto found =
        std::lower_bound(memory.bristles.begin(), memory.bristles.end(), site.cell,
                         [](const SiteBristles& known, std::uint64_t cell) { return known.cell < cell; });
    return found != memory.bristles.end() && found->cell == site.cell ? &found->bristles : nullptr;
  }
  NearestBristles nearest(site, memory.cell_size);
  for (const SiteBristles& known : memory.bristles) nearest.consider(known, last_cell_size);
  return nearest.found();
}

/// Of the same cell, or the nearest: the surfaces are cut into other samples where a region splits.
const BristleState* findLoose(const std::vector<LooseBristles>& loose, double cell_size,
                              const PatchSite& site) {
  NearestBristles nearest(site, cell_size);
  for (const LooseBristles& known : loose) {
    if (known.cell_size == cell_size && known.site.cell == site.cell) return &known.site.bristles;
    nearest.consider(known.site, known.cell_size);
  }
  return nearest.found();
}

}  // namespace

PatchPressure ContactPatch::press(const PatchSurfaces& surfaces, const NormalForceSettings& settings,
                                  const ContactMaterial& material, const RelativeTwist& b_in_a,
                                  PatchMemory& memory, ContactLinearisation& linearisation) {
  const PatchMeasure patch = measurePatch(surfaces.first_sample, surfaces.last_sample, surfaces.depth);
  const PressureLaw law = pressureLaw(settings, material, patch);
  PatchPressure result;
  // Then surfaces that would push B out on the far side carry no pressure.
  const bool pierced = isPierced(surfaces.first_loop, surfaces.last_loop, memory.entered_in_a);
  const double cell_size = patch.area > 0.0 ? cellSize(patch.area, memory.cell_size) : memory.cell_size;
  last_cell_size_ = memory.cell_size;
  memory.cell_size = cell_size;
  field_ = {law.stiffness, law.damping, b_in_a, Eigen::Vector3d::Zero()};
  if (pierced) field_.entered_in_a = memory.entered_in_a;
  shares_.clear();
  PatchGradient gradient;
  gradient.depth = wrenchRow(surfaces.exit_in_a, surfaces.deepest_in_a);
  for (const OverlapSample* sample = surfaces.first_sample; sample != surfaces.last_sample; ++sample) {
    const Eigen::Vector3d& push = sample->push_in_a;
    if (!field_.carries(push)) continue;
    gradient.add(*sample);
    const double rate = field_.depthRate(sample->point_in_a, sample->exit_in_a);
    const double per_depth = field_.perDepth(rate);
    const double pressure = per_depth * sample->depth;
    result.largest_pressure = std::max(result.largest_pressure, pressure);
    const double force = sample->area * pressure;
    const double along = std::max(0.0, push.dot(sample->exit_in_a));
    result.force += force;
    result.centre_in_a += force * sample->point_in_a;
    result.depth_rate += force * rate;
    result.on_b_in_a += wrenchAbout(force * push, sample->point_in_a, Eigen::Vector3d::Zero());
    addShare({cellOf(sample->point_in_a, push, cell_size), force * sample->point_in_a, force * push, force,
              sample->area * per_depth * along, sample->area * law.damping * sample->depth * along});
  }
  if (result.force > 0.0) {
    result.centre_in_a /= result.force;
    result.depth_rate /= result.force;
    const double one_way = result.on_b_in_a.force.norm() / result.force;
    if (!pierced && one_way >= kOneWay) memory.entered_in_a = result.on_b_in_a.force.normalized();
    if (!pierced && one_way < kAnyWay) memory.entered_in_a.setZero();
  }
  addChangeOfLaw(law, gradient, patch.moment, linearisation.stiffness);
  gatherSites();
  for (const PatchSite& site : sites_) {
    addDirection(site.stiffness, site.push_in_a, site.point_in_a, linearisation.stiffness);
    addDirection(site.damping, site.push_in_a, site.point_in_a, linearisation.damping);
  }
  return result;
}

// Neighbours in the list often share a cell.
void ContactPatch::addShare(const PatchSite& share) {
  if (!shares_.empty() && shares_.back().cell == share.cell) {
    join(share, shares_.back());
  } else {
    shares_.push_back(share);
  }
}

void ContactPatch::gatherSites() {
  order_.clear();
  for (const PatchSite& share : shares_)
    order_.emplace_back(share.cell, static_cast<std::uint32_t>(order_.size()));
  std::sort(order_.begin(), order_.end());
  sites_.clear();
  for (auto next = order_.begin(); next != order_.end();) {
    PatchSite sum = shares_[next->second];
    for (++next; next != order_.end() && next->first == sum.cell; ++next) join(shares_[next->second], sum);
    const double length = sum.push_in_a.norm();
    if (!(sum.force > 0.0 && length > 0.0)) continue;
    sum.point_in_a /= sum.force;
    sum.push_in_a /= length;
    sum.stiffness = std::max(0.0, sum.stiffness);
    sum.damping = std::max(0.0, sum.damping);
    sites_.push_back(sum);
  }
}

Wrench ContactPatch::rub(const FrictionSettings& settings, const ContactMaterial& material,
                         const PatchMotion& motion, const std::vector<LooseBristles>& loose,
                         PatchMemory& memory, ContactLinearisation& linearisation) {
  next_.clear();
  if (next_.capacity() < sites_.size()) next_.reserve(2 * sites_.size());
  Wrench wrench;
  for (const PatchSite& site : sites_) {
    const BristleState* known = findBristles(memory, last_cell_size_, site);
    if (known == nullptr && !loose.empty()) known = findLoose(loose, memory.cell_size, site);
    SiteBristles& now = next_.emplace_back(
        SiteBristles{site.cell, site.point_in_a, known != nullptr ? *known : BristleState()});
    const Eigen::Vector3d& normal = site.push_in_a;
    const Eigen::Vector3d sliding = acrossNormal(normal, motion.b_in_a.at(site.point_in_a));
    const Eigen::Vector3d shift = acrossNormal(normal, motion.displacement.at(site.point_in_a));
    const Eigen::Vector3d force =
        frictionForce(settings, material, site.force, normal, sliding, shift, now.bristles);
    wrench += wrenchAbout(force, site.point_in_a, Eigen::Vector3d::Zero());
    const FrictionTangent tangent =
        frictionTangent(settings, material, site.force, normal, sliding, {shift, motion.step, now.bristles});
    addFriction(tangent, site.point_in_a, linearisation);
  }
  refill(memory.bristles, next_);
  return wrench;
}

}  // namespace concave_distance

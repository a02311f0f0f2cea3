#include "contact_patch.h"

#include <algorithm>
#include <limits>

#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/interference/interference.h"
#include "patch_cells.h"
#include "pressure_law.h"

namespace concave_distance {
namespace {

// The decrease is at most this share of the largest that leaves the stiffness positive.
constexpr double kLargestDecrease = 0.9;

/// Says how the measures of a patch change with a small motion of B: minus their derivatives,
/// about A's origin.
struct PatchGradient {
  Vector6d push = Vector6d::Zero();  ///< integral of the depth along the push: the wrench over the stiffness
  Vector6d volume = Vector6d::Zero();  ///< m^2, m^3
  Vector6d moment = Vector6d::Zero();  ///< m^3, m^4
  Vector6d depth = Vector6d::Zero();   ///< of the greatest depth: 1 (shift), m (turn)

  void add(const OverlapSample& sample);
};

void PatchGradient::add(const OverlapSample& sample) {
  const Vector6d out = sample.area * wrenchRow(sample.exit_in_a, sample.point_in_a);
  push += sample.area * sample.depth * wrenchRow(sample.push_in_a, sample.point_in_a);
  volume += out;
  moment += sample.depth * out;
}

/// Adds what the change of the law's own stiffness brings. It is taken along the patch's push, where round
/// contact has all of it, and no more of a decrease than leaves the sum with the pressure's own stiffness
/// positive: by Cauchy's inequality push push^T is at most twice the moment times the integral of e e^T, e
/// the push at a place.
void addChangeOfLaw(const PressureLaw& law, const PatchGradient& gradient, double moment,
                    Matrix6d& stiffness) {
  const double squared_push = gradient.push.head<3>().squaredNorm();
  if (!(squared_push > 0.0 && moment > 0.0)) return;
  const Vector6d change =
      law.by_volume * gradient.volume + law.by_moment * gradient.moment + law.by_depth * gradient.depth;
  const double along = std::max(change.head<3>().dot(gradient.push.head<3>()) / squared_push,
                                -0.5 * kLargestDecrease / moment);
  stiffness.triangularView<Eigen::Upper>() +=
      law.stiffness * along * gradient.push * gradient.push.transpose();
}

// Cells of friction along a cell of the pressure's stiffness, whose width is lost in the latter.
constexpr double kSpringsAcross = 2.0;
// Bristles of other cells go on at a site that is nearer than this many cells.
constexpr double kBristleReach = 2.0;
// A patch pushes one way while its pressures add up to this share of their sum, and any way below the second.
constexpr double kOneWay = 0.5;
constexpr double kAnyWay = 0.3;

/// B has come out of A on the side away from where it entered, or A of B.
bool isPierced(const Eigen::Vector3d* first_loop, const Eigen::Vector3d* last_loop,
               const Eigen::Vector3d& entered) {
  return std::any_of(first_loop, last_loop,
                     [&](const Eigen::Vector3d& area) { return area.dot(entered) < -kOneWay * area.norm(); });
}

/// The nearest bristles that are pushed the same way.
class NearestBristles {
 public:
  NearestBristles(const FrictionSite& site, double cell_size) : site_(site), cell_size_(cell_size) {}
  void consider(const SiteBristles& known, double cell_size) {
    const double reach = kBristleReach * std::max(cell_size, cell_size_);
    const double squared_distance = (known.point_in_a - site_.point_in_a).squaredNorm();
    if (directionOf(known.cell) != directionOf(site_.cell) ||
        squared_distance > std::min(least_, reach * reach))
      return;
    least_ = squared_distance;
    nearest_ = &known;
  }
  const SiteBristles* found() const { return nearest_; }

 private:
  const FrictionSite& site_;
  double cell_size_;
  double least_ = std::numeric_limits<double>::infinity();
  const SiteBristles* nearest_ = nullptr;
};

/// Returns the bristles that the cell of this site had.
const SiteBristles* findBristles(const PatchMemory& memory, const FrictionSite& site) {
  const auto found =
      std::lower_bound(memory.bristles.begin(), memory.bristles.end(), site.cell,
                       [](const SiteBristles& known, std::uint64_t cell) { return known.cell < cell; });
  return found != memory.bristles.end() && found->cell == site.cell ? &*found : nullptr;
}

/// Returns the bristles of the nearest cell. A body that rolls on under a force would creep if the cells that
/// it comes to began unbent. @param last_cell_size of the bristles in `memory`
const SiteBristles* findNearest(const PatchMemory& memory, double last_cell_size, const FrictionSite& site) {
  NearestBristles nearest(site, memory.cell_size);
  for (const SiteBristles& known : memory.bristles) nearest.consider(known, last_cell_size);
  return nearest.found();
}

/// Looks for the same cell, or the nearest: the surfaces are cut into other samples where a region splits.
const SiteBristles* findLoose(const std::vector<UnmatchedBristles>& loose, double cell_size,
                              const FrictionSite& site) {
  NearestBristles nearest(site, cell_size);
  for (const UnmatchedBristles& known : loose) {
    if (known.cell_size == cell_size && known.site.cell == site.cell) return &known.site;
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
  springs_.clear();
  first_sample_ = surfaces.first_sample;
  last_sample_ = surfaces.last_sample;
  refill(forces_, static_cast<std::size_t>(last_sample_ - first_sample_), 0.0);
  PatchGradient gradient;
  gradient.depth = wrenchRow(surfaces.exit_in_a, surfaces.deepest_in_a);
  for (const OverlapSample* sample = surfaces.first_sample; sample != surfaces.last_sample; ++sample) {
    const Eigen::Vector3d& push = sample->push_in_a;
    if (!field_.carries(push)) continue;
    if (law.dependsOnPatch()) gradient.add(*sample);
    const double rate = field_.approachRate(sample->point_in_a, push, sample->exit_in_a);
    const double per_depth = field_.perDepth(rate);
    const double pressure = per_depth * sample->depth;
    result.largest_pressure = std::max(result.largest_pressure, pressure);
    const double force = sample->area * pressure;
    forces_[static_cast<std::size_t>(sample - first_sample_)] = force;
    const double share = push.dot(sample->exit_in_a);
    const double along = std::max(0.0, share);
    result.force += force;
    result.centre_in_a += force * sample->point_in_a;
    result.depth_rate += force * rate;
    result.on_b_in_a += wrenchAbout(force * push, sample->point_in_a, Eigen::Vector3d::Zero());
    springs_.add({cellOf(sample->point_in_a, push, cell_size / kSpringsAcross), force,
                  force * sample->point_in_a, force * push, sample->area * per_depth * along,
                  sample->area * law.damping * sample->depth * share * share});
  }
  if (result.force > 0.0) {
    result.centre_in_a /= result.force;
    result.depth_rate /= result.force;
    const double one_way = result.on_b_in_a.force.norm() / result.force;
    if (!pierced && one_way >= kOneWay) memory.entered_in_a = result.on_b_in_a.force.normalized();
    if (!pierced && one_way < kAnyWay) memory.entered_in_a.setZero();
  }
  if (law.dependsOnPatch()) addChangeOfLaw(law, gradient, patch.moment, linearisation.stiffness);
  springs_.forEach([&](const Spring& sum) { addSpring(sum, linearisation); });
  return result;
}

void ContactPatch::addSpring(const Spring& sum, ContactLinearisation& linearisation) {
  const double length = sum.push.norm();
  if (!(sum.force > 0.0 && length > 0.0)) return;
  const Eigen::Vector3d push = sum.push / length;
  const Eigen::Vector3d place = sum.place / sum.force;
  addDirection(std::max(0.0, sum.stiffness), push, place, linearisation.stiffness);
  addDirection(std::max(0.0, sum.damping), push, place, linearisation.damping);
}

Wrench ContactPatch::rub(const FrictionSettings& settings, const ContactMaterial& material,
                         const PatchMotion& motion, const std::vector<UnmatchedBristles>& loose,
                         PatchMemory& memory, ContactLinearisation& linearisation) {
  sites_.gather(first_sample_, last_sample_, forces_, memory.cell_size);
  next_.clear();
  if (next_.capacity() < sites_.all().size()) next_.reserve(2 * sites_.all().size());
  Wrench wrench;
  for (const FrictionSite& site : sites_.all()) {
    const bool same_cells = last_cell_size_ == memory.cell_size;
    const SiteBristles* known =
        same_cells ? findBristles(memory, site) : findNearest(memory, last_cell_size_, site);
    if (known == nullptr && !loose.empty()) known = findLoose(loose, memory.cell_size, site);
    if (known == nullptr && same_cells) known = findNearest(memory, last_cell_size_, site);
    SiteBristles& now = next_.emplace_back(SiteBristles{site.cell, site.point_in_a, BristleState(), 0.0});
    if (known != nullptr) {
      now.bristles = known->bristles;
      now.spun = known->spun;
    }
    wrench += siteFriction(settings, material, site, motion, now, linearisation);
  }
  refill(memory.bristles, next_);
  return wrench;
}

}  // namespace concave_distance

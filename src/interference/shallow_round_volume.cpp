#include "shallow_round_volume.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "mesh/surface/round_geometry.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

/// (r / x)^power, with what is at the core itself left out.
double ratio(double radius, double distance, int power) {
  if (!(distance > 1e-9 * radius)) return 0.0;
  const double share = radius / distance;
  double product = share;
  for (int k = 1; k < power; ++k) product *= share;
  return product;
}

}  // namespace

void ShallowRoundVolume::add(const RoundSample& sample) {
  const Vector3d& p = sample.point;
  if (hasFlatEnds(shape_)) {
    flux_outward_ += sample.area * p.head<2>().dot(sample.normal.head<2>()) / shape_.radius;
    flux_along_ += sample.area * p.z() * sample.normal.z() / shape_.half_length;
    if (side_ != 0) {
      addAlong(sample);
    } else {
      addAcross(sample);
    }
    return;
  }
  const Vector3d core = corePoint(shape_, p);
  flux_outward_ += sample.area * (p - core).dot(sample.normal) / shape_.radius;
  if (std::abs(p.z()) < shape_.half_length) {
    addAcross(sample);
  } else {
    addBall(sample, core);
  }
}

void ShallowRoundVolume::addBall(const RoundSample& sample, const Vector3d& centre) {
  const Vector3d y = sample.point - centre;
  const double flux = sample.area * y.dot(sample.normal);
  const double distance = y.norm();
  const double volume = flux / 3.0 * (1.0 - ratio(shape_.radius, distance, 3));
  ends_ += volume;
  moment_ += volume * centre + 0.25 * flux * (1.0 - ratio(shape_.radius, distance, 4)) * y;
}

void ShallowRoundVolume::addAcross(const RoundSample& sample) {
  const Vector3d& p = sample.point;
  const double flux = sample.area * p.head<2>().dot(sample.normal.head<2>());
  const double rho = std::hypot(p.x(), p.y());
  const double volume = 0.5 * flux * (1.0 - ratio(shape_.radius, rho, 2));
  middle_ += volume;
  moment_.head<2>() += flux / 3.0 * (1.0 - ratio(shape_.radius, rho, 3)) * p.head<2>();
  moment_.z() += volume * p.z();
}

void ShallowRoundVolume::addAlong(const RoundSample& sample) {
  const Vector3d& p = sample.point;
  const double flux = sample.area * sample.normal.z();
  const double volume = flux * (p.z() - side_ * shape_.half_length);
  middle_ += volume;
  moment_.head<2>() += volume * p.head<2>();
  moment_.z() += 0.5 * flux * (p.z() * p.z() - shape_.half_length * shape_.half_length);
}

void ShallowRoundVolume::addCore(double from, double to) {
  const double r = shape_.radius;
  const double h = shape_.half_length;
  const double disc = kPi * r * r;
  if (!hasSide(shape_)) {
    ends_ += 4.0 / 3.0 * disc * r;
  } else if (side_ != 0) {
    if (from < 0.0 && to > 0.0) middle_ += 2.0 * h * disc;
  } else {
    middle_ += disc * (to - from);
    moment_.z() += 0.5 * disc * (to * to - from * from);
    if (hasFlatEnds(shape_)) return;
    for (const double end : {-1.0, 1.0}) {
      if (end < 0.0 ? from > -h : to < h) continue;
      ends_ += 2.0 / 3.0 * disc * r;
      moment_.z() += end * (0.25 * disc * r * r + 2.0 / 3.0 * disc * r * h);
    }
  }
}

// By the flux of fields that leave the solid straight: what does not leave through the mesh does so there.
double ShallowRoundVolume::area() const {
  const double around = (3.0 * ends_ + 2.0 * middle_) / shape_.radius - flux_outward_;
  const double caps = hasFlatEnds(shape_) ? middle_ / shape_.half_length - flux_along_ : 0.0;
  return std::max(0.0, around + caps);
}

}  // namespace concave_distance::detail

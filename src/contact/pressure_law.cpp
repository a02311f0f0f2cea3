#include "pressure_law.h"

#include <cmath>

#include "base/constants.h"

namespace concave_distance {
namespace {

/// A paraboloid pressed into a plane: volume pi R d^2, moment pi R d^3 / 3.
double hertzOverVolume(double contact_modulus, double given_radius, const PatchMeasure& patch) {
  double radius = given_radius;
  double depth = std::cbrt(3.0 * patch.moment / (kPi * radius));
  if (!(given_radius > 0.0)) {
    depth = 3.0 * patch.moment / patch.volume;
    radius = patch.volume / (kPi * depth * depth);
  }
  return hertzForce(depth, contact_modulus, radius) / patch.volume;
}

// The force goes with the root of the moment, whether the radius is given or that of the overlap.
PressureLaw hertzLaw(double stiffness, double rate, const PatchMeasure& patch) {
  return {stiffness, rate * stiffness, -1.0 / patch.volume, 0.5 / patch.moment, 0.0};
}

/// A force of `stiffness` times the greatest depth. @param power of the volume that the pressure goes with
PressureLaw overDepth(double stiffness, double damping, double power, const PatchMeasure& patch) {
  return {stiffness * patch.depth / patch.volume, damping / patch.volume, power / patch.volume, 0.0,
          patch.depth > 0.0 ? 1.0 / patch.depth : 0.0};
}

}  // namespace

PatchMeasure measurePatch(const OverlapSample* first, const OverlapSample* last, double depth) {
  PatchMeasure patch;
  patch.depth = depth;
  for (const OverlapSample* sample = first; sample != last; ++sample) {
    patch.area += sample->area;
    patch.volume += sample->area * sample->depth;
    patch.moment += 0.5 * sample->area * sample->depth * sample->depth;
  }
  return patch;
}

PressureLaw pressureLaw(const NormalForceSettings& settings, const ContactMaterial& material,
                        const PatchMeasure& patch) {
  if (!(patch.volume > 0.0 && patch.moment > 0.0 && patch.area > 0.0)) return {};
  const double rate = 1.5 * material.dissipation;
  switch (settings.model) {
    case NormalForceModel::QuasiStatic: {
      const double contact_radius = std::sqrt(patch.area / kPi);
      const double stiffness = settings.loading_coefficient * material.contact_modulus * contact_radius;
      // The area grows with the root of the volume, as where a ball is pressed in, or less.
      return overDepth(stiffness, settings.damping, -0.75, patch);
    }
    case NormalForceModel::SpringDashpot:
      return overDepth(settings.stiffness, settings.damping, -1.0, patch);
    case NormalForceModel::Hertz:
      return hertzLaw(hertzOverVolume(material.contact_modulus, settings.radius, patch), 0.0, patch);
    case NormalForceModel::HuntCrossley:
      return hertzLaw(hertzOverVolume(material.contact_modulus, settings.radius, patch), rate, patch);
    case NormalForceModel::ElasticFoundation:
      return {settings.foundation_stiffness, rate * settings.foundation_stiffness};
  }
  return {};
}

}  // namespace concave_distance

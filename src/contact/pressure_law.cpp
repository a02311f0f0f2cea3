#include "pressure_law.h"

#include <cmath>

namespace concave_distance {
namespace {

constexpr double kPi = 3.14159265358979323846;

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
      return {stiffness * patch.depth / patch.volume, settings.damping / patch.volume};
    }
    case NormalForceModel::SpringDashpot:
      return {settings.stiffness * patch.depth / patch.volume, settings.damping / patch.volume};
    case NormalForceModel::Hertz:
      return {hertzOverVolume(material.contact_modulus, settings.radius, patch), 0.0};
    case NormalForceModel::HuntCrossley: {
      const double stiffness = hertzOverVolume(material.contact_modulus, settings.radius, patch);
      return {stiffness, rate * stiffness};
    }
    case NormalForceModel::ElasticFoundation:
      return {settings.foundation_stiffness, rate * settings.foundation_stiffness};
  }
  return {};
}

}  // namespace concave_distance

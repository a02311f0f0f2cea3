#pragma once

#include "concave_distance/contact/material.h"
#include "concave_distance/contact/normal_force.h"
#include "concave_distance/interference/interference.h"

namespace concave_distance {

/// Holds what a normal force depends on of the surfaces of one overlap.
struct PatchMeasure {
  double depth = 0.0;   ///< the greatest, metres
  double area = 0.0;    ///< m^2, mean of both surfaces
  double volume = 0.0;  ///< integral of the depth over the surface, m^3
  double moment = 0.0;  ///< half of the integral of its square, m^4
};

PatchMeasure measurePatch(const OverlapSample* first, const OverlapSample* last, double depth);

/// Pressure at a place: depth * max(0, stiffness + damping * PressureField::approachRate()).
struct PressureLaw {
  double stiffness = 0.0;  ///< Pa/m
  double damping = 0.0;    ///< Pa s/m^2
  /// Relative derivatives of the stiffness by the patch's measures: 1/m^3, 1/m^4, 1/m.
  double by_volume = 0.0;
  double by_moment = 0.0;
  double by_depth = 0.0;

  bool dependsOnPatch() const { return by_volume != 0.0 || by_moment != 0.0 || by_depth != 0.0; }
};

/// Returns the pressure of a model on a patch, shared out in proportion to the depth so that a round contact
/// has the model's force. An elastic foundation has its own stiffness everywhere, which makes its force the
/// gradient of a potential, half of the integral of the depth over the overlap for either surface; of an
/// exact round body all of that below its surface. Hertz takes radius and depth of the paraboloid with the
/// same volume and moment; its force 1.30 E* sqrt(moment) is that of a flat punch (Johnson 1985, eq. (3.36))
/// but for 18 %.
PressureLaw pressureLaw(const NormalForceSettings& settings, const ContactMaterial& material,
                        const PatchMeasure& patch);

}  // namespace concave_distance

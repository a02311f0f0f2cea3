#pragma once

#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/tracking/pair_effects.h"

namespace concave_distance {

/// Adds a region with one force. The stiffness along the normal is spread
/// over the region's width: where flat faces rock, the centroid moves, and with it the force.
void addLumpedContact(const EffectSettings& settings, const ContactMaterial& material,
                      const ContactRegion& region, const RecentSliding& recent,
                      ContactLinearisation& linearisation);

}  // namespace concave_distance

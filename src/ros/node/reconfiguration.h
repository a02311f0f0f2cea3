#pragma once

#include <concave_distance/ConcaveDistanceConfig.h>

#include "concave_distance/scene/scene.h"
#include "node_parameters.h"

namespace concave_distance {

/// The reconfigurable part of the parameters.
ConcaveDistanceConfig toConfig(const NodeParameters& parameters);

/// Writes a cutoff that the node has chosen, metres; infinite: none.
void setCutoff(ConcaveDistanceConfig& config, double cutoff);
/// The ranges, for clients to display.
ConcaveDistanceConfig lowestConfig();
ConcaveDistanceConfig highestConfig();

/// @throws Error naming the parameter, the value seen and what is allowed
void checkConfig(const ConcaveDistanceConfig& config);

/// Applies to a pair what differs between the two configurations, and nothing else: what a scene file says of
/// a pair stays until somebody changes that value.
void applyChanges(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after,
                  PairSettings& settings);
/// Changes all pairs of a scene and its defaults in the same way.
void applyChanges(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after, Scene& scene);

/// The same when a client asks for it. @throws Error for what the next start would refuse, when it finds
/// `after` on the parameter server
void applyRequest(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after,
                  PairSettings& settings);

/// True when `after` differs from `before` in a value that pairs are configured with.
bool concernsPairs(const ConcaveDistanceConfig& before, const ConcaveDistanceConfig& after);

}  // namespace concave_distance

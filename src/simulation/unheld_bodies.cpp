#include "unheld_bodies.h"

#include <algorithm>

#include "mesh/surface/mesh_topology.h"

namespace concave_distance::detail {
namespace {

bool isHeld(const SimulatedBodySettings& settings) {
  return settings.motion != BodyMotion::Free || settings.drive.has_value() || !settings.loads.empty();
}

/// Open surfaces alone have no depth, and no force.
bool hasClosedShell(const SceneBody& body) {
  const std::vector<bool>& closed = body.mesh->topology().shell_is_closed;
  return std::find(closed.begin(), closed.end(), true) != closed.end();
}

bool bringsForce(const Scene& scene, const ScenePair& pair) {
  return pair.enabled && pair.settings.effects.normal_force && hasClosedShell(scene.bodies[pair.body_a]) &&
         hasClosedShell(scene.bodies[pair.body_b]);
}

}  // namespace

std::vector<std::string> warnOfUnheldBodies(const Scene& scene, const SimulationSettings& settings) {
  std::vector<std::string> warnings;
  if (settings.gravity.isZero(0.0)) return warnings;
  std::vector<bool> held(scene.bodies.size(), true);  // what the section does not name is fixed
  for (const SimulatedBodySettings& body : settings.bodies) {
    if (const auto index = scene.findBody(body.body)) held[*index] = isHeld(body);
  }
  for (bool spreads = true; spreads;) {
    spreads = false;
    for (const ScenePair& pair : scene.pairs) {
      if (held[pair.body_a] == held[pair.body_b] || !bringsForce(scene, pair)) continue;
      held[pair.body_a] = held[pair.body_b] = spreads = true;
    }
  }
  for (const SimulatedBodySettings& body : settings.bodies) {
    const auto index = scene.findBody(body.body);
    if (!index || held[*index]) continue;
    warnings.push_back((body.where.empty() ? "" : body.where + ": ") + "body '" + body.body +
                       "' falls for good: no enabled pair with a normal_force leads to a body that is held; "
                       "give such a pair `effects: {normal_force: ...}`, give the body a drive, or fix it");
  }
  return warnings;
}

}  // namespace concave_distance::detail

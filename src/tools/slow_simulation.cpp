#include "slow_simulation.h"

#include <algorithm>
#include <locale>
#include <sstream>

namespace concave_distance::tools {
namespace {

// A contact or drive that has shortened this share of the steps is the cause.
constexpr double kMost = 0.5;

struct Cause {
  std::uint64_t steps = 0;
  std::string who;
  std::string how;
  std::string remedy;
};

void take(const Cause& other, Cause& most) {
  if (other.steps > most.steps) most = other;
}

std::string contactOf(const SimulatedPair& pair) {
  return "contact '" + pair.name + "'";
}

Cause mostSteps(const Simulation& simulation) {
  const SimulationSettings& settings = simulation.settings();
  Cause most;
  std::ostringstream accuracy;
  accuracy.imbue(std::locale::classic());
  accuracy << "give its bodies a smaller youngs_modulus (or its force a smaller stiffness), or raise "
              "work_tolerance ("
           << settings.work_tolerance << ") or step_fraction (" << settings.step_fraction << ")";
  for (const SimulatedPair& pair : simulation.pairs()) {
    take({pair.held_back_by_accuracy, contactOf(pair), "as short as its accuracy asks", accuracy.str()},
         most);
    take({pair.held_back_by_distance, contactOf(pair), "as short as its depth and speed allow",
          "set allowed_penetration to the thickness of the thinnest part of the scene, or give its bodies a "
          "smaller youngs_modulus"},
         most);
  }
  for (const SimulatedBody& body : simulation.bodies()) {
    take({body.held_back_by_drive, "the drive of '" + body.name + "'", "as short as its accuracy asks",
          "give it a smaller stiffness"},
         most);
  }
  return most;
}

std::string costliestPair(const Simulation& simulation, double wall_seconds) {
  const std::vector<SimulatedPair>& pairs = simulation.pairs();
  const auto most = std::max_element(pairs.begin(), pairs.end(),
                                     [](const auto& l, const auto& r) { return l.seconds < r.seconds; });
  if (most == pairs.end()) return "";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(2);
  text << contactOf(*most) << " took " << 100.0 * most->seconds / wall_seconds
       << " % of it, in steps that it did not shorten; use coarser meshes, `sphere`, `cylinder` or `capsule` "
          "for "
          "what is round, and tracking: single_minimum";
  return text.str();
}

}  // namespace

std::string whatHeldBack(const Simulation& simulation, double wall_seconds) {
  const double factor = simulation.time() / wall_seconds;
  const std::uint64_t steps = simulation.counters().steps;
  if (!(factor < kSlow) || steps == 0) return "";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(2);
  text << factor << " of real time: ";
  const Cause cause = mostSteps(simulation);
  const double share = static_cast<double>(cause.steps) / static_cast<double>(steps);
  if (share < kMost) {
    text << costliestPair(simulation, wall_seconds);
    return text.str();
  }
  text << cause.who << " held it back: " << 100.0 * share << " % of the steps are " << cause.how << ", "
       << simulation.time() / static_cast<double>(steps) << " s on average; " << cause.remedy;
  return text.str();
}

}  // namespace concave_distance::tools

#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <string>

#include "concave_distance/scene/scene.h"
#include "move_report.h"
#include "ros/tf/transform_receiver.h"
#include "scene/cycle_statistics.h"

namespace concave_distance {

/// Cycle time, achieved and wanted rate, late cycles, processor time, latency. WARN when more than 1 % of the
/// cycles were late or the rate fell below 90 %; ERROR when exceptions ended cycles.
void describeCycle(const CycleWindow& window, double wanted_rate,
                   diagnostic_updater::DiagnosticStatusWrapper& status);
/// Pairs watched and solved, pairs without transforms (WARN, each with its reason), search misses.
void describePairs(const CycleWindow& window, diagnostic_updater::DiagnosticStatusWrapper& status);
/// Frames known and transforms refused (WARN, with the last one's sender and reason).
void describeTransforms(const TransformReport& report, diagnostic_updater::DiagnosticStatusWrapper& status);
/// Moves taken from scene_moves, and those refused (WARN, with the last one's body and reason).
void describeMoves(const MoveReport& report, diagnostic_updater::DiagnosticStatusWrapper& status);
/// Reports how often each stage of the pairs' effects ran and its share of the cycles' processor time.
void describeEffects(const CycleWindow& window, diagnostic_updater::DiagnosticStatusWrapper& status);
/// Bodies, pairs and what could not be loaded (WARN), or what is waited for (WARN).
/// @param changed parameter with a robot's description that has changed since it was loaded (WARN); empty:
///        none
void describeScene(const Scene& scene, const std::string& waiting_for, const std::string& changed,
                   diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace concave_distance

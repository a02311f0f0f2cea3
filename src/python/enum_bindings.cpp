#include <utility>
#include <vector>

#include "bindings.h"
#include "concave_distance/kinematics/clearance.h"
#include "concave_distance/kinematics/constraint_rows.h"
#include "concave_distance/scene/tracked_pair.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance::python {
namespace {

namespace py = pybind11;

template <typename Enum>
void bindEnum(py::module& module, const char* name, const char* doc,
              const std::vector<std::pair<const char*, Enum>>& values) {
  py::list names;
  for (const auto& [word, value] : values) names.append(py::make_tuple(word, static_cast<int>(value)));
  py::object made =
      py::module::import("enum").attr("IntEnum")(name, names, py::arg("module") = "concave_distance");
  made.attr("__doc__") = doc;
  module.attr(name) = made;
}

}  // namespace

void bindEnums(py::module& module) {
  bindEnum<SolveStatus>(
      module, "Status",
      "What became of a solve: column `status`.\n\n"
      "OK: done, at accuracy `certified` proven. PENETRATING: the padded bodies overlap. "
      "INVALID_POSE: nothing was computed. BUDGET_EXHAUSTED, MEMORY_EXHAUSTED: ended early, "
      "lower_bound holds. WITHIN_TOLERANCE: lower_bound is within the tolerance.",
      {{"OK", SolveStatus::Ok},
       {"PENETRATING", SolveStatus::Penetrating},
       {"INVALID_POSE", SolveStatus::InvalidPose},
       {"BUDGET_EXHAUSTED", SolveStatus::BudgetExhausted},
       {"WITHIN_TOLERANCE", SolveStatus::WithinTolerance},
       {"MEMORY_EXHAUSTED", SolveStatus::MemoryExhausted}});
  bindEnum<NicheKind>(
      module, "NicheKind", "Whether a niche is one pair of points or a set of them: column `kind`.",
      {{"POINT", NicheKind::Point}, {"SEGMENT", NicheKind::Segment}, {"PATCH", NicheKind::Patch}});
  bindEnum<Outwardness>(module, "Outwardness",
                        "Where the segment between a niche's points leaves the bodies: column `outward`.",
                        {{"OUTWARD", Outwardness::Outward},
                         {"THROUGH_MATERIAL", Outwardness::ThroughMaterial},
                         {"UNKNOWN", Outwardness::Unknown}});
  bindEnum<NicheOrigin>(module, "NicheOrigin", "What has found a niche in a cycle: column `origin`.",
                        {{"INHERITED", NicheOrigin::Inherited},
                         {"EVOLVED", NicheOrigin::Evolved},
                         {"FROM_CONES", NicheOrigin::FromCones},
                         {"PROVEN", NicheOrigin::Proven}});
  bindEnum<SignedState>(
      module, "SignedState",
      "Whether a niche has a signed value where bodies overlap, or why not: column "
      "`signed_state`.\n\n"
      "NOT_ASKED: signed_values is off. OPEN_SURFACE, CROSSED_SHELLS, NO_CLOSED_FORM: there is no "
      "depth. UNFINISHED: a limit was reached first.",
      {{"NOT_ASKED", SignedState::NotAsked},
       {"KNOWN", SignedState::Known},
       {"OPEN_SURFACE", SignedState::OpenSurface},
       {"CROSSED_SHELLS", SignedState::CrossedShells},
       {"NO_CLOSED_FORM", SignedState::NoClosedForm},
       {"UNFINISHED", SignedState::Unfinished}});
  bindEnum<ClearanceStatus>(
      module, "ClearanceStatus",
      "What is known of the clearance of a motion.\n\n"
      "OK: lower_bound is within the tolerance of the distance. PENETRATING: bodies touch or "
      "overlap at `time`. BUDGET_EXHAUSTED: a limit was reached first, lower_bound holds. "
      "NO_PAIRS: the motion moves no watched pair.",
      {{"OK", ClearanceStatus::Ok},
       {"PENETRATING", ClearanceStatus::Penetrating},
       {"BUDGET_EXHAUSTED", ClearanceStatus::BudgetExhausted},
       {"NO_PAIRS", ClearanceStatus::NoPairs}});
  bindEnum<UnlistedReason>(
      module, "UnlistedReason",
      "Why places of a pair may have no row: Constraints.unlisted.\n\n"
      "NO_POSE: a body has none. UNSOLVED: the pair has no answer. UNFINISHED: its list of niches "
      "is not proven complete. BEYOND_CUTOFF: its cutoff is less than the rows' distance. NO_SLOT: "
      "all slots have nearer rows.",
      {{"NO_POSE", UnlistedReason::NoPose},
       {"UNSOLVED", UnlistedReason::Unsolved},
       {"UNFINISHED", UnlistedReason::Unfinished},
       {"BEYOND_CUTOFF", UnlistedReason::BeyondCutoff},
       {"NO_SLOT", UnlistedReason::NoSlot}});
  bindEnum<SlotState>(
      module, "SlotState",
      "What a slot of constraint rows has: column `state`.\n\n"
      "FREE: no row. USED: one. FREED: its row ended a few cycles ago, and no other begins there "
      "while there is room.",
      {{"FREE", SlotState::Free}, {"USED", SlotState::Used}, {"FREED", SlotState::Freed}});
  bindEnum<PairState>(
      module, "PairState",
      "What a cycle of a scene did with a pair: SceneAnswers.states.\n\n"
      "SOLVED: its row is its answer. BEYOND_CUTOFF: only its bound is known. NOT_LOCATED: a pose "
      "is not known. STOPPED, NOT_WATCHED: nothing was computed.",
      {{"NOT_WATCHED", PairState::NotWatched},
       {"NOT_LOCATED", PairState::NotLocated},
       {"BEYOND_CUTOFF", PairState::BeyondCutoff},
       {"SOLVED", PairState::Solved},
       {"STOPPED", PairState::Stopped}});
}

}  // namespace concave_distance::python

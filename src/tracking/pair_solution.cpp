#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

std::string_view toString(AccuracyLevel level) {
  switch (level) {
    case AccuracyLevel::Nodes:
      return "nodes";
    case AccuracyLevel::Refined:
      return "refined";
    case AccuracyLevel::Certified:
      return "certified";
  }
  return "unknown";
}

std::string_view toString(NicheOrigin origin) {
  switch (origin) {
    case NicheOrigin::Inherited:
      return "inherited";
    case NicheOrigin::Evolved:
      return "evolved";
    case NicheOrigin::FromCones:
      return "from_cones";
    case NicheOrigin::Proven:
      return "proven";
  }
  return "unknown";
}

std::string_view toString(SolveStatus status) {
  switch (status) {
    case SolveStatus::Ok:
      return "ok";
    case SolveStatus::Penetrating:
      return "penetrating";
    case SolveStatus::InvalidPose:
      return "invalid_pose";
    case SolveStatus::BudgetExhausted:
      return "budget";
    case SolveStatus::WithinTolerance:
      return "tolerance";
    case SolveStatus::MemoryExhausted:
      return "memory";
  }
  return "unknown";
}

}  // namespace concave_distance

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/scene/scene.h"
#include "pair_partners.h"

namespace concave_distance::detail {

enum class OperationKind : std::uint8_t {
  Add,
  Move,
  Remove,
  Attach,
  Detach,
  AllowContact,     ///< the pairs of both sides are switched off
  DisallowContact,  ///< ... and on
  SetMargin,
  EnablePairs,  ///< those of a name or pattern
  DisablePairs,
  SetEffects,
  SetWarningDistance
};

/// As scene files and messages name them.
inline constexpr std::pair<const char*, OperationKind> kOperationNames[] = {
    {"add", OperationKind::Add},
    {"move", OperationKind::Move},
    {"remove", OperationKind::Remove},
    {"attach", OperationKind::Attach},
    {"detach", OperationKind::Detach},
    {"allow_contact", OperationKind::AllowContact},
    {"disallow_contact", OperationKind::DisallowContact},
    {"set_margin", OperationKind::SetMargin},
    {"enable_pairs", OperationKind::EnablePairs},
    {"disable_pairs", OperationKind::DisablePairs},
    {"set_effects", OperationKind::SetEffects},
    {"set_warning_distance", OperationKind::SetWarningDistance},
};

/// One operation of a batch or of a journal. Fields that its kind does not name are ignored.
struct SceneOperation {
  OperationKind kind = OperationKind::Add;
  /// SetMargin: a body, group or pattern; Allow- and DisallowContact: side A, likewise; else a body's name.
  std::string body;
  std::string other;  ///< Attach: the parent; Allow- and DisallowContact: side B
  std::string frame;  ///< Move: of the pose; Detach: in which the body stays; empty as in body_placement.h
  Eigen::Isometry3d frame_from_body = Eigen::Isometry3d::Identity();  ///< Move
  std::vector<std::string> touch_links;                               ///< Attach: as attachBody()'s may_touch
  std::optional<SceneBody> added;                                     ///< Add: with its mesh
  PairPartners partners;                                              ///< Add
  /// Add: metres, of the new pairs, and the hysteresis; empty: as the scene's defaults. SetWarningDistance:
  /// empty: none
  std::optional<double> warning_distance;
  double warning_hysteresis = 0.0;
  bool allow_robot_link = false;  ///< Remove
  double margin = 0.0;            ///< SetMargin: metres
  std::string pair;               ///< the last four kinds: name or pattern
  std::string effects;            ///< SetEffects: as a scene file has them, and
  /// ... what lays them over those of a pair; loading/ makes it
  std::function<void(const std::string& where, PairSettings& settings)> lay_effects;
  /// Says what is known to be wrong already, such as a mesh that cannot be read; empty: nothing.
  std::optional<Error> problem;

  /// As a journal has it: what tf said when it was applied is in its fields, and tf is not asked again. Then
  /// `frame_from_body` is Attach: the body's pose in the parent, `frame` the parent's where that is no body;
  /// Detach: the body's pose in `frame`. Of a pair that is named, `body` and `other` are its bodies.
  bool is_recorded = false;
  std::vector<std::string> rigid_frames;        ///< Add: frames that static transforms join with the body's
  std::vector<std::string> switched_on;         ///< Detach: listed pairs
  std::optional<EffectSettings> effects_after;  ///< SetEffects: of all its pairs, where they are the same
};

/// Returns what messages call an operation, such as "attach 'part'".
std::string nameOf(const SceneOperation& operation);

}  // namespace concave_distance::detail

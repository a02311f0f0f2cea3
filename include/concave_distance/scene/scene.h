#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "concave_distance/contact/effect_settings.h"
#include "concave_distance/contact/material.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/mesh/surface/mass_properties.h"
#include "concave_distance/scene/broad_phase.h"
#include "concave_distance/scene/cloud.h"
#include "concave_distance/scene/named_list.h"
#include "concave_distance/scene/pair_rules.h"
#include "concave_distance/scene/rigid_frames.h"
#include "concave_distance/scene/scene_limits.h"
#include "concave_distance/scene/scene_origin.h"
#include "concave_distance/scene/simulation_settings.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

class BodyPool;
class RobotKinematics;

/// Returns a number that no body has had yet.
std::uint64_t newBodySerial();

/// Says what a body is attached to, and what it may touch as long as it is.
struct Attachment {
  std::string parent;               ///< name of a body, or of a tf frame that no body has
  std::uint64_t parent_serial = 0;  ///< SceneBody::serial of the parent; 0: a frame
  Eigen::Isometry3d parent_from_body = Eigen::Isometry3d::Identity();
  std::unordered_set<std::uint64_t> may_touch;  ///< SceneBody::serial: no rule watches it against these
  std::vector<std::string> switched_off;        ///< listed pairs that detaching switches on again
  std::uint64_t carrier_before = 0;             ///< SceneBody::carrier that detaching gives back
};

/// One rigid piece of a scene. Its frame is a tf frame, in which it stands still unless edits move it; the
/// mesh is expressed in the body's own frame, which is `frame_from_body` in that one.
struct SceneBody {
  std::string name;   ///< unique in the scene; a robot's link is `<prefix><link>`
  std::string frame;  ///< tf frame
  Eigen::Isometry3d frame_from_body = Eigen::Isometry3d::Identity();
  /// SceneBody::serial of the body whose edits move this one: itself, or what it is attached to; 0: none, and
  /// only tf moves it.
  std::uint64_t carrier = 0;
  std::shared_ptr<const Attachment> attachment;  ///< nullptr: none
  std::shared_ptr<const BodyMesh> mesh;
  BodyBounds bounds;  ///< of the mesh's surface, without the margin
  /// Metres that its surface is moved out by for distances and niches, not for contacts (TrackerParameters).
  double margin = 0.0;
  RepairReport repair;
  std::optional<MassProperties> inertia;  ///< of a link: what its URDF says
  std::string source;                     ///< file or URDF element it came from, for messages
  bool in_robot_model = false;            ///< rviz can draw it from robot_description; no mesh marker needed
  bool is_robot_link = false;             ///< of a URDF
  Eigen::Vector4d colour = Eigen::Vector4d(0.6, 0.6, 0.65, 1.0);  ///< red, green, blue, opacity in [0, 1]
  Material material;                                              ///< for contact forces
  std::string label;  ///< what names of pairs call it; empty: its name
  /// Stays the same through all edits of this body.
  std::uint64_t serial = newBodySerial();
  bool is_added = false;                     ///< while the scene ran
  std::shared_ptr<const BodyOrigin> origin;  ///< nullptr: not known
  std::shared_ptr<const CloudState> cloud;   ///< nullptr: it is not made of what a sensor sees

  const std::string& pairLabel() const { return label.empty() ? name : label; }
};

/// Checks a margin that a person has given for a body.
/// @throws Error naming `where` for one that is negative, not finite or larger than the body: probably not
/// metres
void requireMargin(const std::string& where, double margin, const BodyMesh& body);

/// Holds a pair's settings: the scene file's defaults, then the groups in order, then the pair's own entry.
struct PairSettings {
  TrackerParameters tracker;
  EffectSettings effects;
  /// An alert is raised below this, metres; empty: never.
  std::optional<double> warning_distance;
  /// ... and taken back above warning_distance + hysteresis, metres.
  double warning_hysteresis = 0.01;
};

/// Returns the parameters of two bodies' pair: its settings, and the margins of the bodies.
TrackerParameters withMargins(TrackerParameters settings, const SceneBody& a, const SceneBody& b);

struct ScenePair {
  std::string name;        ///< `<label of A>/<label of B>` unless the scene file names it
  std::size_t body_a = 0;  ///< index into Scene::bodies
  std::size_t body_b = 0;
  bool enabled = true;
  PairSettings settings;
  bool is_from_rule = false;  ///< no request or entry of a scene file names it by itself
};

/// A body or element that could not be loaded: the rest of the scene is served without it. The message names
/// the pairs that are not served with it.
struct SceneProblem {
  std::string where;
  std::string message;
};

/// Pairs by name and by their two bodies; an edit changes neither.
class PairList : public NamedList<ScenePair> {
 public:
  void push_back(ScenePair pair) { append(std::make_shared<ScenePair>(std::move(pair))); }
  void appendShared(const PairList& other, std::size_t i) { append(other.pointer(i)); }
  using NamedList::find;
  /// Index of the pair of these bodies, in either order.
  std::optional<std::size_t> find(std::size_t body_a, std::size_t body_b) const {
    return by_bodies_.find(hashOf(body_a, body_b), [&](std::size_t place) {
      const ScenePair& pair = (*this)[place];
      return (pair.body_a == body_a && pair.body_b == body_b) ||
             (pair.body_a == body_b && pair.body_b == body_a);
    });
  }

 private:
  void append(const Pointer& pair) {
    by_bodies_.insert(hashOf(pair->body_a, pair->body_b), size());
    NamedList::append(pair);
  }
  static std::size_t hashOf(std::size_t a, std::size_t b) {
    return ((std::min(a, b) << 32U | std::max(a, b)) * 0x9e3779b97f4a7c15ULL) >> 24U;
  }
  PlaceIndex by_bodies_;
};

/// The `defaults` of a scene file, which bodies that are added later and their pairs start from.
struct SceneDefaults {
  PairSettings pairs;
  std::optional<double> max_edge_length;  ///< m; empty: automatic
  std::optional<double> chord_error;      ///< m; empty: 1 % of the radius
  Material material;
};

struct Scene {
  NamedList<SceneBody> bodies;
  PairList pairs;  ///< those named by their two bodies, each followed at any distance; not all that there are
  PairRules rules;  ///< of all others
  std::vector<SceneProblem> problems;
  std::vector<std::string> notes;     ///< repairs and filters applied, one line each
  std::vector<std::string> warnings;  ///< served, but probably mistakes; each with a remedy
  RigidFrames rigid;                  ///< frames that fixed joints connect
  SceneDefaults defaults;
  /// Names of bodies by group: of the scene file, robots and SRDFs. Not all of them need to be in `bodies`.
  std::map<std::string, std::vector<std::string>> groups;
  std::set<std::string> groups_of_robots;        ///< those of `groups` that URDFs and SRDFs give
  std::shared_ptr<const SceneText> file;         ///< nullptr: it was not loaded
  SceneJournal operations;                       ///< since it was loaded
  std::optional<double> automatic_cutoff;        ///< m, if SceneLoadOptions requests one
  std::optional<SimulationSettings> simulation;  ///< the section `simulation`, where there is one
  std::shared_ptr<BodyPool> pool;                ///< of its bodies, used for later ones too
  SceneLimits limits;                            ///< for edits, too
  /// The joints of its robots, for kinematics/; not of a robot whose joints cannot be moved (see `notes`).
  std::vector<std::shared_ptr<const RobotKinematics>> robots;

  std::optional<std::size_t> findBody(const std::string& name) const;
  /// Index of the body with this SceneBody::serial. O(bodies).
  std::optional<std::size_t> findBody(std::uint64_t serial) const;
  /// Index of the listed pair of these bodies, in either order.
  std::optional<std::size_t> findPair(const std::string& name_a, const std::string& name_b) const;
};

/// Returns `<label of A>/<label of B>`, or where a listed pair has that name the same with `_2` and so on.
std::string freePairName(const Scene& scene, std::size_t body_a, std::size_t body_b);
/// Returns the pair of two bodies, places in scene.bodies, as the rules give it; nothing where they give none
/// or the list has it.
std::optional<ScenePair> ruledPair(const Scene& scene, std::size_t body_a, std::size_t body_b);
/// Returns the pair of two bodies, listed or by the rules.
std::optional<ScenePair> pairOf(const Scene& scene, std::size_t body_a, std::size_t body_b);
/// Returns the pair with this name, listed or by the rules.
std::optional<ScenePair> findPairNamed(const Scene& scene, const std::string& name);
/// Returns every pair, the listed ones first, for small scenes. O(bodies^2).
/// @param most it ends after so many
PairList allPairs(const Scene& scene, std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace concave_distance

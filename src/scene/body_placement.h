#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "frames_now.h"

namespace concave_distance::detail {

/// Places a body anew; it then counts as moving against all others, also those of its frame. Bodies that are
/// attached to it move with it. Mesh, pairs and ids stay, as with the functions below.
/// @param frame empty: the one that the body has
/// @throws Error when there is no such body; for a robot's link, an attached body, an unknown frame, a pose
///         that is not finite, and when tf moves its frame and none is given. Nothing is changed then, as
///         below
void moveBody(Scene& scene, const std::string& name, const std::string& frame,
              const Eigen::Isometry3d& frame_from_body, const FramesNow& frames);

/// Fixes a body to another one, or to a tf frame that no body has, where it is at this moment. It is not
/// watched against bodies that move with it.
/// @param may_touch bodies, groups and patterns that it is not watched against while it is attached
/// @return those of `may_touch` that name no body
/// @throws Error for an unknown body or parent, a robot's link, a body that is attached already, a cycle, and
///         when tf does not connect the frames
std::vector<std::string> attachBody(Scene& scene, const std::string& name, const std::string& parent,
                                    const std::vector<std::string>& may_touch, const FramesNow& frames);

/// Attaches a body with this pose in its parent, wherever it is now, as a journal has it.
/// @param frame of a parent that is no body; empty: the parent is one
/// @return as attachBody(). @throws Error for an unknown body or parent, a robot's link, a body that is
///         attached already and a cycle
std::vector<std::string> attachBodyAt(Scene& scene, const std::string& name, const std::string& parent,
                                      const std::string& frame, const Eigen::Isometry3d& parent_from_body,
                                      const std::vector<std::string>& may_touch);

/// Leaves an attached body where it is at this moment and watches it as before attachBody().
/// @param frame in which it stays; empty: the reference frame
/// @throws Error when there is no such body, when it is not attached, and when tf does not connect the frames
void detachBody(Scene& scene, const std::string& name, const std::string& frame, const FramesNow& frames);

/// Places a body, which tf is not asked about, as a journal has it: like moveBody() or, where it is not
/// `moved`, like detachBody().
/// @throws Error when there is no such body, for a robot's link, and for an attached body that is moved
void placeBody(Scene& scene, const std::string& name, const std::string& frame,
               const Eigen::Isometry3d& frame_from_body, bool is_moved);

}  // namespace concave_distance::detail

"""What MoveIt's planning scene holds: the sum of the messages that it publishes, without ROS.

In: SceneMessage values, whole scenes and diffs. Kept: the objects of the world, the attached ones, the matrix of allowed
contacts, paddings, scales, colours and frames; and, by name, what cannot be served, with the reason.
The rules are those of moveit_core's PlanningScene (usePlanningSceneMsg, processCollisionObjectMsg,
processAttachedCollisionObjectMsg); doc/moveit_bridge.md has the places where this differs.
"""

import math
from dataclasses import replace

from planning_scene_values import (
    ADD, APPEND, MOVE, OCTOMAP, REMOVE, AllowedContacts, Refused, SceneObject, Unserved, require_shape)
from rigid_transforms import IDENTITY, are_near, composed, inverse, is_finite, normalized


def is_identity(pose):
    """MoveIt's isEmpty of a pose."""
    return pose == IDENTITY


class PlanningSceneState:
    def __init__(self):
        self.changes = 0  # messages that said more than joint values
        self.clear()

    def clear(self):
        self.name = ""
        self.planning_frame = ""
        self.world = {}     # SceneObject by id
        self.attached = {}  # SceneObject by id
        self.contacts = AllowedContacts()
        self.padding = {}   # m, by link
        self.scale = {}     # by link
        self.colors = {}    # r, g, b, a by id
        self.transforms = {}  # pose in the planning frame, by frame
        self.octomap = ""
        self.refused = {}   # reason, by a name such as "object 'box'"

    def use(self, message):
        """Takes over a message: a whole scene replaces everything, a diff what it names."""
        if message.is_diff and not _says_more_than_joints(message):
            return
        self.changes += 1
        before = dict(self.world)
        if not message.is_diff:
            self.clear()
            self.world = before  # Attached objects may still take their shapes from there.
        self.name = message.name or self.name
        self._use_transforms(message.transforms)
        self._use_robot_state(message)
        self._use_contacts(message)
        self._use_numbers("padding", message.padding, self.padding, lambda value: value >= 0.0, "0 or more (m)")
        self._use_numbers("scale", message.scale, self.scale, lambda value: value > 0.0, "greater than 0")
        self.colors.update(message.colors)
        if not message.is_diff:
            self.world = {}
        for item in message.objects:
            self._try("object '%s'" % item.id, self._use_object, item)
        if message.octomap is not None or not message.is_diff:
            self.octomap = message.octomap or ""

    def _try(self, name, action, *arguments):
        try:
            action(*arguments)
            self.refused.pop(name, None)
        except Refused as reason:
            self.refused[name] = str(reason)

    def _use_transforms(self, transforms):
        for target, frame, pose in transforms:
            self.planning_frame = self.planning_frame or target
            name = "fixed frame '%s'" % frame
            if not is_finite(pose):
                self.refused[name] = "its transform is not finite; objects in this frame are not served"
                self.transforms.pop(frame, None)
            elif target != self.planning_frame:
                self.refused[name] = "its transform is to '%s', but that of the planning frame '%s' is needed" % (
                    target, self.planning_frame)
            else:
                self.refused.pop(name, None)
                self.transforms[frame] = normalized(pose)

    def _use_robot_state(self, message):
        if message.is_diff and not message.has_joints and not message.attached:
            return
        if not message.robot_state_is_diff:
            self.attached = {}
        for item in message.attached:
            name = "attached object '%s'" % item.object.id
            if not message.robot_state_is_diff and item.object.operation != ADD:
                self.refused[name] = ("its operation is %d in a robot_state that is no diff, which only adds; "
                                      "set robot_state.is_diff" % item.object.operation)
            else:
                self._try(name, self._use_attached, item)

    def _use_contacts(self, message):
        if message.contacts is None and message.is_diff:
            return
        self.contacts = message.contacts or AllowedContacts()
        self.refused.pop("allowed_collision_matrix", None)
        if message.contacts_fault:
            self.refused["allowed_collision_matrix"] = message.contacts_fault

    def _use_numbers(self, kind, given, kept, is_right, allowed):
        for link, value in given:
            name = "link_%s of '%s'" % (kind, link)
            if math.isfinite(value) and is_right(value):
                kept[link] = value
                self.refused.pop(name, None)
            else:
                self.refused[name] = "the value is %r (allowed: %s); the one before stays" % (value, allowed)

    def _frame_pose(self, frame):
        """Where a frame is in the planning frame: (frame to use, pose in it)."""
        frame = frame[1:] if frame.startswith("/") else frame
        if frame in ("", self.planning_frame):
            if not frame and not self.planning_frame:
                raise Refused("its header has no frame_id and the planning frame is not known")
            return self.planning_frame, IDENTITY
        if frame in self.transforms:
            return self.planning_frame, self.transforms[frame]
        if frame in self.world:
            return self.world[frame].frame, self.world[frame].pose
        if not self.planning_frame:
            return frame, IDENTITY  # Scenes of MoveIt have all objects in the planning frame.
        raise Refused("its frame '%s' is neither the planning frame '%s' nor one of fixed_frame_transforms nor an "
                      "object; give it in one of these" % (frame, self.planning_frame))

    def _read_shapes(self, item):
        """The pose of an object in its header's frame, its shapes and their poses in the object."""
        if item.fault:
            raise Refused(item.fault)
        for shape, pose in zip(item.shapes, item.shape_poses):
            require_shape(shape)
            if not is_finite(pose):
                raise Unserved("the pose of a %s is not finite" % shape.kind)
        if item.pose is not None and not is_finite(item.pose):
            raise Unserved("its pose is not finite")
        poses = tuple(normalized(pose) for pose in item.shape_poses)
        # A single shape's pose is the object's, where that is not given: moving the object then moves it there.
        if len(item.shapes) == 1 and (item.pose is None or is_identity(item.pose)):
            return poses[0], item.shapes, (IDENTITY,)
        return normalized(item.pose or IDENTITY), item.shapes, poses

    def _use_object(self, item):
        if item.id == OCTOMAP:
            raise Refused("the name is reserved for the octomap")
        if item.operation == REMOVE:
            for name in [item.id] if item.id else list(self.world):
                self.world.pop(name, None)
                self.colors.pop(name, None)
                self.refused.pop("object '%s'" % name, None)
            return
        if not item.id:
            raise Refused("an object without id; give it one")
        if item.operation in (ADD, APPEND):
            if not item.shapes and not item.fault:
                raise Refused("it has no shapes; give primitives, meshes or planes")
            frame, frame_pose = self._frame_pose(item.frame)
            try:
                pose, shapes, poses = self._read_shapes(item)
            except Unserved:
                self.world.pop(item.id, None)
                raise
            pose = composed(frame_pose, pose)
            if item.operation == APPEND and item.id in self.world:
                self.world[item.id] = appended(self.world[item.id], frame, pose, shapes, poses)
            else:
                self.world[item.id] = SceneObject(frame, pose, shapes, poses)
        elif item.operation == MOVE:
            self._move(item)
        else:
            raise Refused("its operation is %d (allowed: ADD 0, REMOVE 1, APPEND 2, MOVE 3)" % item.operation)

    def _move(self, item):
        if item.id not in self.world:
            raise Refused("MOVE of an object that is not in the world; add it first")
        if not all(is_finite(pose) for pose in item.shape_poses + ((item.pose or IDENTITY),)):
            raise Refused("MOVE to a pose that is not finite; it stays where it was")
        before = self.world[item.id]
        if item.shape_poses and len(item.shape_poses) != len(before.shapes):
            raise Refused("MOVE with %d poses of shapes, but it has %d shapes; it stays where it was" % (
                len(item.shape_poses), len(before.shapes)))
        frame, frame_pose = self._frame_pose(item.frame)
        if item.pose is None and not item.shape_poses:
            raise Refused("MOVE without a pose; it stays where it was")
        poses = tuple(normalized(pose) for pose in item.shape_poses) or before.shape_poses
        self.world[item.id] = replace(before, frame=frame, shape_poses=poses, link="",
                                      pose=composed(frame_pose, normalized(item.pose or IDENTITY)))

    def _use_attached(self, item):
        message = item.object
        if message.id == OCTOMAP:
            raise Refused("the name is reserved for the octomap")
        if message.operation == REMOVE:
            self._detach(item)
        elif message.operation in (ADD, APPEND):
            self._attach(item)
        else:
            raise Refused("its operation is %d, but attached objects can only be added, appended to or removed" %
                          message.operation)

    def _attach(self, item):
        message = item.object
        if not item.link or not message.id:
            raise Refused("it has no %s; give one" % ("link_name" if message.id else "id"))
        if message.operation == ADD and not message.shapes:
            if message.id not in self.world:
                known = self.attached.get(message.id)
                if known and known.link == item.link:
                    return  # It has been attached already.
                raise Refused("it has no shapes, and no object of the world has its name; give shapes")
            made = self.world[message.id]
        elif not message.shapes and not message.fault:
            raise Refused("it has no shapes; give primitives, meshes or planes")
        else:
            frame, frame_pose = item.link, IDENTITY
            if message.frame != item.link:
                frame, frame_pose = self._frame_pose(message.frame)
            try:
                pose, shapes, poses = self._read_shapes(message)
            except Unserved:
                self.world.pop(message.id, None)
                self.attached.pop(message.id, None)
                raise
            made = SceneObject(frame, composed(frame_pose, pose), shapes, poses)
        touch = tuple(sorted(set(item.touch_links)))
        known = self.attached.get(message.id)
        if message.operation == APPEND and known:
            touch = tuple(sorted(set(known.touch_links) | set(touch)))
            made = appended(known, made.frame, made.pose, made.shapes, made.shape_poses)
        self.world.pop(message.id, None)
        self.refused.pop("object '%s'" % message.id, None)
        self.attached[message.id] = replace(made, link=item.link, touch_links=touch)

    def _detach(self, item):
        name, link = item.object.id, item.link
        if name and name in self.attached and link and self.attached[name].link != link:
            raise Refused("it is attached to '%s', not to '%s'; it stays attached" % (
                self.attached[name].link, link))
        chosen = [name] if name else [one for one, known in self.attached.items() if link in ("", known.link)]
        for one in chosen:
            known = self.attached.pop(one, None)
            if known and one not in self.world:
                # Its place in the planning frame is the link's at this moment: the distance node knows that.
                self.world[one] = replace(known, touch_links=())


def _says_more_than_joints(message):
    return bool(message.objects or message.attached or message.contacts or message.contacts_fault or message.padding or
                message.scale or message.colors or message.transforms or message.name or message.octomap is not None or
                (message.has_joints and not message.robot_state_is_diff))


def appended(known, frame, pose, shapes, poses):
    """An object with more shapes, which stand where their message says. One that it has already changes nothing."""
    if frame != known.frame:
        raise Refused("its frame '%s' is another one than '%s', in which it is" % (frame, known.frame))
    known_from_new = composed(inverse(known.pose), pose)
    more = [(shape, composed(known_from_new, at)) for shape, at in zip(shapes, poses)]
    had = list(zip(known.shapes, known.shape_poses))
    new = [one for one in more if not any(one[0] == other[0] and are_near(one[1], other[1]) for other in had)]
    both = had + new
    return replace(known, shapes=tuple(shape for shape, _ in both), shape_poses=tuple(at for _, at in both))

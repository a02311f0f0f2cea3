"""Reads moveit_msgs/PlanningScene messages of any version into the values of planning_scene_values."""

from planning_scene_values import ADD, APPEND, AllowedContacts, AttachedMessage, ObjectMessage, SceneMessage, Shape
from rigid_transforms import IDENTITY

SCENE = "moveit_msgs/PlanningScene"
_WORLD = "moveit_msgs/PlanningSceneWorld"
OBJECT = "moveit_msgs/CollisionObject"
_ATTACHED = "moveit_msgs/AttachedCollisionObject"
_STATE = "moveit_msgs/RobotState"
_MATRIX = "moveit_msgs/AllowedCollisionMatrix"
_NO_OBJECTS = "no object of the planning scene is served"
_NO_ATTACHED = "no attached object is served"

# Without these nothing can be served.
NEEDED = (
    (SCENE, "world", _WORLD, _NO_OBJECTS),
    (_WORLD, "collision_objects", OBJECT + "[]", _NO_OBJECTS),
    (OBJECT, "header", "std_msgs/Header", _NO_OBJECTS),
    (OBJECT, "id", "string", _NO_OBJECTS),
    (OBJECT, "operation", "byte", _NO_OBJECTS),
)
# Where one of these is missing the rest is served.
WANTED = (
    (SCENE, "is_diff", "bool", "every message is taken as a diff"),
    (SCENE, "name", "string", "the scene has no name"),
    (SCENE, "robot_state", _STATE, _NO_ATTACHED),
    (SCENE, "fixed_frame_transforms", "geometry_msgs/TransformStamped[]",
     "objects are served in the frames of their headers"),
    (SCENE, "allowed_collision_matrix", _MATRIX, "no contact is allowed"),
    (SCENE, "link_padding", "moveit_msgs/LinkPadding[]", "links have no padding"),
    (SCENE, "link_scale", "moveit_msgs/LinkScale[]", "scales other than 1 are not noticed"),
    (SCENE, "object_colors", "moveit_msgs/ObjectColor[]", "objects are grey"),
    (_WORLD, "octomap", "octomap_msgs/OctomapWithPose", "an octomap is not served"),
    (OBJECT, "primitives", "shape_msgs/SolidPrimitive[]", "primitives are not served"),
    (OBJECT, "primitive_poses", "geometry_msgs/Pose[]", "primitives are at the pose of their object"),
    (OBJECT, "meshes", "shape_msgs/Mesh[]", "meshes are not served"),
    (OBJECT, "mesh_poses", "geometry_msgs/Pose[]", "meshes are at the pose of their object"),
    (OBJECT, "planes", "shape_msgs/Plane[]", "planes are not served"),
    (OBJECT, "plane_poses", "geometry_msgs/Pose[]", "planes are at the pose of their object"),
    (_STATE, "attached_collision_objects", _ATTACHED + "[]", _NO_ATTACHED),
    (_STATE, "is_diff", "bool", "every list of attached objects is taken as a diff"),
    (_ATTACHED, "link_name", "string", _NO_ATTACHED),
    (_ATTACHED, "object", OBJECT, _NO_ATTACHED),
    (_ATTACHED, "touch_links", "string[]", "attached objects are watched against all links but their own"),
    (_MATRIX, "entry_names", "string[]", "no contact is allowed"),
    (_MATRIX, "entry_values", "moveit_msgs/AllowedCollisionEntry[]", "no contact is allowed"),
    ("moveit_msgs/AllowedCollisionEntry", "enabled", "bool[]", "no contact is allowed"),
    (_MATRIX, "default_entry_names", "string[]", "no contact is allowed by default"),
    (_MATRIX, "default_entry_values", "bool[]", "no contact is allowed by default"),
)
_KINDS = {1: ("box", 3), 2: ("sphere", 1), 3: ("cylinder", 2), 4: ("cone", 2)}  # with the count of dimensions
_MISSING = object()


class SceneReader:
    """Reads messages of one definition, without the fields that it lacks or has otherwise."""

    def __init__(self, faults):
        """faults: those of message_definitions.field_faults for WANTED."""
        self._absent = {(type_name, field) for type_name, field, _ in faults}
        self.has_octomap = (_WORLD, "octomap") not in self._absent

    def _field(self, type_name, message, field, fallback):
        return fallback if (type_name, field) in self._absent else getattr(message, field, fallback)

    def read(self, message):
        robot_state = self._field(SCENE, message, "robot_state", None)
        contacts, contacts_fault = self._contacts(message)
        return SceneMessage(
            is_diff=bool(self._field(SCENE, message, "is_diff", True)),
            name=self._field(SCENE, message, "name", ""),
            objects=tuple(self.read_object(item) for item in message.world.collision_objects),
            attached=self._attached(robot_state),
            robot_state_is_diff=bool(self._field(_STATE, robot_state, "is_diff", True)),
            has_joints=_has_joints(robot_state),
            contacts=contacts, contacts_fault=contacts_fault,
            padding=tuple((item.link_name, item.padding) for item in self._field(SCENE, message, "link_padding", ())),
            scale=tuple((item.link_name, item.scale) for item in self._field(SCENE, message, "link_scale", ())),
            colors=tuple((item.id, (item.color.r, item.color.g, item.color.b, item.color.a))
                         for item in self._field(SCENE, message, "object_colors", ())),
            transforms=tuple((_bare(item.child_frame_id), _bare(item.header.frame_id), _transform(item.transform))
                             for item in self._field(SCENE, message, "fixed_frame_transforms", ())),
            octomap=self._octomap(message))

    def _octomap(self, message):
        octomap = self._field(_WORLD, message.world, "octomap", None)
        if octomap is None or not octomap.octomap.id:
            return None
        data = octomap.octomap.data
        return "%s of %d bytes in '%s'" % (octomap.octomap.id, len(data), octomap.header.frame_id) if data else ""

    def _attached(self, robot_state):
        items = self._field(_STATE, robot_state, "attached_collision_objects", ()) if robot_state else ()
        if {(_ATTACHED, "link_name"), (_ATTACHED, "object")} & self._absent:
            return ()
        return tuple(AttachedMessage(item.link_name, self.read_object(item.object),
                                     tuple(self._field(_ATTACHED, item, "touch_links", ()))) for item in items)

    def read_object(self, item):
        pose = getattr(item, "pose", _MISSING)
        shapes, poses, faults = [], [], []
        for names, poses_name, to_shape in (("primitives", "primitive_poses", _primitive),
                                            ("meshes", "mesh_poses", _mesh), ("planes", "plane_poses", _plane)):
            given = self._field(OBJECT, item, names, ())
            at = [_pose(one) for one in self._field(OBJECT, item, poses_name, ())]
            if item.operation in (ADD, APPEND):
                if len(at) > len(given):
                    faults.append("it has %d %s but %d %s" % (len(given), names, len(at), poses_name))
                shapes += [to_shape(one) for one in given]
                at = (at + [IDENTITY] * len(given))[:len(given)]
            poses += at
        return ObjectMessage(
            id=item.id, operation=item.operation, frame=_bare(item.header.frame_id),
            pose=None if pose is _MISSING else _pose(pose), shapes=tuple(shapes), shape_poses=tuple(poses),
            fault="; ".join(faults))

    def _contacts(self, message):
        matrix = self._field(SCENE, message, "allowed_collision_matrix", None)
        names = list(self._field(_MATRIX, matrix, "entry_names", ()))
        if not names or ("moveit_msgs/AllowedCollisionEntry", "enabled") in self._absent:
            return None, ""
        rows = self._field(_MATRIX, matrix, "entry_values", ())
        default_names = self._field(_MATRIX, matrix, "default_entry_names", ())
        default_values = self._field(_MATRIX, matrix, "default_entry_values", ())
        if len(rows) != len(names) or len(default_names) != len(default_values):
            return AllowedContacts(), "it has %d names and %d rows, %d default names and %d values: no contact is allowed" % (
                len(names), len(rows), len(default_names), len(default_values))
        short = [names[i] for i, row in enumerate(rows) if len(row.enabled) != len(names)]
        pairs = {(min(names[i], names[j]), max(names[i], names[j])): bool(row.enabled[j])
                 for i, row in enumerate(rows) if len(row.enabled) == len(names) for j in range(i + 1, len(names))}
        fault = "the rows of %s have another length than %d: they allow nothing" % (
            ", ".join(short), len(names)) if short else ""
        return AllowedContacts(pairs, dict(zip(default_names, map(bool, default_values)))), fault


def _has_joints(robot_state):
    joints = getattr(robot_state, "joint_state", None)
    others = getattr(robot_state, "multi_dof_joint_state", None)
    return bool(getattr(joints, "name", ()) or getattr(others, "joint_names", ()))


def _bare(frame):
    return frame[1:] if frame.startswith("/") else frame


def _pose(message):
    position, rotation = message.position, message.orientation
    return ((position.x, position.y, position.z), (rotation.x, rotation.y, rotation.z, rotation.w))


def _transform(message):
    position, rotation = message.translation, message.rotation
    return ((position.x, position.y, position.z), (rotation.x, rotation.y, rotation.z, rotation.w))


def _primitive(message):
    kind, count = _KINDS.get(message.type, ("primitive of type %d" % message.type, None))
    return Shape(kind, tuple(message.dimensions)[:count])  # Publishers often send more, which mean nothing.


def _mesh(message):
    return Shape("mesh", tuple(number for at in message.vertices for number in (at.x, at.y, at.z)),
                 tuple(corner for triangle in message.triangles for corner in triangle.vertex_indices))


def _plane(message):
    return Shape("plane", tuple(message.coef))

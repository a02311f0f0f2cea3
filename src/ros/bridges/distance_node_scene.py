"""What a distance node has and takes, as values of scene_operations: get_scene in, apply_scene out."""

from concave_distance.msg import SceneOperation
from geometry_msgs.msg import Point, Pose
from shape_msgs.msg import Mesh, MeshTriangle, SolidPrimitive
from std_msgs.msg import ColorRGBA

from planning_scene_values import Shape
from rigid_transforms import IDENTITY
from scene_operations import NodeScene, canonical

_TYPES = {"box": SolidPrimitive.BOX, "sphere": SolidPrimitive.SPHERE, "cylinder": SolidPrimitive.CYLINDER,
          "cone": SolidPrimitive.CONE}
_KINDS = {number: kind for kind, number in _TYPES.items()}


def pose_message(pose):
    message = Pose()
    message.position.x, message.position.y, message.position.z = pose[0]
    rotation = message.orientation
    rotation.x, rotation.y, rotation.z, rotation.w = pose[1]
    return message


def pose_value(message):
    position, rotation = message.position, message.orientation
    return ((position.x, position.y, position.z), (rotation.x, rotation.y, rotation.z, rotation.w))


def operation_message(operation):
    message = SceneOperation(operation=operation.kind, body=operation.body, other=operation.other,
                             frame_id=operation.frame, pose=pose_message(operation.pose),
                             touch_links=list(operation.touch), margin=operation.margin,
                             color=ColorRGBA(*operation.color))
    for shape, pose in zip(operation.shapes, operation.shape_poses):
        if shape.kind == "mesh":
            message.meshes.append(_mesh_message(shape))
            message.mesh_poses.append(pose_message(pose))
        else:
            message.primitives.append(SolidPrimitive(type=_TYPES[shape.kind], dimensions=shape.numbers))
            message.primitive_poses.append(pose_message(pose))
    return message


def _mesh_message(shape):
    numbers, corners = shape.numbers, shape.triangles
    return Mesh(vertices=[Point(*numbers[i:i + 3]) for i in range(0, len(numbers), 3)],
                triangles=[MeshTriangle(list(corners[i:i + 3])) for i in range(0, len(corners), 3)])


def read_scene(response, prefix):
    """The NodeScene of an answer of get_scene: bodies of the prefix, all else by name."""
    bodies, others, margins = {}, set(), {}
    for state in response.bodies:
        name = state.info.name
        if name.startswith(prefix) and not state.is_robot_link:
            bodies[name] = _body(state)
            continue
        others.add(name)
        if state.is_robot_link:
            margins[name] = state.info.margin
    return NodeScene(bodies, frozenset(others), frozenset(), margins, response.reference_frame)


def listed_pairs(response):
    """The named pairs of an answer of get_scene that are on, and those that are off."""
    on, off = set(), set()
    for pair in response.named_pairs:
        (on if pair.enabled else off).add(tuple(sorted((pair.body_a, pair.body_b))))
    return on, off


def _body(state):
    added = state.add
    shapes = [Shape(_KINDS.get(one.type, "primitive"), tuple(one.dimensions)) for one in added.primitives]
    poses = [pose_value(one) for one in added.primitive_poses]
    for mesh in added.meshes:
        shapes.append(Shape("mesh", tuple(number for at in mesh.vertices for number in (at.x, at.y, at.z)),
                            tuple(corner for one in mesh.triangles for corner in one.vertex_indices)))
    poses += [pose_value(one) for one in added.mesh_poses]
    if not shapes:  # Files, which the bridge never adds.
        shapes, poses = [Shape("file", ())], [IDENTITY]
    return canonical(state.info.frame_id, pose_value(state.info.pose), tuple(shapes), tuple(poses),
                     link=state.info.attached_to, touch=tuple(sorted(state.touch_links)), margin=state.info.margin)

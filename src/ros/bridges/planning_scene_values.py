"""What messages of a planning scene say, as plain values, and what of them cannot be served.

Values are immutable, so that scenes may share them. Poses are those of rigid_transforms.
"""

import math
from dataclasses import dataclass, field
from typing import Dict, Optional, Tuple

ADD, REMOVE, APPEND, MOVE = 0, 1, 2, 3
_SHORTEST_NORMAL = 1e-100  # squares of shorter ones are 0
OCTOMAP = "<octomap>"  # The name that MoveIt reserves for the octomap of the world.


@dataclass(frozen=True)
class Shape:
    """A box, sphere, cylinder or cone by its dimensions (in the order of shape_msgs), a plane by its four
    coefficients, a mesh by the coordinates of its vertices and the corners of its triangles, each in one row."""

    kind: str
    numbers: Tuple[float, ...]
    triangles: Tuple[int, ...] = ()


@dataclass(frozen=True)
class ObjectMessage:
    """A CollisionObject. Shapes and poses are those of primitives, then meshes, then planes."""

    id: str
    operation: int = ADD
    frame: str = ""
    pose: Optional[tuple] = None  # None: its definition has no such field
    shapes: Tuple[Shape, ...] = ()
    shape_poses: Tuple[tuple, ...] = ()
    fault: str = ""  # what is wrong with its lists


@dataclass(frozen=True)
class AttachedMessage:
    link: str
    object: ObjectMessage
    touch_links: Tuple[str, ...] = ()


@dataclass(frozen=True)
class AllowedContacts:
    """A matrix of allowed contacts: of pairs of names in alphabetical order, and of names by default."""

    pairs: Dict[Tuple[str, str], bool] = field(default_factory=dict)
    defaults: Dict[str, bool] = field(default_factory=dict)

    def allows(self, a, b):
        """As the message's definition says: the pair's entry, else both names' defaults."""
        entry = self.pairs.get((min(a, b), max(a, b)))
        if entry is not None:
            return entry
        defaults = [self.defaults[name] for name in (a, b) if name in self.defaults]
        return bool(defaults) and all(defaults)


@dataclass(frozen=True)
class SceneMessage:
    is_diff: bool = True
    name: str = ""
    objects: Tuple[ObjectMessage, ...] = ()
    attached: Tuple[AttachedMessage, ...] = ()
    robot_state_is_diff: bool = False
    has_joints: bool = False
    contacts: Optional[AllowedContacts] = None  # None: no names
    contacts_fault: str = ""
    padding: Tuple[Tuple[str, float], ...] = ()
    scale: Tuple[Tuple[str, float], ...] = ()
    colors: Tuple[Tuple[str, Tuple[float, ...]], ...] = ()
    transforms: Tuple[Tuple[str, str, tuple], ...] = ()  # planning frame, frame, pose of the frame in it
    octomap: Optional[str] = None  # None: not said; empty: no octomap; else its description


@dataclass(frozen=True)
class SceneObject:
    """An object at a pose in a frame, with its shapes at poses in the object."""

    frame: str
    pose: tuple
    shapes: Tuple[Shape, ...]
    shape_poses: Tuple[tuple, ...]
    link: str = ""  # that it is attached to; in the world: that it was attached to when it was left there
    touch_links: Tuple[str, ...] = ()


class Refused(Exception):
    """Why a part of a message is not taken over: what was there before stays."""


class Unserved(Refused):
    """Why an object cannot be served: a part of it would measure too far, so that all of it is left out."""


def require_shape(shape):
    counts = {"box": 3, "sphere": 1, "cylinder": 2, "cone": 2}
    if not all(math.isfinite(number) for number in shape.numbers):
        raise Unserved("a %s has a number that is not finite" % shape.kind)
    if shape.kind in counts:
        if len(shape.numbers) < counts[shape.kind]:
            raise Unserved("a %s has %d dimensions; give %d" % (shape.kind, len(shape.numbers), counts[shape.kind]))
        if min(shape.numbers[:counts[shape.kind]]) <= 0.0:
            raise Unserved("a %s has a dimension that is not greater than 0" % shape.kind)
    elif shape.kind == "plane":
        if not any(shape.numbers[:3]):
            raise Unserved("a plane has the normal 0 0 0")
        length = math.hypot(*shape.numbers[:3])
        if not _SHORTEST_NORMAL <= length <= 1.0 / _SHORTEST_NORMAL:
            raise Unserved("a plane has a normal of length %g; give one of length 1" % length)
    elif shape.kind == "mesh":
        if not shape.triangles:
            raise Unserved("a mesh has no triangle")
        if max(shape.triangles) >= len(shape.numbers) // 3:
            raise Unserved("a triangle of a mesh names vertex %d of %d" % (
                max(shape.triangles), len(shape.numbers) // 3))
    else:
        raise Unserved("%s (served: BOX 1, SPHERE 2, CYLINDER 3, CONE 4, meshes, planes)" % shape.kind)

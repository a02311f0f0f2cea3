"""A plain model of a planning scene for tests, which shares no code with the bridge: 4x4 matrices, every shape in the
world. Links do not move here. Also random diffs and the whole scene as MoveIt publishes it."""
import math
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "..", "src", "ros", "bridges"))
sys.dont_write_bytecode = True
from planning_scene_values import (  # noqa: E402
    ADD, APPEND, MOVE, REMOVE, AllowedContacts, AttachedMessage, ObjectMessage, SceneMessage, Shape)

FRAME = "world"
NONE = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
UNIT = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))


def matrix(pose):
    (a, b, c), (x, y, z, w) = pose
    n = math.sqrt(x * x + y * y + z * z + w * w)
    x, y, z, w = (x / n, y / n, z / n, w / n) if n else (0, 0, 0, 1)
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), a),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), b),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), c), (0, 0, 0, 1))


def times(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)) for i in range(4))


def inverted(a):
    turned = tuple(tuple(a[j][i] for j in range(3)) for i in range(3))
    moved = tuple(-sum(turned[i][k] * a[k][3] for k in range(3)) for i in range(3))
    return tuple(turned[i] + (moved[i],) for i in range(3)) + ((0, 0, 0, 1),)


def are_equal(a, b, tolerance=1e-7):
    return all(abs(a[i][j] - b[i][j]) < tolerance for i in range(3) for j in range(4))


def pose_of(a):
    """A pose with the rotation of a matrix (Shepperd's method)."""
    m = a
    candidates = [m[0][0] + m[1][1] + m[2][2], m[0][0], m[1][1], m[2][2]]
    best = candidates.index(max(candidates))
    if best == 0:
        q = (m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], 1 + candidates[0])
    elif best == 1:
        q = (1 + m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0], m[0][2] + m[2][0], m[2][1] - m[1][2])
    elif best == 2:
        q = (m[0][1] + m[1][0], 1 + m[1][1] - m[0][0] - m[2][2], m[1][2] + m[2][1], m[0][2] - m[2][0])
    else:
        q = (m[0][2] + m[2][0], m[1][2] + m[2][1], 1 + m[2][2] - m[0][0] - m[1][1], m[1][0] - m[0][1])
    n = math.sqrt(sum(one * one for one in q))
    return (tuple(m[i][3] for i in range(3)), tuple(one / n for one in q))


LINKS = {"wrist": ((1.0, 0.5, 0.25), (0.0, 0.0, math.sin(0.4), math.cos(0.4))),
         "finger": ((-0.5, 1.5, 0.75), (math.sin(-0.3), 0.0, 0.0, math.cos(-0.3)))}
FRAMES = {"camera": ((0.25, -2.0, 1.0), (0.0, math.sin(0.7), 0.0, math.cos(0.7)))}


class PlainScene:
    def __init__(self):
        self.world = {}     # id: [pose of the object, [(shape, pose in the object)], fixed], matrices
        self.attached = {}  # id: [link, touch links, pose in the world, shapes as above, fixed]
        # fixed: the link that its pose is known on, or the planning frame: in another frame nothing can be appended.
        self.contacts, self.defaults = {}, {}
        self.padding, self.colors = {}, {}

    def placed(self):
        """Shapes with their poses in the world, of objects by id."""
        return {name: [(shape, times(pose, at)) for shape, at in shapes]
                for name, (pose, shapes, _) in self.world.items()}

    def held(self):
        return {name: (link, touch, [(shape, times(pose, at)) for shape, at in shapes])
                for name, (link, touch, pose, shapes, _) in self.attached.items()}

    @staticmethod
    def _parts(item, frame):
        """Pose of the object and its shapes, or None where MoveIt's rules or ours refuse it."""
        bad = any(not math.isfinite(number) for shape in item.shapes for number in shape.numbers) or any(
            not math.isfinite(number) for pose in item.shape_poses + (item.pose or NONE,) for part in pose
            for number in part)
        if bad or any(shape.kind == "box" and min(shape.numbers) <= 0 for shape in item.shapes):
            return None
        poses = [matrix(pose) for pose in item.shape_poses]
        if len(item.shapes) == 1 and (item.pose is None or item.pose == NONE):
            return times(frame, poses[0]), [(item.shapes[0], UNIT)]
        return times(frame, matrix(item.pose or NONE)), list(zip(item.shapes, poses))

    @staticmethod
    def _frame(name):
        if name in ("", FRAME, "/" + FRAME):
            return UNIT
        return matrix(FRAMES[name]) if name in FRAMES else None

    def use(self, message):
        if not message.is_diff:
            self.attached, self.contacts, self.defaults, self.padding, self.colors = {}, {}, {}, {}, {}
        if message.attached or message.has_joints or not message.is_diff:
            if not message.robot_state_is_diff:
                self.attached = {}
            for item in message.attached:
                if message.robot_state_is_diff or item.object.operation == ADD:
                    self._use_attached(item)
        if message.contacts is not None:
            self.contacts, self.defaults = dict(message.contacts.pairs), dict(message.contacts.defaults)
        self.padding.update((name, value) for name, value in message.padding if value >= 0)
        self.colors.update(message.colors)
        if not message.is_diff:
            self.world = {}
        for item in message.objects:
            self._use_object(item)

    def _use_object(self, item):
        if item.operation == REMOVE:
            for name in [item.id] if item.id else list(self.world):
                self.world.pop(name, None)
                self.colors.pop(name, None)
            return
        frame = self._frame(item.frame)
        if frame is None or not item.id:
            return
        if item.operation in (ADD, APPEND) and item.shapes:
            parts = self._parts(item, frame)
            if parts is None:
                self.world.pop(item.id, None)
            elif item.operation == APPEND and item.id in self.world:
                pose, shapes, fixed = self.world[item.id]
                for shape, at in parts[1] if fixed == FRAME else []:
                    inside = times(times(inverted(pose), parts[0]), at)
                    if not any(shape == other and are_equal(inside, place, 1e-8) for other, place in shapes):
                        shapes.append((shape, inside))
            else:
                self.world[item.id] = [*parts, FRAME]
        elif item.operation == MOVE and item.id in self.world:
            pose, shapes, _ = self.world[item.id]
            numbers = [number for one in item.shape_poses + (item.pose or NONE,) for part in one for number in part]
            if not all(map(math.isfinite, numbers)) or item.shape_poses and len(item.shape_poses) != len(shapes):
                return
            if item.pose is None and not item.shape_poses:
                return
            if item.shape_poses:
                shapes = [(shape, matrix(at)) for (shape, _), at in zip(shapes, item.shape_poses)]
            self.world[item.id] = [times(frame, matrix(item.pose or NONE)), shapes, FRAME]

    def _use_attached(self, item):
        name = item.object.id
        if item.object.operation == REMOVE:
            if name in self.attached and item.link and self.attached[name][0] != item.link:
                return
            for one in [name] if name else [a for a, b in self.attached.items() if item.link in ("", b[0])]:
                if one in self.attached:
                    _, _, pose, shapes, fixed = self.attached.pop(one)
                    self.world.setdefault(one, [pose, shapes, fixed])
            return
        if item.object.operation == MOVE:
            return
        if not item.object.shapes:
            if name in self.world and item.object.operation == ADD:
                self.attached[name] = [item.link, tuple(sorted(set(item.touch_links))), *self.world.pop(name)]
            return
        frame = matrix(LINKS[item.link]) if item.object.frame == item.link else self._frame(item.object.frame)
        parts = self._parts(item.object, frame)
        fixed = item.link if item.object.frame == item.link else FRAME
        had = self.attached.get(name)
        if parts and item.object.operation == APPEND and had and had[4] != fixed:
            return
        self.world.pop(name, None)
        if parts is None:
            self.attached.pop(name, None)
            return
        touch, (pose, shapes) = set(item.touch_links), parts
        if item.object.operation == APPEND and had:
            touch |= set(had[1])
            more = [(shape, times(times(inverted(had[2]), pose), at)) for shape, at in shapes]
            pose, shapes = had[2], had[3] + [
                one for one in more if not any(one[0] == b and are_equal(one[1], c, 1e-8) for b, c in had[3])]
        self.attached[name] = [item.link, tuple(sorted(touch)), pose, shapes, fixed]

    def whole(self):
        """As MoveIt publishes it: objects in the planning frame, attached ones in the frames of their links."""
        return SceneMessage(
            is_diff=False, has_joints=True, transforms=frames(),
            objects=tuple(ObjectMessage(name, ADD, FRAME, pose_of(pose), tuple(shape for shape, _ in shapes),
                                        tuple(pose_of(at) for _, at in shapes))
                          for name, (pose, shapes, _) in self.world.items()),
            attached=tuple(AttachedMessage(
                link, ObjectMessage(name, ADD, link, pose_of(times(inverted(matrix(LINKS[link])), pose)),
                                    tuple(shape for shape, _ in shapes), tuple(pose_of(at) for _, at in shapes)),
                touch) for name, (link, touch, pose, shapes, _) in self.attached.items()),
            contacts=AllowedContacts(dict(self.contacts), dict(self.defaults)) if self.contacts else None,
            padding=tuple(self.padding.items()), colors=tuple(self.colors.items()))


def frames():
    return ((FRAME, FRAME, NONE),) + tuple((FRAME, name, pose) for name, pose in FRAMES.items())


class RandomDiffs:
    def __init__(self, seed, has_pose=True):
        self.random = random.Random(seed)
        self.has_pose = has_pose

    def pose(self):
        draw = self.random
        if draw.random() < 0.2:
            return NONE
        q = [draw.gauss(0, 1) for _ in range(4)]
        return (tuple(draw.uniform(-2, 2) for _ in range(3)), tuple(one / math.hypot(*q[:2], *q[2:]) for one in q))

    def shape(self):
        draw = self.random
        if draw.random() < 0.02:
            return Shape("box", (0.1, draw.choice((0.0, -1.0, math.nan)), 0.1))
        kind = draw.choice(("box", "sphere", "cylinder", "cone", "mesh"))
        if kind == "mesh":
            return Shape(kind, tuple(draw.uniform(0, 1) for _ in range(12)), (0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3))
        return Shape(kind, tuple(draw.uniform(0.1, 1) for _ in range({"box": 3, "sphere": 1}.get(kind, 2))))

    def object(self, operation, frame=None, has_shapes=True, count=None):
        draw = self.random
        count = count or draw.randint(1, 3)
        pose = self.pose() if self.has_pose else None
        if pose and draw.random() < 0.02:
            pose = ((math.nan, 0.0, 0.0), NONE[1])
        return ObjectMessage(draw.choice("abcdef"), operation, frame or draw.choice((FRAME, FRAME, "camera", "/world")),
                             pose, tuple(self.shape() for _ in range(count)) if has_shapes else (),
                             tuple(self.pose() for _ in range(count)))

    def change(self):
        """An object's message."""
        draw = self.random
        kind = draw.choices(("add", "append", "move", "move shapes", "remove", "all", "wrong"), (8, 2, 6, 3, 3, 0.2, 1))[0]
        if kind in ("add", "append"):
            return self.object(ADD if kind == "add" else APPEND)
        if kind == "move":
            moved = self.object(MOVE, has_shapes=False)
            return ObjectMessage(moved.id, MOVE, moved.frame, moved.pose, (), () if self.has_pose else moved.shape_poses)
        if kind == "move shapes":
            return self.object(MOVE, has_shapes=False)
        if kind == "wrong":
            return draw.choice((self.object(7), self.object(ADD, frame="nowhere"), ObjectMessage("a", ADD, FRAME, NONE),
                                ObjectMessage("", ADD, FRAME, NONE, (Shape("sphere", (1.0,)),), (NONE,))))
        return ObjectMessage("" if kind == "all" else draw.choice("abcdef"), REMOVE, FRAME)

    def attachment(self):
        draw = self.random
        link = draw.choice(sorted(LINKS))
        touch = tuple(draw.sample(("wrist", "finger", "palm"), draw.randint(0, 3)))
        kind = draw.choices(("shapes", "append", "by name", "remove", "remove link", "move"), (5, 1, 4, 5, 0.3, 0.3))[0]
        if kind in ("shapes", "append"):
            return AttachedMessage(link, self.object(ADD if kind == "shapes" else APPEND, frame=link), touch)
        if kind == "by name":
            return AttachedMessage(link, ObjectMessage(draw.choice("abcdef"), ADD, link, NONE), touch)
        name = "" if kind == "remove link" else draw.choice("abcdef")
        return AttachedMessage(draw.choice((link, "")), ObjectMessage(name, MOVE if kind == "move" else REMOVE, link))

    def diff(self):
        draw = self.random
        says_contacts = draw.random() < 0.1
        names = draw.sample("abcdef", 3) + ["wrist", "finger"]
        pairs = {(min(a, b), max(a, b)): draw.random() < 0.5 for a in names for b in names if a != b}
        defaults = {draw.choice("abcdef"): draw.random() < 0.5 for _ in range(2)}
        has_state = draw.random() < 0.3
        return SceneMessage(
            is_diff=True, transforms=frames() if draw.random() < 0.1 else (),
            objects=tuple(self.change() for _ in range(draw.choice((0, 1, 1, 2, 5)))),
            attached=tuple(self.attachment() for _ in range(draw.randint(0, 2))) if has_state else (),
            robot_state_is_diff=draw.random() < 0.9, has_joints=has_state and draw.random() < 0.5,
            contacts=AllowedContacts(pairs, defaults) if says_contacts else None,
            padding=((draw.choice(sorted(LINKS)), draw.choice((0.0, 0.01, 0.02, -1.0))),) if draw.random() < 0.1 else (),
            colors=((draw.choice("abcdef"), (1.0, 0.0, 0.0, 1.0)),) if draw.random() < 0.1 else ())

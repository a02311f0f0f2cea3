"""Which operations of apply_scene bring a distance node to what a planning scene holds, without ROS.

In: a PlanningSceneState, what the distance node has (NodeScene). Out: operations with their owners, in the order in which
they have to be applied. Nothing is kept: after a restart of either side the same functions bring both together again.
"""

import re
import zlib
from dataclasses import dataclass, field, replace
from typing import Dict, FrozenSet, Tuple

from planning_scene_values import Shape
from rigid_transforms import IDENTITY, are_near, composed, inverse

ADD, MOVE, REMOVE, ATTACH, DETACH, ALLOW_CONTACT, DISALLOW_CONTACT, SET_MARGIN = range(8)


@dataclass(frozen=True)
class Operation:
    """One operation of apply_scene. `owner` is what is left out where it is refused."""

    kind: int
    body: str
    owner: str
    other: str = ""
    frame: str = ""
    pose: tuple = IDENTITY
    shapes: Tuple[Shape, ...] = ()
    shape_poses: Tuple[tuple, ...] = ()
    touch: Tuple[str, ...] = ()
    margin: float = 0.0
    color: Tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Body:
    """A body of the bridge. Its pose is that of its first shape, whatever its messages called the object's pose, so
    that it can be moved without being made again."""

    frame: str
    pose: tuple
    shapes: Tuple[Shape, ...]
    shape_poses: Tuple[tuple, ...]
    link: str = ""  # that it is attached to
    touch: Tuple[str, ...] = ()
    margin: float = 0.0
    color: Tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)
    is_left_behind: bool = False  # where its link was when it was detached; `frame` and `pose` say where on the link
    owner: str = ""

    def has_shapes_of(self, other):
        return (len(self.shapes) == len(other.shapes) and
                all(_are_same(a, b) for a, b in zip(self.shapes, other.shapes)) and
                all(are_near(a, b) for a, b in zip(self.shape_poses, other.shape_poses)))

    def is_at(self, other):
        return self.frame == other.frame and are_near(self.pose, other.pose)


@dataclass
class NodeScene:
    """What the distance node has: bodies of the bridge by name, the others' names, margins of links, and pairs of
    bodies that are switched off because the planning scene allows their contact."""

    bodies: Dict[str, Body] = field(default_factory=dict)
    others: FrozenSet[str] = frozenset()
    off: FrozenSet[Tuple[str, str]] = frozenset()
    margins: Dict[str, float] = field(default_factory=dict)  # of links, by name
    reference: str = ""  # frame


@dataclass
class Names:
    """Bodies' names of what the planning scene names."""

    prefix: str
    link_prefix: str = ""

    def body(self, name):
        """A name that the distance node allows: where characters have to be replaced, with a number that tells ids
        apart that would be called the same."""
        plain = re.sub(r"[^A-Za-z0-9_/]", "_", name)
        plain = re.sub(r"/+", "/", plain).strip("/")[:150]  # 200 characters are allowed.
        return self.prefix + plain + ("" if plain and plain == name else "_%08x" % zlib.crc32(name.encode()))

    def link(self, name):
        return self.link_prefix + name


def _are_same(a, b):
    return a == b or (a.kind == b.kind and a.triangles == b.triangles and len(a.numbers) == len(b.numbers) and
            all(abs(x - y) <= 1e-9 * max(1.0, abs(x)) for x, y in zip(a.numbers, b.numbers)))


def plane_mesh(coefficients, size):
    """A square of a plane ax + by + cz + d = 0 as a mesh, its middle nearest to the origin."""
    length = sum(number * number for number in coefficients[:3]) ** 0.5
    normal = [number / length for number in coefficients[:3]]
    middle = [-coefficients[3] / length * number for number in normal]
    least = min(range(3), key=lambda axis: abs(normal[axis]))
    other = [1.0 if axis == least else 0.0 for axis in range(3)]
    along = _cross(normal, other)
    scale = sum(number * number for number in along) ** -0.5
    along = [scale * number for number in along]
    across = _cross(normal, along)
    corners = [middle[i] + 0.5 * size * (a * along[i] + b * across[i])
               for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)) for i in range(3)]
    return Shape("mesh", tuple(corners), (0, 1, 2, 0, 2, 3))


def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def body_of(item, plane_size, **others):
    """A body from a SceneObject."""
    shapes = tuple(plane_mesh(shape.numbers, plane_size) if shape.kind == "plane" else shape for shape in item.shapes)
    return canonical(item.frame, item.pose, shapes, item.shape_poses, **others)


def canonical(frame, pose, shapes, shape_poses, **others):
    first_from_object = inverse(shape_poses[0])
    relative = (IDENTITY,) + tuple(composed(first_from_object, at) for at in shape_poses[1:])
    return Body(frame, composed(pose, shape_poses[0]), shapes, relative, **others)


def wanted_bodies(state, node, names, plane_size):
    """The bodies that the distance node should have, by name."""
    wanted = {}
    for name, item in state.world.items():
        wanted[names.body(name)] = body_of(
            item, plane_size, owner="object '%s'" % name, color=tuple(state.colors.get(name, (0.0,) * 4)),
            is_left_behind=bool(item.link))
    for name, item in state.attached.items():
        body = names.body(name)
        link = names.link(item.link)
        known = sorted(names.link(one) for one in item.touch_links)
        wanted[body + "_attached" if body in wanted else body] = body_of(
            replace(item, frame=link) if item.frame == item.link else item, plane_size,
            owner="attached object '%s'" % name, link=link,
            touch=tuple(one for one in known if one in node.others and one != link),
            color=tuple(state.colors.get(name, (0.0,) * 4)), margin=state.padding.get(item.link, 0.0))
    return wanted


def wanted_contacts(state, names, bodies, others):
    """The pairs of bodies that may touch, of those that the distance node has or will have."""
    contacts = state.contacts
    by_name = {}
    for name in set(state.world) | set(state.attached):
        by_name[name] = names.body(name)
    known = set(bodies) | set(others)

    def body(name):
        found = by_name.get(name, names.link(name))
        return found if found in known else None
    allowed = set()
    for (a, b), is_allowed in contacts.pairs.items():
        if is_allowed and body(a) and body(b) and a != b:
            allowed.add(tuple(sorted((body(a), body(b)))))
    listed = [name for name, value in contacts.defaults.items() if value and body(name)]
    if listed:
        start = len(names.link_prefix)
        everything = list(by_name) + [one[start:] for one in others if one.startswith(names.link_prefix)]
        present = [(other, body(other)) for other in everything if body(other)]
        for name in listed:
            made = body(name)
            allowed.update((made, one) if made <= one else (one, made) for other, one in present
                           if other != name and contacts.allows(name, other))
    return allowed


def wanted_margins(state, names, node, own):
    """Margins of links: the larger of their own and of the padding.

    own: the margins that links had before the bridge changed them, by name; entries are added.
    """
    padded = {names.link(link): padding for link, padding in state.padding.items() if padding > 0.0}
    for name in padded:
        if name in node.margins:
            own.setdefault(name, node.margins[name])
    return {name: max(margin, padded.get(name, 0.0)) for name, margin in own.items()}


def padding_without_body(state, names, node):
    """Bodies that the distance node has not, by the links that the planning scene pads."""
    return {link: names.link(link) for link, padding in state.padding.items()
            if padding > 0.0 and names.link(link) not in node.margins}


def plan(wanted, contacts, margins, node, refused=frozenset()):
    """Operations that bring the distance node to what is wanted, and the scene that it then has.

    contacts: pairs of bodies that may touch. margins: of links, by name. refused: owners to leave out; a body of theirs
    that the node has stays where it is, or goes where it should have other shapes.
    """
    left_out = {name: body for name, body in wanted.items() if body.owner in refused}
    wanted = {name: body for name, body in wanted.items() if name not in left_out}
    bodies = dict(node.bodies)
    removals, changes = [], []
    for name, had in node.bodies.items():
        body = wanted.get(name)
        if body is not None and not _must_be_made(had, body):
            continue
        if body is None and name in left_out and left_out[name].has_shapes_of(had):
            continue
        if removal_owner(name) in refused:
            wanted.pop(name, None)  # It stays, and so does what stands there.
        else:
            removals.append(Operation(REMOVE, name, removal_owner(name)))
            del bodies[name]
    for name, body in wanted.items():
        had = bodies.get(name)
        changes += _change(name, had, body, node.reference) if had else _addition(name, body, node.reference)
        bodies[name] = body
    made_again = {operation.body for operation in removals}
    kept = (set(node.bodies) - made_again) | node.others
    off = frozenset(pair for pair in node.off if kept.issuperset(pair))
    to_watch, to_allow = _contact_changes(contacts, off, bodies, node.others)
    to_allow = [pair for pair in to_allow if contact_owner(pair) not in refused]
    changed_margins = {name: margin for name, margin in margins.items()
                       if name in node.margins and abs(node.margins[name] - margin) > 1e-12 and
                       padding_owner(name) not in refused}
    operations = [Operation(DISALLOW_CONTACT, pair[0], contact_owner(pair), other=pair[1]) for pair in to_watch]
    operations += removals + changes
    operations += [Operation(SET_MARGIN, name, padding_owner(name), margin=changed_margins[name])
                   for name in sorted(changed_margins)]
    operations += [Operation(ALLOW_CONTACT, pair[0], contact_owner(pair), other=pair[1]) for pair in to_allow]
    after = NodeScene(bodies, node.others, off - set(to_watch) | set(to_allow), {**node.margins, **changed_margins},
                      node.reference)
    return operations, after


def _contact_changes(contacts, off, bodies, others):
    """Pairs to watch again and pairs to switch off. Those that a body's attachment switches off stay so."""
    held = {tuple(sorted((name, other))) for name, body in bodies.items() for other in body.touch + (body.link,)}
    present = set(bodies) | others
    return sorted(off - contacts - held), sorted(pair for pair in contacts - off if present.issuperset(pair))


def contact_owner(pair):
    return "allowed contact of '%s' and '%s'" % pair


def removal_owner(name):
    return "removal of '%s'" % name


def padding_owner(name):
    return "padding of '%s'" % name


def _must_be_made(had, body):
    """A body that is put down is made again: its message says where it is, and it is not watched against objects that
    rest, such as the table it lies on."""
    if not body.has_shapes_of(had):
        return True
    return bool(had.link) and not body.link and not body.is_left_behind


def _addition(name, body, reference):
    add = Operation(ADD, name, body.owner, frame=body.frame, pose=body.pose, shapes=body.shapes,
                    shape_poses=body.shape_poses, margin=body.margin, color=body.color)
    return [add] + _fixing(name, body, reference)


def _fixing(name, body, reference):
    """Fixes a body that is in its place to what it is attached to, or where its link is at this moment."""
    if body.link:
        return [Operation(ATTACH, name, body.owner, other=body.link, touch=body.touch)]
    if body.is_left_behind:
        return [Operation(ATTACH, name, body.owner, other=reference), Operation(DETACH, name, body.owner)]
    return []


def _change(name, had, body, reference):
    is_there = body.is_at(had)
    operations = []
    if body.is_left_behind and is_there and (had.link or had.is_left_behind):
        operations = [Operation(DETACH, name, body.owner)] if had.link else []
    elif (body.link, body.touch) != (had.link, had.touch) or not is_there:
        if had.link:
            operations.append(Operation(DETACH, name, body.owner, frame=had.frame))
        if not is_there:
            operations.append(Operation(MOVE, name, body.owner, frame=body.frame, pose=body.pose))
        operations += _fixing(name, body, reference)
    if abs(body.margin - had.margin) > 1e-12:
        operations.append(Operation(SET_MARGIN, name, body.owner, margin=body.margin))
    return operations

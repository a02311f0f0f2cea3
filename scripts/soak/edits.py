"""Random edits and requests of the soak: good ones, which have to succeed, and nonsense, which has to be refused."""

import collections
import math
import os
import random
import sys

import rospy
from concave_distance.msg import DistanceQuery, PairStatus, SceneMoves, SceneOperation
from concave_distance.srv import (AddBody, ApplyScene, GetClearance, GetDistance, GetDistances, GetScene, ListBodies, Reload,
                                  RemoveBody, ResetTracking, SaveScene, SetEffects, SetPairEnabled, SetWarningDistance)
from geometry_msgs.msg import Point, PoseStamped
from shape_msgs.msg import Mesh, MeshTriangle, SolidPrimitive
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

HERE = os.path.dirname(os.path.realpath(__file__))
BRIDGES = [os.path.join(HERE, "..", "..", *parts) for parts in (("test", "ros", "bridges"), ("src", "ros", "bridges"))]
sys.path[:0] = [path for path in BRIDGES if path not in sys.path]
from fake_planning_scene import FakePlanningScene, pose, solid  # noqa: E402

NODE = "concave_distance/"
SERVICES = {"add_body": AddBody, "apply_scene": ApplyScene, "get_clearance": GetClearance, "get_distance": GetDistance,
            "get_distances": GetDistances, "get_scene": GetScene, "list_bodies": ListBodies, "reload": Reload,
            "remove_body": RemoveBody, "reset_tracking": ResetTracking, "save_scene": SaveScene, "set_effects": SetEffects,
            "set_pair_enabled": SetPairEnabled, "set_warning_distance": SetWarningDistance}
BODIES = ["edit_%d" % number for number in range(4)]
OBJECTS = ["table", "ball", "crate", "cup"]
LINKS = ["wam%d" % number for number in range(1, 8)]
JOINTS = ["j%d" % number for number in range(1, 8)]
RESTS = [0.0, 0.5, 0.0, 2.1, 0.0, -0.9, 0.0]  # rad, a place of the demo's arm


def has_known_distance(answer):
    """Beyond the cutoff there is none, which is right."""
    return answer.success or answer.result.nearest.status.code == PairStatus.BEYOND_CUTOFF


class Edits:
    """One random edit at each step(), of a given seed. What it has added it knows, so that good edits are good."""

    def __init__(self, seed):
        self.engine = random.Random(seed)
        self.counts = collections.Counter()
        self.reasons = collections.deque(maxlen=10)
        self.there = {}  # body: link that it is attached to, or ""
        self.services = {name: rospy.ServiceProxy(NODE + name, kind, persistent=False) for name, kind in SERVICES.items()}
        self.moves = rospy.Publisher(NODE + "scene_moves", SceneMoves, queue_size=10)
        self.planning = FakePlanningScene()
        self.planning.publish(self.planning.whole())
        self.kinds = ((self.batch, 8), (self.move, 8), (self.plan, 8), (self.nonsense, 4), (self.ask, 4), (self.switch, 3),
                      (self.clear, 1), (self.add_and_remove, 1), (self.reload, 0.2))

    def step(self):
        kinds, weights = zip(*self.kinds)
        self.engine.choices(kinds, weights)[0]()

    def take(self):
        taken, self.counts = self.counts, collections.Counter()
        return taken

    def call(self, service, is_good=True, accepts=lambda answer: answer.success, **fields):
        """Calls a service; counts what should have been refused and was not, and the other way round."""
        self.counts["edits" if is_good else "nonsense"] += 1
        try:
            answer = self.services[service](**fields)
        except rospy.ServiceException as problem:
            self.counts["lost"] += 1
            self.reasons.append("%s: %s" % (service, problem))
            return None
        if bool(accepts(answer)) != is_good:
            self.counts["refused" if is_good else "taken"] += 1
            self.reasons.append("%s: %s" % (service, answer.message or "taken: %s" % fields))
        return answer

    def place(self):
        draw = self.engine.uniform
        turn = draw(-math.pi, math.pi)
        return pose(draw(0.3, 1.2), draw(-0.9, 0.9), draw(0.1, 1.3), (0.0, 0.0, math.sin(turn / 2), math.cos(turn / 2)))

    def shape(self, operation):
        draw = self.engine.uniform
        kind = self.engine.randrange(7)
        if kind == 0:
            operation.primitives = [solid("BOX", draw(0.03, 0.2), draw(0.03, 0.2), draw(0.03, 0.2))]
        elif kind == 1:
            operation.primitives = [solid("SPHERE", draw(0.02, 0.1))]
        elif kind == 2:
            operation.primitives = [SolidPrimitive(type=SceneOperation.CAPSULE, dimensions=[draw(0.05, 0.2), draw(0.02, 0.05)])]
        elif kind == 3:
            operation.primitives = [solid("CONE", draw(0.05, 0.2), draw(0.02, 0.1))]
        elif kind == 4:
            operation.primitives = [solid("CYLINDER", draw(0.05, 0.2), draw(0.02, 0.1)), solid("SPHERE", draw(0.02, 0.1))]
            operation.primitive_poses = [pose(), pose(z=0.1)]
        elif kind == 5:
            corners = [Point(*[draw(-0.1, 0.1) for _ in range(3)]) for _ in range(4)]
            operation.meshes = [Mesh([MeshTriangle(list(one)) for one in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))],
                                     corners)]
        else:
            operation.mesh_resources = ["package://concave_distance/meshes/rows/clamp.stl"]

    def operation(self):
        """One that is good now, and done in self.there."""
        name = self.engine.choice(BODIES)
        done = SceneOperation(body=name, pose=self.place(), frame_id="world")
        if name not in self.there:
            done.operation = SceneOperation.ADD
            self.shape(done)
            self.there[name] = ""
            return done
        kind = self.engine.random()
        if kind < 0.2:
            done.operation = SceneOperation.REMOVE
            del self.there[name]
        elif kind < 0.4 and not self.there[name]:
            done.operation, done.other = SceneOperation.ATTACH, self.engine.choice(LINKS)
            done.touch_links = self.engine.choice([[], ["hand"], ["wam6", "wam7"]])
            self.there[name] = done.other
        elif self.there[name]:
            done.operation, done.frame_id = SceneOperation.DETACH, "world"
            self.there[name] = ""
        elif kind < 0.7:
            done.operation = SceneOperation.MOVE
        elif kind < 0.8:
            done.operation, done.margin = SceneOperation.SET_MARGIN, self.engine.uniform(0.0, 0.01)
        else:
            done.operation = self.engine.choice([SceneOperation.ALLOW_CONTACT, SceneOperation.DISALLOW_CONTACT])
            done.other = self.engine.choice(["arm", "walker_1*", "wam7"])
        return done

    def batch(self):
        before = dict(self.there)
        answer = self.call("apply_scene", operations=[self.operation() for _ in range(self.engine.randint(1, 5))])
        if answer is None:  # It may have been done or not.
            found = {body.info.name: body.info.attached_to for body in self.services["get_scene"](False).bodies}
            self.there = {name: found[name] for name in BODIES if name in found}
        elif not answer.success:
            self.there = before
            self.reasons.extend("%s: %s" % (fault.body, fault.message) for fault in answer.faults)

    def rest(self):
        """Leaves nothing for the bridge to find out by itself, so that the scene rests."""
        self.planning.is_silent = False
        self.planning.publish(self.planning.whole())

    def move(self):
        names = [name for name, link in self.there.items() if not link]
        chosen = self.engine.sample(names, min(len(names), 3))
        message = SceneMoves(bodies=chosen, poses=[self.place() for _ in chosen])
        message.header.frame_id = "world"
        if self.engine.random() < 0.1:  # dropped alone
            message.bodies, message.poses = chosen + ["nobody"], message.poses + [self.place()]
        self.moves.publish(message)
        self.counts["moves"] += len(chosen)

    def plan(self):
        """A change of the planning scene. Of some, the message is lost; the bridge has to notice."""
        scene, draw = self.planning, self.engine.uniform
        self.counts["diffs"] += 1
        scene.is_silent = self.engine.random() < 0.05
        name, kind = self.engine.choice(OBJECTS), self.engine.random()
        shapes = [(self.engine.choice([solid("SPHERE", draw(0.03, 0.1)), solid("BOX", draw(0.05, 0.3), 0.2, draw(0.05, 0.2)),
                                       solid("CYLINDER", draw(0.05, 0.2), 0.04)]), pose())]
        if name in scene.attached:
            scene.detach(scene.object(name, shapes, at=self.place()))
        elif kind < 0.15:
            scene.attach("wam7", scene.object(name, [(solid("CYLINDER", 0.1, 0.03), pose(z=0.12))], frame="wam7"),
                         ["wam6", "wam7"])
        elif kind < 0.3 and name in scene.objects:
            scene.take_out(name)
        elif kind < 0.4:
            scene.set_padding(wam7=self.engine.choice([0.0, 0.005]))
        elif kind < 0.5:
            scene.set_contacts([name, "wam7", "wam6"], {(name, "wam6")} if draw(0, 1) < 0.5 else set())
        else:
            scene.put(scene.object(name, shapes, at=self.place()))

    def ask(self):
        kind = self.engine.randrange(4)
        if kind == 0:
            self.call("get_scene", with_meshes=True)
        elif kind == 1:
            query = DistanceQuery(body_a="wam7", body_b="carton_2", with_niches=True)
            query.joints.name, query.joints.position = JOINTS, [value + self.engine.gauss(0.0, 0.1) for value in RESTS]
            query.use_pose_b = True
            query.pose_b.pose = pose(0.0, 0.0, self.engine.uniform(-0.1, 0.1))
            self.call("get_distance", accepts=has_known_distance, query=query)
        elif kind == 2:
            self.call("reset_tracking", pair=self.engine.choice(["wam7/shelf_board_3", "wam7/camera"]))
        else:
            self.call("list_bodies", accepts=lambda answer: answer.ready)

    def switch(self):
        pair = "walker_%d" % self.engine.randrange(200)
        if self.engine.random() < 0.5:
            self.call("set_pair_enabled", body_a=pair, body_b="walker_*", enabled=self.engine.random() < 0.7)
        else:
            self.call("set_warning_distance", pair="wam7/shelf_board_3", warning_distance=self.engine.uniform(0.0, 0.15),
                      warning_hysteresis=0.01)

    def clear(self):
        """A motion of the arm, with a budget: every answer is a bracket."""
        points = []
        for step in range(self.engine.randint(2, 4)):
            positions = [value + self.engine.gauss(0.0, 0.2) for value in RESTS]
            points.append(JointTrajectoryPoint(positions=positions, time_from_start=rospy.Duration(0.5 * step)))
        self.call("get_clearance", trajectory=JointTrajectory(joint_names=JOINTS, points=points), tolerance=0.005,
                  time_budget=0.5)

    def add_and_remove(self):
        at = self.place()
        self.call("add_body", name="brief", frame_id="world", pose=at, primitive="box", dimensions=[0.1, 0.2, 0.1])
        self.call("remove_body", name="brief")

    def reload(self):
        self.call("reload", drop_edits=False)

    def nonsense(self):
        bad = self.place()
        bad.position.x = self.engine.choice([math.nan, math.inf, 1e300])
        turned = pose(rotation=(0.0, 0.0, 0.0, 2.0))
        ball = [solid("SPHERE", 0.1)]
        add = dict(body="bad", frame_id="world", primitives=ball)
        service, fields = self.engine.choice([
            ("apply_scene", dict(operations=[SceneOperation(operation=SceneOperation.MOVE, body="nobody", pose=pose())])),
            ("apply_scene", dict(operations=[SceneOperation(pose=bad, **add)])),
            ("apply_scene", dict(operations=[SceneOperation(pose=turned, **add)])),
            ("apply_scene", dict(operations=[SceneOperation(pose=pose(), **add), SceneOperation(operation=77, body="bad")])),
            ("apply_scene", dict(operations=[SceneOperation(body="wam7", frame_id="world", pose=pose(), primitives=ball)])),
            ("get_distance", dict(query=DistanceQuery(body_a="wam7", body_b="nobody"))),
            ("get_distances", dict(queries=[])),
            ("get_clearance", dict(trajectory=JointTrajectory(joint_names=JOINTS))),
            ("get_clearance", dict(body="carton_2", poses=[PoseStamped(pose=bad), PoseStamped(pose=bad)])),
            ("add_body", dict(name="bad", frame_id="world", mesh_resource="package://concave_distance/none.stl")),
            ("add_body", dict(name="bad name!", frame_id="world", primitive="sphere", dimensions=[0.1])),
            ("remove_body", dict(name="nobody")),
            ("set_pair_enabled", dict(pair="no/pair", enabled=True)),
            ("set_effects", dict(pair="wam7/shelf_board_3", effects="{normal_force: steam}")),
            ("set_warning_distance", dict(pair="wam7/shelf_board_3", warning_distance=math.nan)),
            ("set_warning_distance", dict(pair="wam7/shelf_board_3", warning_distance=0.5)),  # beyond the cutoff
            ("save_scene", dict(path="somewhere.yaml")),
        ])
        self.call(service, is_good=False, **fields)

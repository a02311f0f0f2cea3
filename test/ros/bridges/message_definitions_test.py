#!/usr/bin/env python3
"""Classes from definitions: md5sums that are known, definitions that lack a field or have another type, other messages."""
import io
import unittest

import plain_scene  # noqa: F401 (finds the bridge's modules)
from geometry_msgs.msg import Point, Pose
from message_definitions import WrongDefinition, classes_from, field_faults, planning_scene_service
from moveit_definitions import MD5_WITH_POSE, MD5_WITHOUT_POSE, PLANNING_SCENE, definition, older_definition
from planning_scene_messages import NEEDED, WANTED, SceneReader
from planning_scene_values import ADD, MOVE, Shape
from rigid_transforms import IDENTITY
from shape_msgs.msg import Mesh, MeshTriangle, Plane, SolidPrimitive


def at(x, w=1.0):
    made = Pose()
    made.position.x, made.orientation.w = x, w
    return made


class Definitions(unittest.TestCase):
    def assertWrong(self, text, *words, md5=None):
        with self.assertRaises(WrongDefinition) as caught:
            classes_from(PLANNING_SCENE, text, md5)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_md5sums_are_those_of_moveit(self):
        for text, message, service in ((definition(), MD5_WITH_POSE, "65cf69d3e7a0342e16374024d4eeef65"),
                                       (older_definition(), MD5_WITHOUT_POSE, "2745cf315b4eb5fb00e5befa8714d64d")):
            made = classes_from(PLANNING_SCENE, text, message)[PLANNING_SCENE]
            self.assertEqual((made._md5sum, planning_scene_service(made)._md5sum), (message, service))

    def test_a_service_carries_a_scene(self):
        made = classes_from(PLANNING_SCENE, definition())[PLANNING_SCENE]
        service, buffer = planning_scene_service(made), io.BytesIO()
        scene = made()
        scene.name = "cell"
        service._response_class(scene).serialize(buffer)
        self.assertEqual(service._response_class().deserialize(buffer.getvalue()).scene.name, "cell")
        buffer = io.BytesIO()
        service._request_class(989).serialize(buffer)
        self.assertEqual(service._request_class().deserialize(buffer.getvalue()).components, 989)

    def test_texts_that_are_no_definition(self):
        self.assertWrong("no such line at all", "line 1", "no such line at all")
        self.assertWrong("moveit_msgs/Unknown a\n", "cannot be read")
        self.assertWrong(definition(), MD5_WITH_POSE, "0123", md5="0123")

    def test_no_text_of_a_definition_becomes_code(self):
        for line in ("string made.append(1);A=1", "bool A=made.append(1)", "int32 made.append(1)", "string A='+made+'",
                     "int32[made.append(1)] a", "int32 a\\", 'int32 """', "=" * 80 + "\nMSG: a/b(object): made.append(1) #"):
            self.assertWrong("bool is_diff\n" + line + "\nint32 b\n", "neither a field nor a constant")
        self.assertWrong("int32 a\n" * 200000, "1600000 characters")
        comments = definition().replace("bool is_diff\n", 'bool is_diff  # """ quotes\n# \\\n\n   \n')
        self.assertEqual(classes_from(PLANNING_SCENE, comments)[PLANNING_SCENE]._md5sum, MD5_WITH_POSE)

    def test_every_field_that_is_missing_is_named_with_what_follows(self):
        consequences = {field: text for _, field, _, text in WANTED}
        for lines in (["geometry_msgs/TransformStamped[] fixed_frame_transforms", "LinkPadding[] link_padding",
                       "AllowedCollisionMatrix allowed_collision_matrix", "LinkScale[] link_scale",
                       "RobotState robot_state", "ObjectColor[] object_colors",
                       "octomap_msgs/OctomapWithPose octomap", "shape_msgs/Plane[] planes"],
                      ["string[] touch_links", "string[] default_entry_names", "bool[] default_entry_values"]):
            fields = {line.split()[1] for line in lines}
            faults = field_faults(classes_from(PLANNING_SCENE, definition(without=lines)), NEEDED + WANTED)
            self.assertEqual({fault[1] for fault in faults}, fields)
            for _, field, text in faults:
                self.assertIn("has no field '%s'" % field, text)
                self.assertIn(consequences[field], text)

    def test_a_field_of_another_type_is_named(self):
        text = definition(changed=[("LinkPadding[] link_padding", "float64[] link_padding")])
        (fault,) = field_faults(classes_from(PLANNING_SCENE, text), NEEDED + WANTED)
        self.assertEqual(fault[2], "moveit_msgs/PlanningScene has field 'link_padding' as float64[], not "
                         "moveit_msgs/LinkPadding[]: links have no padding")

    def test_without_objects_nothing_can_be_served(self):
        for line in ("CollisionObject[] collision_objects", "PlanningSceneWorld world"):
            faults = field_faults(classes_from(PLANNING_SCENE, definition(without=[line])), NEEDED)
            self.assertIn("no object of the planning scene is served", faults[0][2])


class Reading(unittest.TestCase):
    def setUp(self):
        self.use(definition())

    def use(self, text):
        self.classes = classes_from(PLANNING_SCENE, text)
        self.reader = SceneReader(field_faults(self.classes, WANTED))

    def make(self, name, **fields):
        return self.classes["moveit_msgs/" + name](**fields)

    def read(self, scene):
        """As from the wire."""
        buffer = io.BytesIO()
        scene.serialize(buffer)
        return self.reader.read(self.classes[PLANNING_SCENE]().deserialize(buffer.getvalue()))

    def scene(self, *objects):
        scene = self.make("PlanningScene")
        scene.world.collision_objects = list(objects)
        return scene

    def test_shapes_in_the_order_of_moveit(self):
        item = self.make("CollisionObject")
        item.id, item.header.frame_id, item.pose = "a", "/world", at(1.0)
        item.planes, item.plane_poses = [Plane([0.0, 0.0, 1.0, 2.0])], [at(4.0)]
        item.meshes = [Mesh([MeshTriangle([0, 1, 2])], [Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)])]
        item.primitives, item.primitive_poses = [SolidPrimitive(3, [0.5, 0.2, 0.0])], [at(2.0)]
        (made,) = self.read(self.scene(item)).objects
        self.assertEqual((made.id, made.frame, made.operation, made.pose[0], made.fault), ("a", "world", ADD, (1.0, 0.0, 0.0), ""))
        self.assertEqual(made.shapes, (
            Shape("cylinder", (0.5, 0.2)), Shape("mesh", (0, 0, 0, 1, 0, 0, 0, 1, 0), (0, 1, 2)),
            Shape("plane", (0.0, 0.0, 1.0, 2.0))))
        self.assertEqual([pose[0][0] for pose in made.shape_poses], [2.0, 0.0, 4.0])
        self.assertEqual(made.shape_poses[1], IDENTITY)

    def test_more_poses_than_shapes_are_a_fault_but_of_a_move(self):
        item = self.make("CollisionObject")
        item.id, item.mesh_poses = "a", [at(1.0)]
        self.assertIn("0 meshes but 1 mesh_poses", self.read(self.scene(item)).objects[0].fault)
        item.operation = MOVE
        moved = self.read(self.scene(item)).objects[0]
        self.assertEqual((moved.fault, len(moved.shape_poses)), ("", 1))

    def test_an_older_message_has_no_pose(self):
        self.use(older_definition())
        self.assertIsNone(self.read(self.scene(self.make("CollisionObject"))).objects[0].pose)

    def test_a_matrix_of_wrong_sizes(self):
        def contacts(rows, names=("a", "b"), default_names=(), default_values=()):
            scene = self.scene()
            scene.allowed_collision_matrix = self.make(
                "AllowedCollisionMatrix", entry_names=list(names), default_entry_names=list(default_names),
                entry_values=[self.make("AllowedCollisionEntry", enabled=row) for row in rows],
                default_entry_values=list(default_values))
            read = self.read(scene)
            return read.contacts, read.contacts_fault
        made, fault = contacts([[True, True], [False, True]], default_names=["a"], default_values=[True])
        self.assertEqual((made.pairs, made.defaults, fault), ({("a", "b"): True}, {"a": True}, ""))
        made, fault = contacts([[True, True]])
        self.assertEqual(made.pairs, {})
        self.assertIn("2 names and 1 rows", fault)
        made, fault = contacts([[True], [True, True]])
        self.assertEqual(made.pairs, {})
        self.assertIn("rows of a have another length than 2", fault)
        self.assertEqual(contacts([], names=()), (None, ""))

    def test_octomaps_and_joints(self):
        scene = self.scene()
        self.assertIsNone(self.read(scene).octomap)
        self.assertFalse(self.read(scene).has_joints)
        scene.world.octomap.octomap.id = "OcTree"
        self.assertEqual(self.read(scene).octomap, "")
        scene.world.octomap.octomap.data, scene.world.octomap.header.frame_id = [1, 2], "world"
        self.assertEqual(self.read(scene).octomap, "OcTree of 2 bytes in 'world'")
        scene.robot_state.joint_state.name = ["j"]
        self.assertTrue(self.read(scene).has_joints)

    def test_what_a_definition_lacks_is_read_as_absent(self):
        self.use(definition(without=["LinkPadding[] link_padding", "AllowedCollisionMatrix allowed_collision_matrix",
                                     "octomap_msgs/OctomapWithPose octomap", "string[] touch_links",
                                     "shape_msgs/SolidPrimitive[] primitives"],
                            changed=[("LinkScale[] link_scale", "float64 link_scale")]))
        item = self.make("CollisionObject")
        item.id, item.meshes = "a", [Mesh([MeshTriangle([0, 0, 0])], [Point()])]
        scene = self.scene(item)
        scene.robot_state.attached_collision_objects = [self.make("AttachedCollisionObject", link_name="l", object=item)]
        read = self.read(scene)
        self.assertEqual((read.padding, read.scale, read.contacts, read.octomap), ((), (), None, None))
        self.assertEqual(read.attached[0].touch_links, ())
        self.assertEqual([shape.kind for shape in read.objects[0].shapes], ["mesh"])


if __name__ == "__main__":
    unittest.main()

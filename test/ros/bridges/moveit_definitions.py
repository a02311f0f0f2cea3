"""Definitions of moveit_msgs/PlanningScene as its publishers send them, for tests without MoveIt: the fields alone.

Their md5sums are those of moveit_msgs of ROS Noetic, and of ROS Kinetic (without CollisionObject.pose).
"""
import functools

import genpy.dynamic

PLANNING_SCENE = "moveit_msgs/PlanningScene"
MD5_WITH_POSE = "acfc50bcfd6c7b978066bfa7c786002c"
MD5_WITHOUT_POSE = "89aac6d20db967ba716cba5a86b1b9d5"

_SCENE = """string name
RobotState robot_state
string robot_model_name
geometry_msgs/TransformStamped[] fixed_frame_transforms
AllowedCollisionMatrix allowed_collision_matrix
LinkPadding[] link_padding
LinkScale[] link_scale
ObjectColor[] object_colors
PlanningSceneWorld world
bool is_diff
"""
_OTHERS = """MSG: moveit_msgs/RobotState
sensor_msgs/JointState joint_state
sensor_msgs/MultiDOFJointState multi_dof_joint_state
AttachedCollisionObject[] attached_collision_objects
bool is_diff
MSG: sensor_msgs/JointState
Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
MSG: sensor_msgs/MultiDOFJointState
Header header
string[] joint_names
geometry_msgs/Transform[] transforms
geometry_msgs/Twist[] twist
geometry_msgs/Wrench[] wrench
MSG: geometry_msgs/Transform
Vector3 translation
Quaternion rotation
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
MSG: geometry_msgs/Twist
Vector3 linear
Vector3 angular
MSG: geometry_msgs/Wrench
Vector3 force
Vector3 torque
MSG: moveit_msgs/AttachedCollisionObject
string link_name
CollisionObject object
string[] touch_links
trajectory_msgs/JointTrajectory detach_posture
float64 weight
MSG: moveit_msgs/CollisionObject
Header header
geometry_msgs/Pose pose
string id
object_recognition_msgs/ObjectType type
shape_msgs/SolidPrimitive[] primitives
geometry_msgs/Pose[] primitive_poses
shape_msgs/Mesh[] meshes
geometry_msgs/Pose[] mesh_poses
shape_msgs/Plane[] planes
geometry_msgs/Pose[] plane_poses
string[] subframe_names
geometry_msgs/Pose[] subframe_poses
byte ADD=0
byte REMOVE=1
byte APPEND=2
byte MOVE=3
byte operation
MSG: geometry_msgs/Pose
Point position
Quaternion orientation
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
MSG: object_recognition_msgs/ObjectType
string key
string db
MSG: shape_msgs/SolidPrimitive
uint8 BOX=1
uint8 SPHERE=2
uint8 CYLINDER=3
uint8 CONE=4
uint8 type
float64[] dimensions
uint8 BOX_X=0
uint8 BOX_Y=1
uint8 BOX_Z=2
uint8 SPHERE_RADIUS=0
uint8 CYLINDER_HEIGHT=0
uint8 CYLINDER_RADIUS=1
uint8 CONE_HEIGHT=0
uint8 CONE_RADIUS=1
MSG: shape_msgs/Mesh
MeshTriangle[] triangles
geometry_msgs/Point[] vertices
MSG: shape_msgs/MeshTriangle
uint32[3] vertex_indices
MSG: shape_msgs/Plane
float64[4] coef
MSG: trajectory_msgs/JointTrajectory
Header header
string[] joint_names
JointTrajectoryPoint[] points
MSG: trajectory_msgs/JointTrajectoryPoint
float64[] positions
float64[] velocities
float64[] accelerations
float64[] effort
duration time_from_start
MSG: geometry_msgs/TransformStamped
Header header
string child_frame_id
Transform transform
MSG: moveit_msgs/AllowedCollisionMatrix
string[] entry_names
AllowedCollisionEntry[] entry_values
string[] default_entry_names
bool[] default_entry_values
MSG: moveit_msgs/AllowedCollisionEntry
bool[] enabled
MSG: moveit_msgs/LinkPadding
string link_name
float64 padding
MSG: moveit_msgs/LinkScale
string link_name
float64 scale
MSG: moveit_msgs/ObjectColor
string id
std_msgs/ColorRGBA color
MSG: std_msgs/ColorRGBA
float32 r
float32 g
float32 b
float32 a
MSG: moveit_msgs/PlanningSceneWorld
CollisionObject[] collision_objects
octomap_msgs/OctomapWithPose octomap
MSG: octomap_msgs/OctomapWithPose
Header header
geometry_msgs/Pose origin
octomap_msgs/Octomap octomap
MSG: octomap_msgs/Octomap
Header header
bool binary
string id
float64 resolution
int8[] data
"""


def definition(without=(), changed=()):
    """The text that a publisher sends. without: lines to leave out; changed: pairs of a line and another one."""
    text = _SCENE + _OTHERS
    for line in without:
        assert "\n" + line + "\n" in text, line
        text = text.replace("\n" + line + "\n", "\n")
    for line, other in changed:
        assert "\n" + line + "\n" in text, line
        text = text.replace("\n" + line + "\n", "\n" + other + "\n")
    return text.replace("\nMSG: ", "\n" + "=" * 80 + "\nMSG: ")


def older_definition():
    """Before CollisionObject.pose and subframes."""
    return definition(changed=[("geometry_msgs/Pose pose\nstring id", "string id"),
                               ("string[] subframe_names\ngeometry_msgs/Pose[] subframe_poses\nbyte ADD=0", "byte ADD=0")])


@functools.lru_cache(maxsize=None)
def message_classes(text=None):
    """Classes by type, of a definition or of the newest one."""
    return genpy.dynamic.generate_dynamic(PLANNING_SCENE, text or definition())

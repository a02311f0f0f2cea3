"""Forward and inverse kinematics of a chain read from a URDF, for planning the robot demo."""

import xml.etree.ElementTree as ElementTree

import numpy as np

from . import poses


def _origin(element):
    pose = np.eye(4)
    if element is not None:
        pose[:3, 3] = [float(v) for v in element.get("xyz", "0 0 0").split()]
        roll, pitch, yaw = (float(v) for v in element.get("rpy", "0 0 0").split())
        pose[:3, :3] = poses.rotation("z", yaw) @ poses.rotation("y", pitch) @ poses.rotation("x", roll)
    return pose


class Chain:
    """A serial chain whose joints all turn about z, as the WAM's do."""

    def __init__(self, urdf_path, tip_offset):
        root = ElementTree.parse(urdf_path).getroot()
        self._joints = []
        self.limits = []
        self.joint_names = []
        for joint in root.findall("joint"):
            moving = joint.get("type") == "revolute"
            self._joints.append((joint.find("parent").get("link"), joint.find("child").get("link"),
                                 _origin(joint.find("origin")), moving))
            if moving:
                limit = joint.find("limit")
                self.limits.append((float(limit.get("lower")), float(limit.get("upper"))))
                self.joint_names.append(joint.get("name"))
        self.limits = np.array(self.limits)
        self._tip = np.array([0.0, 0.0, tip_offset, 1.0])
        self._last = self._joints[-1][1]

    def poses(self, positions):
        """Pose of every link in the root's frame."""
        result = {self._joints[0][0]: np.eye(4)}
        number = 0
        for parent, child, origin, moving in self._joints:
            turn = np.eye(4)
            if moving:
                turn[:3, :3] = poses.rotation("z", positions[number])
                number += 1
            result[child] = result[parent] @ origin @ turn
        return result

    def tip(self, positions):
        """Position of the tip and direction of the last z axis."""
        last = self.poses(positions)[self._last]
        return (last @ self._tip)[:3], last[:3, 2]

    def solve(self, position, direction, start, posture, iterations, direction_weight=0.35):
        """Damped least squares to a tip position and direction; what is free drifts to `posture`."""
        q = np.array(start, dtype=float)

        def residual(values):
            point, axis = self.tip(values)
            return np.concatenate([point - position, direction_weight * (axis - direction)])

        step = 1e-6
        for _ in range(iterations):
            error = residual(q)
            jacobian = np.array([(residual(q + step * unit) - error) / step for unit in np.eye(len(q))]).T
            change = -np.linalg.solve(jacobian.T @ jacobian + 1e-4 * np.eye(len(q)), jacobian.T @ error)
            null = np.eye(len(q)) - np.linalg.pinv(jacobian, rcond=1e-3) @ jacobian
            change += 0.1 * null @ (posture - q)
            q = np.clip(q + np.clip(change, -0.2, 0.2), self.limits[:, 0] + 0.02, self.limits[:, 1] - 0.02)
        return q, float(np.linalg.norm(residual(q)))

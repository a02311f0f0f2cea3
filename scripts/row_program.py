"""The program that follow_rows.py solves in each step, and the kinematics of the tip that it needs. Without ROS."""

import xml.etree.ElementTree as ElementTree

import cvxopt
import cvxopt.solvers
import numpy as np

SLACK_COST = 30.0  # of a row that cannot hold, against 1 for a tip at full speed in the wrong direction


def rotation(axis, angle):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def numbers(element, key, default):
    return np.array((default if element is None else element.get(key, default)).split(), float)


def placed(origin):
    """4 x 4 matrix of a URDF's <origin>."""
    pose = np.eye(4)
    pose[:3, 3] = numbers(origin, "xyz", "0 0 0")
    roll, pitch, yaw = numbers(origin, "rpy", "0 0 0")
    pose[:3, :3] = rotation((0, 0, 1), yaw) @ rotation((0, 1, 0), pitch) @ rotation((1, 0, 0), roll)
    return pose


class Chain:
    """The joints of a URDF from its root to the tip, a point of its last link; others may only be fixed."""

    def __init__(self, description, link, point):
        joint_of = {joint.find("child").get("link"): joint for joint in ElementTree.fromstring(description).findall("joint")}
        self.joints, self.tip = [], np.append(point, 1.0)
        while link in joint_of:
            self.joints.insert(0, joint_of[link])
            link = joint_of[link].find("parent").get("link")
        moving = [joint for joint in self.joints if joint.get("type") != "fixed"]
        self.names = [joint.get("name") for joint in moving]
        self.lower, self.upper, self.speeds = (numbers(None, "", " ".join(joint.find("limit").get(key) for joint in moving))
                                               for key in ("lower", "upper", "velocity"))

    def tip_at(self, positions):
        """Where the tip is (3), and its Jacobian (3 x joints), in the root's frame."""
        pose, axes, left = np.eye(4), [], list(positions)
        for joint in self.joints:
            pose = pose @ placed(joint.find("origin"))
            if joint.get("type") == "fixed":
                continue
            axis, step = numbers(joint.find("axis"), "xyz", "1 0 0"), np.eye(4)
            axes.append((joint.get("type") == "prismatic", pose[:3, :3] @ axis, pose[:3, 3].copy()))
            if axes[-1][0]:
                step[:3, 3] = left.pop(0) * axis
            else:
                step[:3, :3] = rotation(axis, left.pop(0))
            pose = pose @ step
        tip = (pose @ self.tip)[:3]
        return tip, np.array([axis if slides else np.cross(axis, tip - at) for slides, axis, at in axes]).T


class Task:
    """Brings the tip to a goal and, where that leaves a choice, joints to a posture. `pace`: of the speeds' limits."""

    def __init__(self, description, task, pace):
        self.chain = Chain(description, task["tip"]["link"], task["tip"]["point"])
        names = self.chain.names
        self.name, self.bodies, self.text_at = task["name"], task["bodies"], task["text_at"]
        self.start = np.array([float(task["start"][name]) for name in names])
        self.goal = np.array(task["goal"], float)
        self.posture = np.array([float(task.get("posture", {}).get(name, np.nan)) for name in names])
        self.approach, self.weight, self.tolerance = task["approach"], task["posture_weight"], task["tolerance"]
        self.speeds, self.tip_speed = pace * self.chain.speeds, pace * task["tip_speed"]

    def wish(self, positions):
        """matrix, vector: matrix * w shall come near the vector; w: velocities as parts of their limits."""
        tip, jacobian = self.chain.tip_at(positions)
        desired = self.approach * (self.goal - tip) / self.tip_speed
        rest = np.nan_to_num(self.approach * (self.posture - positions) / self.speeds)
        return (np.vstack([jacobian * self.speeds / self.tip_speed, self.weight * np.eye(len(rest))]),
                np.concatenate([desired / max(1.0, np.linalg.norm(desired)), self.weight * np.clip(rest, -1.0, 1.0)]))

    def is_done(self, tip):
        return np.linalg.norm(self.goal - tip) < self.tolerance

    def velocities(self, positions, rows, margin, gain):
        """The program: as near to the wish as limits and jacobian * v >= drift - gain * (value - margin) allow."""
        count = len(positions)
        matrix, vector = self.wish(positions)
        hessian, linear = np.eye(count + 1), np.append(-matrix.T @ vector, SLACK_COST)  # the last unknown is a slack
        hessian[:count, :count] = matrix.T @ matrix
        highest = np.minimum(1.0, gain * (self.chain.upper - positions) / self.speeds)
        lowest = np.maximum(-1.0, gain * (self.chain.lower - positions) / self.speeds)
        jacobian = np.array([row.jacobian for row in rows]).reshape(-1, count) * self.speeds
        bounds = np.array([(row.drift if row.has_drift else 0.0) - gain * (row.value - margin) for row in rows])
        binding = bounds > -np.abs(jacobian).sum(axis=1)  # the others hold at any velocity within the limits
        jacobian, bounds = jacobian[binding], bounds[binding]
        sizes = np.maximum(1e-6, np.abs(jacobian).max(axis=1, initial=0.0))  # m/s
        left = np.vstack([np.eye(count + 1)[:count], -np.eye(count + 1),
                          np.hstack([-jacobian / sizes[:, None], -np.ones((len(bounds), 1))])])
        right = np.concatenate([highest, -lowest, [0.0], -bounds / sizes])
        problem = [cvxopt.matrix(part) for part in (hessian, linear, left, right)]
        for correction in (True, False):  # Mehrotra's correction goes round in circles on some of these programs
            solution = cvxopt.solvers.qp(*problem, options={"show_progress": False, "use_correction": correction})
            if solution["status"] == "optimal":
                break
        else:
            raise SystemExit("the quadratic program is not solved: " + solution["status"])
        return np.array(solution["x"]).ravel()[:count] * self.speeds

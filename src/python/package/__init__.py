"""Distances and niches (every local minimum of the distance) between bodies, convex or concave.

Begin with load_body and PairTracker, or load_scene and SceneTracker. Metres, radians, seconds. The messages of a build
with ROS are in concave_distance.msg and concave_distance.srv.
"""

__all__ = [
    "Answers",
    "BodyMesh",
    "Clearance",
    "ClearanceStatus",
    "ConstraintRows",
    "Constraints",
    "Error",
    "NicheKind",
    "NicheOrigin",
    "Outwardness",
    "PairState",
    "PairTracker",
    "RepairReport",
    "Scene",
    "SceneAnswers",
    "SceneTracker",
    "SignedState",
    "SlotState",
    "Status",
    "UnlistedReason",
    "descriptions_of_scene",
    "find_clearance",
    "find_clearance_of_body",
    "load_body",
    "load_robot",
    "load_scene",
    "make_body",
    "make_box",
    "make_capsule",
    "make_cylinder",
    "make_sphere",
    "parameters",
    "solve_each",
]


def __getattr__(name):
    # The library is loaded at its first use: nodes that import messages alone do without it.
    names = __all__ + ["__version__"]
    if name not in names:
        raise AttributeError("module '{}' has no attribute '{}'".format(__name__, name))
    from concave_distance import _concave_distance

    globals().update((known, getattr(_concave_distance, known)) for known in names)
    return globals()[name]


def __dir__():
    return sorted(set(globals()) | set(__all__))

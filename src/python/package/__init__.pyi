from enum import IntEnum
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, SupportsIndex, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

_Limit = Union[float, str, None]

class Error(RuntimeError):
    where: str
    what: str
    remedy: str

class Status(IntEnum):
    OK = 0
    PENETRATING = 1
    INVALID_POSE = 2
    BUDGET_EXHAUSTED = 3
    WITHIN_TOLERANCE = 4
    MEMORY_EXHAUSTED = 5

class NicheKind(IntEnum):
    POINT = 0
    SEGMENT = 1
    PATCH = 2

class Outwardness(IntEnum):
    OUTWARD = 0
    THROUGH_MATERIAL = 1
    UNKNOWN = 2

class NicheOrigin(IntEnum):
    INHERITED = 0
    EVOLVED = 1
    FROM_CONES = 2
    PROVEN = 3

class SignedState(IntEnum):
    NOT_ASKED = 0
    KNOWN = 1
    OPEN_SURFACE = 2
    CROSSED_SHELLS = 3
    NO_CLOSED_FORM = 4
    UNFINISHED = 5

class ClearanceStatus(IntEnum):
    OK = 0
    PENETRATING = 1
    BUDGET_EXHAUSTED = 2
    NO_PAIRS = 3

class SlotState(IntEnum):
    FREE = 0
    USED = 1
    FREED = 2

class UnlistedReason(IntEnum):
    NO_POSE = 0
    UNSOLVED = 1
    UNFINISHED = 2
    BEYOND_CUTOFF = 3
    NO_SLOT = 4

class PairState(IntEnum):
    NOT_WATCHED = 0
    NOT_LOCATED = 1
    BEYOND_CUTOFF = 2
    SOLVED = 3
    STOPPED = 4

class Answers:
    @property
    def rows(self) -> NDArray[np.void]: ...
    @property
    def niches(self) -> NDArray[np.void]: ...
    @property
    def niche_offsets(self) -> NDArray[np.int64]: ...
    def niches_of(self, row: SupportsIndex) -> NDArray[np.void]: ...
    def __len__(self) -> int: ...

class SceneAnswers(Answers):
    @property
    def pairs(self) -> List[str]: ...
    @property
    def bodies(self) -> NDArray[np.int64]: ...
    @property
    def states(self) -> NDArray[np.uint8]: ...
    @property
    def bounds(self) -> NDArray[np.float64]: ...
    @property
    def warnings(self) -> NDArray[np.uint8]: ...
    @property
    def beyond(self) -> int: ...

class RepairReport:
    @property
    def vertices_in(self) -> int: ...
    @property
    def triangles_in(self) -> int: ...
    @property
    def welded_vertices(self) -> int: ...
    @property
    def largest_move(self) -> float: ...
    @property
    def zero_area_triangles(self) -> int: ...
    @property
    def duplicate_triangles(self) -> int: ...
    @property
    def inner_wall_triangles(self) -> int: ...
    @property
    def turned_triangles(self) -> int: ...
    @property
    def shells(self) -> int: ...
    @property
    def closed_shells(self) -> int: ...
    @property
    def holes(self) -> int: ...
    @property
    def border_edges(self) -> int: ...
    @property
    def non_manifold_edges(self) -> int: ...

class BodyMesh:
    @property
    def name(self) -> str: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def triangles(self) -> NDArray[np.uint32]: ...
    @property
    def area(self) -> float: ...
    @property
    def volume(self) -> float: ...
    @property
    def diameter(self) -> float: ...
    @property
    def shells(self) -> int: ...
    @property
    def repair(self) -> RepairReport: ...

def load_body(path: str, scale: float = 1.0, *, max_edge_length: Optional[float] = None) -> BodyMesh: ...
def make_body(
    vertices: ArrayLike, triangles: ArrayLike, name: str = "body", *, weld_tolerance: float = 2e-7, orient: bool = True
) -> BodyMesh: ...
def make_box(size: Sequence[float], name: str = "box") -> BodyMesh: ...
def make_sphere(radius: float, name: str = "sphere", *, chord_error: Optional[float] = None) -> BodyMesh: ...
def make_cylinder(
    radius: float, length: float, name: str = "cylinder", *, chord_error: Optional[float] = None
) -> BodyMesh: ...
def make_capsule(
    radius: float, length: float, name: str = "capsule", *, chord_error: Optional[float] = None
) -> BodyMesh: ...
def parameters(of_scene: bool = False) -> List[Dict[str, Any]]: ...
def solve_each(
    body_a: BodyMesh, body_b: BodyMesh, poses: ArrayLike, *, name: str = "pair", threads: int = 0, **parameters: Any
) -> Answers: ...

class PairTracker:
    def __init__(
        self,
        body_a: BodyMesh,
        body_b: BodyMesh,
        *,
        name: str = "pair",
        accuracy: str = ...,
        absolute_tolerance: float = ...,
        relative_tolerance: float = ...,
        time_budget: _Limit = ...,
        cutoff: _Limit = ...,
        least_prominence: float = ...,
        largest_niche_count: int = ...,
        hidden: bool = ...,
        seed: int = ...,
        facet_pair_limit: int = ...,
        prominence_limit: _Limit = ...,
        keep_through_material: bool = ...,
        signed_values: bool = ...,
        inherited_per_niche: float = ...,
        inherited_limit: int = ...,
        random_starts: int = ...,
        search_share: float = ...,
        margin_a: float = ...,
        margin_b: float = ...,
        niches_wanted: bool = ...,
    ) -> None: ...
    def update(self, poses: ArrayLike, times: Optional[ArrayLike] = None) -> Answers: ...
    def solve(self, poses: ArrayLike) -> Answers: ...
    def restart(self) -> None: ...
    def set_parameters(self, **parameters: Any) -> None: ...
    @property
    def parameters(self) -> Dict[str, Any]: ...
    @property
    def body_a(self) -> BodyMesh: ...
    @property
    def body_b(self) -> BodyMesh: ...

class Scene:
    @property
    def body_names(self) -> List[str]: ...
    @property
    def body_frames(self) -> List[str]: ...
    @property
    def poses_in_frames(self) -> NDArray[np.float64]: ...
    @property
    def problems(self) -> List[Tuple[str, str]]: ...
    @property
    def warnings(self) -> List[str]: ...
    @property
    def notes(self) -> List[str]: ...
    @property
    def robot_names(self) -> List[str]: ...
    @property
    def position_names(self) -> List[str]: ...
    @property
    def velocity_names(self) -> List[str]: ...
    @property
    def rest_positions(self) -> NDArray[np.float64]: ...
    def poses_of_bodies(self, positions: ArrayLike, roots: Optional[ArrayLike] = None) -> NDArray[np.float64]: ...

def load_scene(
    path: str,
    *,
    package_folders: Sequence[str] = (),
    mesh_folders: Sequence[str] = (),
    strict: bool = False,
    descriptions: Mapping[str, str] = ...,
    geometry: str = "collision",
    **parameters: Any,
) -> Scene: ...
def descriptions_of_scene(path: str) -> List[str]: ...
def load_robot(
    urdf: str,
    srdf: Optional[str] = None,
    *,
    package_folders: Sequence[str] = (),
    mesh_folders: Sequence[str] = (),
    strict: bool = False,
    geometry: str = "collision",
    skip_overlapping_pairs: bool = False,
    automatic_cutoff: bool = False,
    **parameters: Any,
) -> Scene: ...

class SceneTracker:
    def __init__(
        self, scene: Scene, threads: int = 0, *, pairs: Sequence[str] = (), time_budgets: bool = True
    ) -> None: ...
    def update(
        self, poses: ArrayLike, time: float, *, niches_wanted: bool = True, moved: Optional[ArrayLike] = None
    ) -> SceneAnswers: ...
    def nearest(self, poses: ArrayLike) -> NDArray[np.void]: ...
    def restart(self) -> None: ...
    @property
    def scene(self) -> Scene: ...

class Constraints:
    @property
    def rows(self) -> NDArray[np.void]: ...
    @property
    def jacobian(self) -> NDArray[np.float64]: ...
    @property
    def pairs(self) -> List[str]: ...
    @property
    def unlisted(self) -> NDArray[np.void]: ...
    @property
    def reach(self) -> NDArray[np.float64]: ...
    @property
    def overflow(self) -> int: ...
    def __len__(self) -> int: ...

class ConstraintRows:
    def __init__(self, scene: Scene, *, distance: float = 0.1, capacity: int = 64, tilt: float = 0.0001) -> None: ...
    def update(
        self, tracker: SceneTracker, positions: ArrayLike, roots: Optional[ArrayLike] = None
    ) -> Constraints: ...
    def reset(self) -> None: ...
    @property
    def scene(self) -> Scene: ...

class Clearance:
    @property
    def status(self) -> ClearanceStatus: ...
    @property
    def distance(self) -> float: ...
    @property
    def lower_bound(self) -> float: ...
    @property
    def time(self) -> float: ...
    @property
    def bodies(self) -> Optional[Tuple[str, str]]: ...
    @property
    def point_a(self) -> NDArray[np.float64]: ...
    @property
    def point_b(self) -> NDArray[np.float64]: ...
    @property
    def world_from_a(self) -> NDArray[np.float64]: ...
    @property
    def solution(self) -> Optional[Answers]: ...
    @property
    def first_below(self) -> float: ...
    @property
    def first_below_bodies(self) -> Optional[Tuple[str, str]]: ...
    @property
    def proven_until(self) -> float: ...
    @property
    def pairs(self) -> NDArray[np.void]: ...
    @property
    def not_located(self) -> List[str]: ...
    @property
    def outside_limits(self) -> List[str]: ...
    @property
    def velocities_ignored(self) -> bool: ...
    @property
    def queries(self) -> int: ...
    @property
    def box_queries(self) -> int: ...
    @property
    def seconds(self) -> float: ...

def find_clearance(
    scene: Scene,
    positions: ArrayLike,
    times: Optional[ArrayLike] = None,
    *,
    velocities: Optional[ArrayLike] = None,
    accelerations: Optional[ArrayLike] = None,
    joints: Optional[Sequence[str]] = None,
    start: Optional[ArrayLike] = None,
    roots: Optional[ArrayLike] = None,
    bodies: Optional[ArrayLike] = None,
    tolerance: float = 0.001,
    threshold: Optional[float] = None,
    time_budget: Optional[float] = None,
    sample_limit: int = 2000000,
    each_pair: bool = False,
    niches: bool = False,
    threads: int = 0,
    progress: Optional[Callable[[float, float, float, int], object]] = None,
) -> Clearance: ...
def find_clearance_of_body(
    scene: Scene,
    body: str,
    poses: ArrayLike,
    times: Optional[ArrayLike] = None,
    *,
    start: Optional[ArrayLike] = None,
    roots: Optional[ArrayLike] = None,
    bodies: Optional[ArrayLike] = None,
    tolerance: float = 0.001,
    threshold: Optional[float] = None,
    time_budget: Optional[float] = None,
    sample_limit: int = 2000000,
    each_pair: bool = False,
    niches: bool = False,
    threads: int = 0,
    progress: Optional[Callable[[float, float, float, int], object]] = None,
) -> Clearance: ...

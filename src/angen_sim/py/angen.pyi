# src/angen_sim/py/make_stub.py writes this file. Its text is in the C++ sources.
import typing
from collections.abc import Mapping, Sequence

import numpy
import numpy.typing

__version__: str


class Error(ValueError):
    ...


class Kind:
    """The verbs and fields of a kind, to describe."""

    def verb(self, name: str, doc: str, argument: str = '', unit: str = '', min: float = -float('inf'), max: float = float('inf'), whole: bool = False) -> Kind:
        ...

    def flag(self, name: str, doc: str) -> Kind:
        ...

    def integer(self, name: str, unit: str, doc: str) -> Kind:
        ...

    def number(self, name: str, unit: str, doc: str) -> Kind:
        ...

    def text(self, name: str, doc: str) -> Kind:
        ...

    def choice(self, name: str, words: Sequence[str], doc: str) -> Kind:
        ...

    def numbers(self, name: str, unit: str, doc: str) -> Kind:
        ...

    def texts(self, name: str, doc: str) -> Kind:
        ...

    def shown(self, decimals: int = 0) -> Kind:
        ...

    def shown_as(self, yes: str, no: str) -> Kind:
        ...

    def alarm(self, yes: str, no: str) -> Kind:
        ...

    def events(self, begin: str, end: str, in_alarm: bool = True) -> Kind:
        ...


class Params:
    """A plug-in's parameters; a wrong value raises angen.Error."""

    def number(self, path: str, default: float, unit: str = '', doc: str = '', min: float = -float('inf'), max: float = float('inf')) -> float:
        ...

    def noise(self, field: str, unit: str = '', doc: str = '', relative: bool = False) -> float:
        """Reads <noise_stddev>, of Gaussian noise that is added to this key of read()."""

    def flag(self, path: str, default: bool, doc: str = '') -> bool:
        ...

    def text(self, path: str, default: str, doc: str = '') -> str:
        ...


class JointRef:
    ...


class LinkRef:
    ...


class LightRef:
    ...


class SurfaceRef:
    ...


class Wiring:
    """Names of the model to handles; unknown names raise."""

    @property
    def name(self) -> str:
        ...

    @property
    def model(self) -> str:
        ...

    def has_joint(self, name: str) -> bool:
        ...

    def joint(self, name: str) -> JointRef:
        ...

    def link(self, name: str) -> LinkRef:
        ...

    def light(self, name: str) -> LightRef:
        ...

    def surfaces(self, visual: str = '') -> list[SurfaceRef]:
        """Visuals of that name, or all, that a collision has its surface from."""

    def mass(self, link: LinkRef) -> float:
        """kg, of the link and all that is fixed to it"""


class View:
    """What a plug-in may see; SI units, world frame."""

    @property
    def time(self) -> float:
        """s"""

    @property
    def step(self) -> float:
        """s"""

    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64]:
        """x y z qx qy qz qw"""

    @property
    def rotation(self) -> numpy.typing.NDArray[numpy.float64]:
        """3x3, of the pose"""

    def joint(self, joint: JointRef) -> tuple[float, float, float]:
        """position, velocity, effort: rad or m, N m or N"""

    def link(self, link: LinkRef) -> numpy.typing.NDArray[numpy.float64]:
        """x y z qx qy qz qw"""

    def devices(self, field: str) -> list[typing.Any]:
        """name, pose of the model and state, as a dict, of each device whose state has `field`"""


class Outputs:
    """What a device may do in one tick."""

    def force(self, joint: JointRef, effort: float) -> None:
        """N or N m on a joint, for this tick"""

    def motor(self, joint: JointRef, velocity: float, max_effort: float) -> None:
        """velocity, greatest force; until changed"""

    def light(self, light: LightRef, level: float, flux: float) -> None:
        """level 0..1, luminous flux in lm at level 1"""

    def temperature(self, surface: SurfaceRef, now: float, limit: float, time_constant: float = 0.0) -> None:
        """K of a surface: from now to a limit, exponentially with a time constant in s"""

    def event(self, event: str, detail: str = '') -> None:
        ...


class Rng:
    """Random numbers of this sensor at this tick."""

    def uniform(self) -> float:
        ...

    def gaussian(self) -> float:
        ...


class Sensor:
    """A sensor in Python. Override configure(params, wiring), aim(view) -> (n, 8) rows of
    origin, direction, min, max (m, world frame) or None, and read(view, ranges, rng) -> dict.
    After read(), idle_until(view) says when (s) it may next return other values, as long as
    its pose and all that it queried stay the same: math.inf without a memory, 0 for the next
    time. `fields` declares the keys of that dict, as {'range': 'number m', 'hit': 'flag'}:
    type and unit; types are flag, integer, number, text, numbers and texts. None are
    declared: any are taken. describe(kind) (static) declares them with docs and words, see
    Kind."""

    fields: dict[str, str]

    rate: float

    sample_period: float

    @staticmethod
    def describe(kind: Kind) -> None:
        ...

    def configure(self, params: Params, wiring: Wiring) -> None:
        ...

    def aim(self, view: View) -> numpy.typing.ArrayLike | None:
        ...

    def read(self, view: View, ranges: numpy.typing.NDArray[numpy.float64], rng: Rng) -> dict[str, typing.Any]:
        ...

    def idle_until(self, view: View) -> float:
        ...


class Device:
    """A device in Python. Override serves(model, joints, lights) -> bool (static),
    configure(params, wiring), command(text, values, view) -> None or a reason to reject,
    update(view, outputs) and report(view) -> dict, whose keys `fields` declares, as of a
    Sensor. describe(kind) (static) declares verbs too, as kind.verb('Dim', 'dims it',
    'percent', '%', min=0, max=100)."""

    fields: dict[str, str]

    @staticmethod
    def describe(kind: Kind) -> None:
        ...

    @staticmethod
    def serves(model: str, joints: list[str], lights: list[str]) -> bool:
        ...

    def configure(self, params: Params, wiring: Wiring) -> None:
        ...

    def command(self, text: str, values: list[float], view: View) -> str | None:
        ...

    def update(self, view: View, outputs: Outputs) -> None:
        ...

    def report(self, view: View) -> dict[str, typing.Any]:
        ...


class World:
    """A world that advances by step() and run()."""

    def __init__(self, path: str, seed: int = 0, record: str = '', allow_paths: bool = False, memory_limit: typing.Optional[float] = None) -> None:
        """Loads a world file (SDF); `record` is a file for the log that Replay reads. With
        allow_paths, models may name files and plug-in libraries anywhere. One that would take
        more than `memory_limit` MB is rejected; see set_memory_limit."""

    def motion(self, name: str) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        """Of a model, model::link or model::link::collision: x y z qx qy qz qw, m/s, rad/s, in the
        world."""

    def set_state(self, model: str, pose: Sequence[float], linear: numpy.typing.ArrayLike = [0.0, 0.0, 0.0], angular: numpy.typing.ArrayLike = [0.0, 0.0, 0.0], frame: str = '') -> None:
        """Puts a model somewhere, with its present joint positions; pose is x y z roll pitch yaw."""

    def set_joints(self, model: str, positions: Mapping[str, float]) -> None:
        """Joints to positions, rad or m."""

    def push(self, link: str, force: numpy.typing.ArrayLike, torque: numpy.typing.ArrayLike = [0.0, 0.0, 0.0], *, seconds: float) -> None:
        """A force (N) at the center of mass of model::link, and a torque."""

    @property
    def shapes(self) -> list[tuple]:
        """Shapes of collisions: (model, link, type, moves, vertices). The vertices, (n, 3) in m in
        the world, have the shape as their convex hull, of a mesh as its corners; a plane and a
        heightmap have none. Round shapes are within 0.2 % of their radius."""

    def joint(self, name: str) -> dict[str, typing.Any]:
        """A model::joint as a dict: type, model, child (a link), position (rad or m), anchor and
        axis in the world, limits of its first axis."""

    def field_of_view(self, kind: str, name: str) -> typing.Any:
        """Horizontal limits (rad, left is positive) and range (m) of a sensor's field of view; None
        if it has none."""

    def detection_rays(self, kind: str, name: str) -> typing.Any:
        """(n, 8) rows of origin, direction, min, max (m, in the world): where a sensor with rays or
        zones detects, whatever hides that; a zone has nine. None if it has none."""

    def cast(self, origins: numpy.typing.ArrayLike, directions: numpy.typing.ArrayLike, reach: typing.Union[float, numpy.typing.ArrayLike]) -> numpy.typing.NDArray[numpy.float64]:
        """Ranges (n,) in m of rays from origins (n, 3) along unit directions (n, 3), in the world,
        against the shapes as they are now; `reach` (m, a number or (n,)) of rays that hit nothing
        within it."""

    @staticmethod
    def from_text(text: str, seed: int = 0, allow_paths: bool = False, memory_limit: typing.Optional[float] = None) -> World:
        """Loads a world from SDF text."""

    def step(self, ticks: int = 1) -> None:
        """Advances by ticks, each of them taken."""

    def run(self, seconds: float, long_steps: bool = False, until_event: bool = False) -> None:
        """Advances by simulated seconds; ticks in which nothing happens are leapt over. With
        long_steps ticks are up to 20 ms long while nothing moves but people and leaves free of
        contact. With until_event it ends earlier: with the tick of the first event."""

    def command(self, kind: str, name: str, text: str = '', values: Sequence[float] = []) -> None:
        """Commands a device, e.g. ('door', 'bathroom1', 'Open'); ('drive', 'turtlebot', values=[0.3,
        0.0]) in m/s and rad/s."""

    def spawn(self, what: str, name: str = '', pose: Sequence[float] = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0], on: str = '') -> None:
        """Adds a model (SDF text, path or model:// uri), or a <sensor> to the link `on`; pose is x y
        z roll pitch yaw (m, rad)."""

    def delete(self, name: str) -> None:
        """Deletes a model or a sensor."""

    def request(self, kind: str, name: str, wanted: bool = True) -> None:
        """Sensors that sample on demand (lidar, camera, depth) do so while they are requested."""

    def close(self) -> None:
        """Ends its record; it can be read, and advances no more."""

    def __enter__(self) -> World:
        ...

    def __exit__(self, *args: object) -> None:
        """Calls close()."""

    def __repr__(self) -> str:
        ...

    def reset(self) -> None:
        """Everything back to its start, the time to 0."""

    def save(self) -> str:
        """The present world as SDF text."""

    def sensor(self, kind: str, name: str) -> dict[str, typing.Any]:
        """The latest reading of a sensor, as a dict."""

    def device(self, kind: str, name: str) -> dict[str, typing.Any]:
        """The latest state of a device, as a dict."""

    def summary(self, kind: str, name: str) -> str:
        """A sensor's reading or a device's state in a few words, as /angen/summary shows it; ''
        before the first."""

    def summaries(self) -> list[tuple[str, str, str, bool, float, list[float]]]:
        """Each sensor and device: (kind, name, summary, alarm, stamp, values); the values (nan:
        missing) are of the fields that are flags or numbers."""

    def sensors(self, kind: str = '') -> list[str]:
        ...

    def devices(self, kind: str = '') -> list[str]:
        ...

    def entities(self, kind: str = '') -> list[tuple[str, str, str, numpy.typing.NDArray[numpy.float64]]]:
        """Devices and sensors: (kind, name, model, pose); pose is x y z qx qy qz qw in the world, of
        a sensor, or of the first link of a device's model."""

    @property
    def time(self) -> float:
        """s"""

    @property
    def tick(self) -> int:
        ...

    @property
    def models(self) -> list[str]:
        ...

    @property
    def links(self) -> list[str]:
        """model::link, in the order of link_poses' rows"""

    @property
    def joints(self) -> list[str]:
        ...

    @property
    def lights(self) -> list[str]:
        ...

    @property
    def link_poses(self) -> numpy.typing.NDArray[numpy.float64]:
        """(links, 7): x y z qx qy qz qw, world frame"""

    @property
    def joint_positions(self) -> numpy.typing.NDArray[numpy.float64]:
        """(joints,): rad or m"""

    @property
    def light_levels(self) -> list[float]:
        """0..1, in the order of lights"""

    @property
    def awake_bodies(self) -> int:
        ...

    @property
    def failed_steps(self) -> int:
        ...

    @property
    def readings(self) -> int:
        ...

    @property
    def home(self) -> dict[str, typing.Any]:
        """The home: its storeys, rooms, things, doors and elevators, as a dict; docs/home.md."""

    @property
    def revision(self) -> int:
        """of its parts: another one after each spawn and deletion"""

    @property
    def scene(self) -> dict[str, typing.Any]:
        """What viewers draw, as a dict: links with their groups and poses, shapes, meshes, lights
        and the fields of sensors, as angen_msgs/Scene has them."""

    def room_at(self, x: float, y: float, z: float) -> str:
        """The name of the room that a place is in, or in whose wall, floor or ceiling; '' outside."""

    def home_findings(self) -> list[tuple[str, str]]:
        """Missing and wrong parts in the description of the home: ('guessed' or 'contradicting',
        what)."""

    @property
    def fingerprint(self) -> str:
        """a hash of every snapshot since the start or the last reset"""

    @property
    def warnings(self) -> list[str]:
        """warnings about the loaded files: 'file:line: text'"""

    @property
    def ignored(self) -> list[str]:
        """unread elements of the loaded files: 'file:line: <element> in <parent>'"""

    def events(self) -> list[tuple[float, str, str, str, str]]:
        """What happened since the last call: (time, source, kind, event, detail)."""

    def keep_readings(self) -> None:
        """Keeps all that sensors publish from now on, for take_readings()."""

    def take_readings(self) -> dict[str, typing.Any]:
        """The readings since the last call, as columns: time (s), series, value, and texts: {row:
        text}. `series` has numbers of rows in reading_series. Lists and images are left out."""

    @property
    def reading_series(self) -> list[tuple[str, str, str, str, str]]:
        """Of the readings that are kept: (kind, name, field, unit, type)."""


class Grid:
    """A floor in square cells, from above: `cells` (rows, columns) of numbers, row 0 with the
    lowest y; `origin` is x, y (m) of the outer corner of cell 0, 0."""

    def __init__(self, cells: numpy.typing.ArrayLike, origin: tuple[float, float], resolution: float, floor: int = 0, height: float = 0.0) -> None:
        ...

    WALL: int

    FREE: int

    @property
    def cells(self) -> numpy.ndarray:
        """int32, to read and to write"""

    @property
    def origin(self) -> tuple[float, float]:
        ...

    @property
    def resolution(self) -> float:
        """m, the side of a cell"""

    @property
    def floor(self) -> int:
        """the number of its storey"""

    @property
    def height(self) -> float:
        """z of that floor, m"""

    @property
    def x(self) -> numpy.typing.NDArray[numpy.float64]:
        """(columns,): of the middles of cells, m"""

    @property
    def y(self) -> numpy.typing.NDArray[numpy.float64]:
        """(rows,): of the middles of cells, m"""

    @property
    def extent(self) -> tuple[typing.Any, ...]:
        """West, east, south and north edge, m, as imshow of matplotlib takes them."""

    def cell(self, x: float, y: float) -> tuple[int, int]:
        """(row, column) of a point (m); may be beyond the raster."""

    def point(self, row: int, column: int) -> tuple[float, float]:
        """x, y (m) of a cell's middle."""

    def with_cells(self, cells: numpy.typing.ArrayLike) -> Grid:
        """One of other cells at the same place."""

    def fill(self, polygon: Sequence[tuple[float, float]], value: int) -> None:
        """Sets the cells whose middles a polygon contains."""

    def number_parts(self) -> list[int]:
        """Numbers the connected parts of the cells that are FREE from 0; their sizes in cells."""

    def region(self, label: int, tolerance: float, least: float) -> typing.Any:
        """The outline of a label's cells, and its holes of more than `least` m2, as corners (m);
        corners off a straight line by less than `tolerance` (m) are left out."""


def storey_at(storeys: Sequence[tuple[int, float]], z: numpy.typing.ArrayLike) -> typing.Any:
    """Of storeys (number, elevation), from the lowest up, the number of the one at a height z:
    the highest whose floor is at most 0.5 m above it, or else the lowest; 0 without storeys.
    z may be an array."""


class Replay:
    """A recorded run, run again; see docs/replay.md."""

    def __init__(self, path: str, leap: bool = True) -> None:
        """Reads a log and builds its world. Without leap, each tick is taken."""

    def advance(self, seconds: float) -> bool:
        """Continues by simulated seconds, to the end at most; True while something is left."""

    def world(self) -> World:
        """The current world, to continue with. The replay ends."""

    @property
    def present(self) -> World:
        """The world as the replay has it: a World that can be read, and that advances with the
        replay."""

    @property
    def time(self) -> float:
        """s"""

    @property
    def end(self) -> float:
        """of the log, s"""

    @property
    def actions(self) -> int:
        """executed actions"""

    @property
    def compared(self) -> int:
        """fingerprints that were equal"""

    @property
    def mismatch(self) -> str:
        """the first fingerprint that differed; '' where all were equal"""

    @property
    def truncated(self) -> str:
        """the missing part of the log's end; '' where it is complete"""

    @property
    def seed(self) -> int:
        ...

    @property
    def path(self) -> str:
        """of the world's file"""


def register(filename: str, kind: str, type: typing.Any) -> None:
    """Makes a Python subclass of Sensor or Device a plug-in: <plugin filename="FILENAME">."""


def plugins() -> typing.Any:
    """Every kind of sensor and device on the plug-in path: a list of dicts with library, kind,
    doc, role, rate, on_demand, models, sensor_type, example, command_topic, verbs, fields and
    params, as `angen plugins --json` prints it."""


def check_name(name: str) -> str:
    """The name, if a model, sensor or device can have it; else Error says why."""


def memory_limit() -> float:
    """The most memory, in MB, that a world or model may be estimated to take."""


def set_memory_limit(megabytes: float) -> None:
    """Sets it for this process; ANGEN_MEMORY_LIMIT of the environment, or 4096, without."""

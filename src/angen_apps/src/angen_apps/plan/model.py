"""A floor plan, which importers and generators make and the writer of worlds reads.

Lengths in m, angles in rad, x to the right and y up on the page; heights z are of the world.
"""
from dataclasses import dataclass, field
from math import hypot, pi

from angen_tools.common.geometry import turned

Point = tuple[float, float]
Color = tuple[float, float, float]
WHITE: Color = (0.92, 0.92, 0.9)


@dataclass(frozen=True)
class Wall:
    """A straight wall by its center line; an arc is several of them."""

    start: Point
    end: Point
    thickness: float
    bottom: float
    top: float
    top_at_end: float | None = None  # a sloped top's height at the wall's end
    color: Color = WHITE
    part: int = 0  # number of the part of an arc

    @property
    def length(self) -> float:
        return hypot(self.end[0] - self.start[0], self.end[1] - self.start[1])


@dataclass(frozen=True)
class Leaf:
    """A leaf or sash in the frame of its opening (x along the wall, y across it).

    It is shut at the angle `shut` of its direction from the hinge, and turns by `turn`, or slides
    by `slide` along x.
    """

    hinge: Point
    width: float
    shut: float
    turn: float = 0.0
    slide: float = 0.0


@dataclass(frozen=True)
class Opening:
    """A hole in a wall: a door, a window, or a passage without a leaf (kind `opening`).

    The pose is the middle at the foot of the hole; `band` is the cut across the wall, in the
    opening's frame.
    """

    kind: str
    x: float
    y: float
    yaw: float
    width: float
    bottom: float
    top: float
    band: tuple[float, float]
    leaves: tuple[Leaf, ...] = ()
    glass: bool = False  # a fixed pane fills it
    glazed: bool = False  # its leaves are of glass
    ajar: bool = False  # open at the start
    filled: bool = False  # a piece of furniture closes it
    name: str = ''
    source: str = ''  # its name in the file

    def point(self, u: float, v: float) -> Point:
        """The plan's x, y of a point in the opening's frame."""
        return turned((self.x, self.y), self.yaw, u, v)


@dataclass(frozen=True)
class Room:
    """A room by the polygon of its floor."""

    name: str
    use: str
    polygon: tuple[Point, ...]
    floor: float
    ceiling: float  # height above the floor
    has_floor: bool = True
    has_ceiling: bool = True
    color: Color = (0.65, 0.55, 0.42)
    holes: tuple[tuple[Point, ...], ...] = ()


@dataclass(frozen=True)
class Piece:
    """A piece of furniture by the box around it; yaw is the direction that its front faces."""

    name: str
    x: float
    y: float
    z: float
    yaw: float
    width: float  # across the front
    depth: float
    height: float
    thing: str = ''
    model: str = ''  # a model of worlds/models
    shape: str = 'box'  # box, cylinder, stairs, curved_stairs, tray, shell, flat
    tilt: tuple[float, float] = (0.0, 0.0)  # roll, pitch
    color: Color = (0.75, 0.72, 0.66)
    mesh: str = ''  # file of its looks, in a unit box; a key of the plan's meshes
    source: str = ''


@dataclass(frozen=True)
class Lamp:
    """A lamp: the place of its light, and the flux at full power in lm."""

    name: str
    x: float
    y: float
    z: float
    flux: float
    color: Color = (1.0, 0.95, 0.85)
    source: str = ''


@dataclass(frozen=True)
class Sensor:
    """A sensor of one's own, beside those by rules; it faces the direction `yaw`, `pitch` down."""

    name: str
    model: str  # a model of worlds/models
    x: float
    y: float
    z: float
    yaw: float = 0.0
    pitch: float = 0.0


@dataclass(frozen=True)
class Planned:
    """What a person does, one after the other, at a usual time of day: it begins from `low` to
    `high`, s after midnight. Alone `wake` and `sleep` begin and end the day."""

    do: tuple[str, ...]
    low: float
    high: float
    days: str = 'all'
    chance: float = 1.0
    together: bool = False
    lasts: tuple[float, float] | None = None  # s, of the first


@dataclass(frozen=True)
class Mover:
    """A person or a robot that stands somewhere."""

    name: str
    kind: str  # person, robot
    x: float
    y: float
    yaw: float = 0.0
    habits: str = ''  # profile by which a person lives there, when its drawing is simulated
    day: tuple[Planned, ...] = ()  # its usual day, if it is not that of the profile


@dataclass(frozen=True)
class Label:
    """A name in a room that is found between walls."""

    name: str
    x: float
    y: float
    use: str = ''


@dataclass(frozen=True)
class Lift:
    """A lift: the middle of its cabin, its inner size, and the floors at which it stops."""

    name: str
    x: float
    y: float
    yaw: float  # direction of its doorway, from the cabin's middle
    width: float
    depth: float
    stops: tuple[int, ...]  # numbers of storeys
    doorway: float = 1.2  # m wide
    front: float = 0.0  # m from the cabin's middle to the floors of its landings, if it is far


@dataclass
class Storey:
    """A level of the home with all that is on it."""

    number: int
    name: str
    elevation: float
    height: float
    slab: float = 0.12  # thickness of its floor
    walls: list[Wall] = field(default_factory=list)
    openings: list[Opening] = field(default_factory=list)
    rooms: list[Room] = field(default_factory=list)
    pieces: list[Piece] = field(default_factory=list)
    lamps: list[Lamp] = field(default_factory=list)
    cutouts: list[tuple[Point, ...]] = field(default_factory=list)  # holes in its floor
    labels: list[Label] = field(default_factory=list)
    sensors: list[Sensor] = field(default_factory=list)
    movers: list[Mover] = field(default_factory=list)


@dataclass
class Plan:
    """A home. `remarks` list omissions, changes and guesses; `meshes` are OBJ texts by name."""

    name: str
    storeys: list[Storey]
    north: float = pi / 2
    latitude: float | None = None
    start: str = ''  # local time at simulated time 0, as 2026-03-23T07:00:00
    entrance: str = ''
    entrances: list[str] = field(default_factory=list)  # openings that may be it, the best first
    lifts: list[Lift] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    meshes: dict[str, str] = field(default_factory=dict)

    def all_rooms(self) -> list[Room]:
        return [room for storey in self.storeys for room in storey.rooms]

    def all_openings(self) -> list[Opening]:
        return [opening for storey in self.storeys for opening in storey.openings]

"""The apartment as numbers: rooms, openings, doors, and the places of things. Meters and radians.

Every pose is for floor 0; the same things are STOREY higher on each further floor.
"""
from dataclasses import dataclass
from math import pi

STOREY = 4.0
FLOORS = 2
NORTH = pi / 2          # +y
LATITUDE = 48.1         # degrees, of Munich
DAY = "2026-03-21"      # on which the worlds begin, at BEGINS
BEGINS = "06:00:00"
WALL = 0.1              # thickness
SLAB = 0.2              # floor slab, below z = 0
CEILING = 2.8           # underside of the ceiling slab
WALL_TOP = STOREY - SLAB    # outer walls reach the next storey's slab
OPENING_WIDTH = 1.0
OPENING_HEIGHT = 2.1
CABIN_TRAVEL = STOREY

# name: x0, y0, x1, y1 between wall axes
ROOMS = {
    "entrance": (0.0, 4.0, 6.8, 6.0),
    "kitchen": (0.0, 0.0, 4.0, 4.0),
    "livingroom": (4.0, 0.0, 10.0, 4.0),
    "bedroom": (0.0, 6.0, 4.0, 9.6),
    "workroom": (6.8, 4.0, 10.0, 9.6),
    "bathroom": (4.0, 6.0, 6.8, 9.6),
}
# the use of each
USES = {"entrance": "hall", "kitchen": "kitchen", "livingroom": "living", "bedroom": "bedroom",
        "workroom": "work", "bathroom": "bathroom", "landing": "landing"}
LANDING = (-2.7, 3.3, 0.0, 6.7)
# inside faces of the elevator's shaft; the landing's slab ends 5 cm inside the east face
SHAFT = (-4.5, 3.9, -2.75, 6.1)
LANDING_EDGE = -2.8
ELEVATOR = (-3.65, 5.0)  # middle of the cabin


@dataclass(frozen=True)
class Wall:
    """A wall along `axis` at the coordinate `at` of the other axis, with door openings' starts."""
    name: str
    axis: str
    at: float
    start: float
    end: float
    top: float
    openings: tuple[float, ...] = ()


INNER_TOP = CEILING + 0.05  # inner walls end inside the ceiling slab
WALLS = (
    Wall("wall_south", "x", 0.0, -0.05, 10.05, WALL_TOP),
    Wall("wall_north", "x", 9.6, -0.05, 10.05, WALL_TOP),
    Wall("wall_east", "y", 10.0, 0.05, 9.55, WALL_TOP),
    Wall("wall_west", "y", 0.0, 0.05, 9.55, WALL_TOP, (4.5,)),
    Wall("wall_hall_south", "x", 4.0, 0.0, 10.0, INNER_TOP, (2.4, 4.3)),
    Wall("wall_hall_north", "x", 6.0, 0.0, 6.8, INNER_TOP, (2.8, 5.5)),
    Wall("wall_workroom", "y", 6.8, 4.0, 9.6, INNER_TOP, (4.3,)),
    Wall("wall_kitchen_livingroom", "y", 4.0, 0.0, 4.0, INNER_TOP),
    Wall("wall_bedroom_bathroom", "y", 4.0, 6.0, 9.6, INNER_TOP),
    Wall("landing_south", "x", 3.3, -2.75, -0.05, WALL_TOP),
    Wall("landing_north", "x", 6.7, -2.75, -0.05, WALL_TOP),
    Wall("landing_west", "y", -2.7, 3.3, 6.7, WALL_TOP, (4.5,)),
)

# name: center x, y, length along the wall, wall's axis, bottom, top
WINDOWS = {
    "window_kitchen": (2.0, 0.0, 1.4, "x", 1.1, 2.1),
    "window_livingroom_south": (7.2, 0.0, 1.8, "x", 1.0, 2.1),
    "window_livingroom_east": (10.0, 1.0, 1.2, "y", 1.0, 2.1),
    "window_bedroom": (1.6, 9.6, 1.6, "x", 1.0, 2.1),
    "window_bathroom": (5.0, 9.6, 0.8, "x", 1.5, 2.1),
    "window_workroom": (10.0, 7.6, 1.6, "y", 0.9, 2.1),
}


@dataclass(frozen=True)
class Sash:
    """The part of a window that opens: its hinge's coordinate along the wall, and its edges.

    It laps over its opening by SASH_LAP on all sides, on the wall's inner face.
    """
    wall: str
    window: str
    hinge: float
    width: float
    bottom: float
    top: float


SASH_LAP = 0.02
# name of the window's model, without _window
SASHES = {
    "kitchen": Sash("wall_south", "window_kitchen", 2.0, 0.7, 1.18, 2.1),   # clear of the tap
    "livingroom_south": Sash("wall_south", "window_livingroom_south", 7.2, 0.9, 1.0, 2.1),
    "livingroom_east": Sash("wall_east", "window_livingroom_east", 1.6, 0.6, 1.0, 2.1),
    "bedroom": Sash("wall_north", "window_bedroom", 0.8, 0.8, 1.05, 2.1),   # clear of the bed
    "bathroom": Sash("wall_north", "window_bathroom", 4.6, 0.8, 1.5, 2.1),
    "workroom": Sash("wall_east", "window_workroom", 8.4, 0.8, 0.9, 2.1),
}

# A door's frame is at the hinge at floor level: x along the shut leaf, it opens to -y.
# hinge x, y, yaw
DOORS = {
    "entrance": (0.06, 4.505, pi / 2),
    "kitchen": (2.405, 3.94, 0.0),
    "livingroom": (4.305, 3.94, 0.0),
    "bedroom": (3.795, 6.06, pi),
    "workroom": (6.86, 4.305, pi / 2),
    "bathroom": (6.495, 6.06, pi),
}

# an optical switch in its door's frame: the beam runs 0.5 m along x just below the lintel's front
SWITCH_IN_DOOR = (0.25, -0.005, 2.125)

# room: lamp x, y
LAMPS = {
    "entrance": (3.4, 5.0),
    "kitchen": (2.0, 2.0),
    "livingroom": (7.0, 2.0),
    "bedroom": (2.0, 7.8),
    "workroom": (8.4, 6.8),
    "bathroom": (5.2, 7.8),
}

PIR_HEIGHT = 2.3
PIR_PITCH = 0.45        # looks down
# room: two corners x, y, yaw
PIRS = {
    "entrance": ((6.65, 5.85, -2.44), (0.15, 5.85, -0.7)),
    "kitchen": ((0.15, 0.15, pi / 4), (3.85, 3.85, -3 * pi / 4)),
    "livingroom": ((4.15, 0.15, pi / 4), (9.85, 3.85, -3 * pi / 4)),
    "bedroom": ((0.15, 9.45, -pi / 4), (3.85, 9.45, -3 * pi / 4)),
    "workroom": ((9.85, 9.45, -3 * pi / 4), (9.85, 4.15, 3 * pi / 4)),
    "bathroom": ((4.15, 9.45, -pi / 4), (4.15, 6.15, pi / 4)),
}
NODDING_PIR = ("livingroom", "a")

LUX_HEIGHT = 2.45
LUX_PITCH = 0.15
# room: x, y, yaw; on a wall, the lamp to the side
LUX = {
    "entrance": (2.2, 5.91, -pi / 2),
    "kitchen": (3.5, 0.09, pi / 2),
    "livingroom": (4.5, 0.09, pi / 2),
    "bedroom": (3.4, 9.51, -pi / 2),
    "workroom": (9.91, 4.8, pi),
    "bathroom": (6.45, 9.51, -pi / 2),
}

# room: an RFID reader that faces who comes in, on floor 0: x, y, z, yaw
READERS = {"workroom": (9.9, 4.82, 1.2, pi)}

# room: (model, suffix of the name, x, y, yaw); pieces face +x
FURNITURE = {
    "entrance": (
        ("shoe_cabinet", "", 1.2, 5.78, -pi / 2),
        ("plant", "", 4.65, 5.7, 0.0),
    ),
    "kitchen": (
        ("kitchen_counter", "", 1.0, 0.37, pi / 2),
        ("stove", "", 2.23, 0.37, pi / 2),
        ("fridge", "", 2.92, 0.41, pi / 2),
        ("kitchen_table", "", 0.95, 2.6, 0.0),
        ("chair", "_a", 0.95, 3.5, -pi / 2),
        ("chair", "_b", 0.95, 1.7, pi / 2),
        ("chair", "_c", 1.6, 2.6, pi),
    ),
    "livingroom": (
        ("sofa", "", 7.2, 0.53, pi / 2),
        ("table", "", 7.2, 1.75, pi / 2),
        ("tv_stand", "", 7.2, 3.72, -pi / 2),
        ("bookshelf", "", 9.76, 2.6, pi),
        ("armchair", "", 9.0, 1.2, pi),
        ("plant", "", 9.6, 3.6, 0.0),
        ("chair", "_a", 4.4, 1.0, 0.0),
    ),
    "bedroom": (
        ("bed", "", 1.6, 8.5, -pi / 2),
        ("nightstand", "_a", 0.5, 9.3, -pi / 2),
        ("nightstand", "_b", 2.7, 9.3, -pi / 2),
        ("wardrobe", "", 1.1, 6.37, pi / 2),
        ("dresser", "", 3.7, 8.6, pi),
        ("chair", "_a", 0.38, 7.45, 0.0),
    ),
    "workroom": (
        ("desk", "", 8.6, 9.17, -pi / 2),
        ("chair", "_a", 8.6, 8.5, pi / 2),
        ("bookshelf", "", 7.04, 8.0, 0.0),
        ("cabinet", "", 9.7, 6.4, pi),
        ("plant", "", 9.65, 4.4, 0.0),
    ),
    "bathroom": (
        ("bathtub", "", 4.97, 9.15, -pi / 2),
        ("washing_machine", "", 6.42, 9.2, -pi / 2),
        ("toilet", "", 4.42, 7.9, 0.0),
        ("washbasin", "", 4.33, 6.9, 0.0),
    ),
}
# piece: (model of its front, name, x, y, z of the hinge in the piece's frame); a front's own frame
# is turned by a quarter, so that it opens towards +x of the piece
FRONTS = {
    "fridge": (("fridge_door", "fridge", 0.325, -0.32, 0.01),
               ("freezer_door", "freezer", 0.325, -0.32, 1.19)),
    "stove": (("oven_door", "oven", 0.305, -0.25, 0.2),),
    "wardrobe": tuple(("wardrobe_door", f"wardrobe_{name}", 0.3, -0.79 + 0.53 * i, 0.06)
                      for i, name in enumerate("abc")),
    "kitchen_counter": tuple(("counter_door", f"counter_{name}", 0.27, -0.898 + 0.6 * i, 0.08)
                             for i, name in enumerate("abc")),
    "cabinet": (("cabinet_door", "files", 0.22, -0.4, 0.05),),
    "shoe_cabinet": tuple(("shoe_flap", f"shoes_{name}", 0.14, -0.45, z)
                          for name, z in (("low", 0.05), ("high", 0.475))),
}
# room: (model, x, y, z, yaw); they face +x
APPLIANCES = {
    "livingroom": ("tv", 7.2, 3.72, 0.5, -pi / 2),      # on its stand
    "bedroom": ("fan", 3.7, 7.75, 0.0, pi),
    "workroom": ("stereo", 9.75, 6.4, 1.2, pi),         # on the cabinet
}
# name: (load, x, y, z, yaw) of a smart plug; both names end with the floor
PLUGS = {
    "kitchen_stove_plug": ("stove/kitchen", 2.2, 0.05, 1.0, pi / 2),
    "livingroom_tv_plug": ("appliance/livingroom_tv", 8.0, 3.95, 0.3, -pi / 2),
    "bedroom_fan_plug": ("appliance/bedroom_fan", 3.95, 7.4, 0.3, pi),
    "workroom_stereo_plug": ("appliance/workroom_stereo", 9.95, 6.9, 0.3, pi),
}
# room: x, y, yaw on a wall
MICROPHONE_HEIGHT = 1.8
MICROPHONES = {
    "kitchen": (0.05, 1.2, 0.0),
    "livingroom": (4.05, 2.6, 0.0),
    "bedroom": (0.05, 7.9, 0.0),
}
RECEIVER_HEIGHT = 2.0
RECEIVERS = {
    "kitchen": (0.05, 1.5, 0.0),
    "livingroom": (9.95, 3.2, pi),
    "bedroom": (0.05, 8.2, 0.0),
    "workroom": (9.95, 5.5, pi),
    "bathroom": (6.75, 7.5, pi),
}
# things with a transmitter: x, y, z of its antenna in the frame of the thing
TRANSMITTERS = {"turtlebot": (0.0, 0.0, 0.45), "person": (0.26, 0.0, 1.1)}
RAISED = {"chair", "kitchen_table", "table", "desk"}     # dynamic pieces start 1 mm up

# model: (name without its floor, x, y, z, pitch, yaw)
THINGS = (
    ("rfid_gate", "entrance_rfid", 0.12, 5.0, 2.3, 0.35, 0.0),
    ("weighing_table", "livingroom_weighing_table", 8.52, 0.42, 0.001, 0.0, 0.0),
    ("cup", "livingroom_cup", 8.52, 0.42, 0.502, 0.0, pi / 4),
    ("pressure_mat", "bedroom_mat", 2.75, 8.45, 0.0, 0.0, pi / 2),
)

ROBOT = (1.5, 5.0, pi)
ROBOT_TAG = (-0.1, 0.0, 0.43)   # on its upper plate
BADGE = (0.26, 0.0, 1.3)        # on the person's chest

OPEN_DOORS = ("kitchen_door0", "livingroom_door0", "bedroom_door0")
# corners of the person's round on floor 0, walked at WALK_SPEED, TURN_TIME at each corner
WALK = (
    (4.82, 2.75), (8.8, 2.75), (5.6, 2.75), (5.6, 1.4), (4.82, 2.0),
    (4.82, 4.9), (2.92, 4.9),
    (2.92, 2.4), (3.3, 1.6), (2.6, 1.3), (2.5, 2.0), (2.92, 2.4), (2.92, 4.9),
    (3.28, 4.9), (3.28, 7.07), (1.3, 7.07), (2.94, 7.07), (2.94, 8.4), (2.94, 7.07),
    (3.28, 7.07), (3.28, 4.9), (4.82, 4.9), (4.82, 2.75),
)
WALK_SPEED = 1.0
TURN_TIME = 0.5

# A robot's round in the workroom of floor 0, for benches: it starts at x, y towards +x and turns
# left all the time.
ROUND = (8.6, 6.2, 0.4)     # x, y, radius
ROUND_SPEED = 0.3           # m/s

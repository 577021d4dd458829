"""People and animals of shapes on joints, and their motions. In m, s, rad, K.

A person is 1.75 m tall and lives in a room of `air` K: head and hands are skin, the rest is
clothing. Between skin (306.5 K on average) and air there are the 0.155 m^2 K/W of 1 clo and the
0.085 of its surface (ISO 9920), so that it is warmer than the air by 35 % of the difference.
"""
import math
from dataclasses import dataclass
from typing import Callable

from angen_apps.situations.puppet import Joints, Puppet, Script, Segment, Shape, Vector

Point = tuple[float, float]
COMFORT = 295.15  # K of the air in which skin is as warm as person_controller has it
THIGH, SHIN, HIP, SHOULDER = 0.45, 0.47, 0.92, 0.5  # lengths; SHOULDER above the hip
STRIDE = 1.4      # length of two steps


def skin(air: float) -> float:
    """Head and hands: they follow the air a little."""
    return 307.0 + 0.12 * (air - COMFORT)


def clothing(air: float) -> float:
    """299.1 K in a room of 295.15 K."""
    return air + 0.35 * (306.5 - air)


def _carriage(height: float) -> tuple[Segment, ...]:
    """The joints that move a body: along x and y, about z, up and down, and about its own y."""
    return (Segment('x', axis=(1, 0, 0), slides=True),
            Segment('y', 'x', axis=(0, 1, 0), slides=True),
            Segment('yaw', 'y', axis=(0, 0, 1)),
            Segment('lift', 'yaw', (0, 0, height), (0, 0, 1), slides=True),
            Segment('pitch', 'lift', axis=(0, 1, 0)))


def _person(air: float, scale: float, insulated: bool) -> tuple[Segment, ...]:
    cloth, bare = (air, air) if insulated else (clothing(air), skin(air))

    def shape(size: tuple[float, ...], z: float, temperature: float) -> Shape:
        return Shape(tuple(scale * value for value in size), (0, 0, scale * z), temperature)

    def at(y: float, z: float) -> Vector:
        return (0, scale * y, scale * z)

    torso = Segment('waist', 'pitch', axis=(0, 1, 0), shapes=(
        shape((0.22, 0.36, 0.58), 0.29, cloth), shape((0.11,), 0.72, bare)))
    limbs = []
    for side, y in (('left', 0.1), ('right', -0.1)):
        limbs += [
            Segment(f'hip_{side}', 'pitch', at(y, 0), (0, 1, 0),
                    shapes=(shape((0.075, THIGH), -THIGH / 2, cloth),)),
            Segment(f'knee_{side}', f'hip_{side}', at(0, -THIGH), (0, 1, 0),
                    shapes=(shape((0.055, SHIN - 0.05), -(SHIN - 0.05) / 2, cloth),)),
            Segment(f'shoulder_{side}', 'waist', at(math.copysign(0.24, y), SHOULDER), (0, 1, 0),
                    shapes=(shape((0.045, 0.52), -0.26, cloth), shape((0.05,), -0.57, bare)))]
    return (*_carriage(scale * HIP), torso, *limbs)


def _animal(length: float, height: float, fur: float) -> tuple[Segment, ...]:
    """A trunk and a head that slide along at their height; legs are left out."""
    trunk = (length, 0.4 * height, 0.5 * height)
    return (*_carriage(0.65 * height)[:-1],
            Segment('pitch', 'lift', axis=(0, 1, 0), shapes=(
                Shape(trunk, (0, 0, 0), fur),
                Shape((0.22 * height,), (0.5 * length + 0.15 * height, 0, 0.3 * height), fur))))


# Length, height at the shoulder; fur is 5 K above the air, as infrared pictures of animals show.
ANIMALS = {'cat': (0.45, 0.26), 'dog': (0.8, 0.55), 'mouse': (0.08, 0.04)}
FUR = 5.0


@dataclass(frozen=True)
class Way:
    """A straight walk from the time `begins` on, at a constant speed."""
    start: Point
    end: Point
    speed: float
    begins: float

    @property
    def length(self) -> float:
        return math.dist(self.start, self.end)

    @property
    def ends(self) -> float:
        return self.begins + (self.length / self.speed if self.speed else 0.0)

    def place(self, time: float) -> dict[str, float]:
        """Joints of the carriage."""
        dx, dy = self.end[0] - self.start[0], self.end[1] - self.start[1]
        share = self.distance(time) / self.length if self.length else 0.0
        return {'x': share * dx, 'y': share * dy, 'yaw': math.atan2(dy, dx)}

    def distance(self, time: float) -> float:
        return min(max(time - self.begins, 0.0) * self.speed, self.length)


def _gait(way: Way, swing: float, lean: float = 0.0) -> Script:
    def script(time: float) -> Joints:
        distance = way.distance(time)
        moves = 0.0 < distance < way.length
        phase = 2 * math.pi * distance / STRIDE
        leg, arm = swing * math.sin(phase) * moves, 0.8 * swing * math.sin(phase) * moves
        return {**way.place(time), 'lift': -(1 - math.cos(leg)) * THIGH, 'waist': lean,
                'hip_left': -leg, 'hip_right': leg, 'shoulder_left': arm, 'shoulder_right': -arm,
                'knee_left': swing * max(math.cos(phase), 0.0) * moves,
                'knee_right': swing * max(-math.cos(phase), 0.0) * moves}
    return script


def _crawl(way: Way) -> Script:
    """On hands and knees, the back level."""
    def script(time: float) -> Joints:
        swing = 0.3 * math.sin(2 * math.pi * way.distance(time) / 0.8)
        return {**way.place(time), 'lift': 0.55 - HIP, 'pitch': 1.3,
                'hip_left': -1.3 - swing, 'hip_right': -1.3 + swing,
                'knee_left': 1.5, 'knee_right': 1.5,
                'shoulder_left': -1.3 + swing, 'shoulder_right': -1.3 - swing}
    return script


Pose = dict[str, float]
STANDING: Pose = {}
SITTING: Pose = {'x': -0.4, 'lift': 0.52 - HIP, 'hip_left': -1.45, 'hip_right': -1.45,
                 'knee_left': 1.4, 'knee_right': 1.4, 'shoulder_left': -0.6,
                 'shoulder_right': -0.6}
LYING: Pose = {'lift': 0.3 - HIP, 'pitch': -1.5}         # on the back, head away from its x
FALLEN: Pose = {'x': 0.6, 'lift': 0.2 - HIP, 'pitch': 1.45}
BENT: Pose = {'waist': 1.2, 'shoulder_left': -1.0, 'shoulder_right': -1.0}


def _turned(pose: Pose, yaw: float) -> Joints:
    forth = pose.get('x', 0.0)
    return {**pose, 'x': forth * math.cos(yaw), 'y': forth * math.sin(yaw), 'yaw': yaw}


def _between(first: Pose, then: Pose, yaw: float, begins: float, lasts: float) -> Script:
    """The change from one posture to another, starting and stopping smoothly."""
    a, b = _turned(first, yaw), _turned(then, yaw)

    def script(time: float) -> Joints:
        share = min(max((time - begins) / lasts, 0.0), 1.0)
        share = share * share * (3 - 2 * share)
        return {name: a.get(name, 0.0) + share * (b.get(name, 0.0) - a.get(name, 0.0))
                for name in {*a, *b}}
    return script


def _swinging(pose: Pose, yaw: float, joint: str, middle: float, amplitude: float, rate: float,
              begins: float) -> Script:
    """In a posture, one joint swings `rate` times a second about its middle."""
    def script(time: float) -> Joints:
        since = max(time - begins, 0.0)
        return {**_turned(pose, yaw),
                joint: middle + amplitude * math.sin(2 * math.pi * rate * since)}
    return script


# From, to, seconds that it takes.
CHANGES: dict[str, tuple[Pose, Pose, float]] = {
    'sit down': (STANDING, SITTING, 1.5), 'get up': (SITTING, STANDING, 1.5),
    'fall': (STANDING, FALLEN, 0.8), 'bend': (STANDING, BENT, 1.0),
    'stand': (STANDING, STANDING, 1.0), 'sit': (SITTING, SITTING, 1.0),
    'lie': (LYING, LYING, 1.0), 'fallen': (FALLEN, FALLEN, 1.0)}
# Posture, joint, its middle, amplitude, times a second.
SWINGS: dict[str, tuple[Pose, str, float, float, float]] = {
    'wave': (STANDING, 'shoulder_right', -2.2, 0.6, 1.0),
    'type': (SITTING, 'shoulder_right', -0.6, 0.06, 2.0),
    'reach in bed': (LYING, 'shoulder_right', -0.8, 0.8, 0.5)}
# Swing of the legs, lean of the trunk.
GAITS: dict[str, Callable[[Way], Script]] = {
    'walk': lambda way: _gait(way, 0.4), 'run': lambda way: _gait(way, 0.7, 0.15),
    'crawl': _crawl, 'glide': lambda way: way.place}


def mover(name: str, who: str, gait: str, way: Way, air: float) -> Puppet:
    """A walker: an adult, child, insulated (an adult as warm as the air) or animal.
    """
    start = (way.start[0], way.start[1], 0.0)
    if who in ANIMALS:
        length, height = ANIMALS[who]
        return Puppet(name, _animal(length, height, air + FUR), way.place, start)
    scale = 0.63 if who == 'child' else 1.0
    body = _person(air, scale, who == 'insulated')
    script = GAITS[gait](way)
    if scale == 1.0:
        return Puppet(name, body, script, start)

    def scaled(time: float) -> Joints:
        joints = dict(script(time))
        return {**joints, 'lift': scale * joints.get('lift', 0.0)}
    return Puppet(name, body, scaled, start)


def actor(name: str, what: str, at: Point, yaw: float, begins: float, air: float) -> Puppet:
    """An adult in his place who changes his posture or swings an arm, as `what` says."""
    if what in CHANGES:
        first, then, lasts = CHANGES[what]
        script = _between(first, then, yaw, begins, lasts)
    else:
        pose, joint, middle, amplitude, rate = SWINGS[what]
        script = _swinging(pose, yaw, joint, middle, amplitude, rate, begins)
    return Puppet(name, _person(air, 1.0, False), script, (at[0], at[1], 0.0))

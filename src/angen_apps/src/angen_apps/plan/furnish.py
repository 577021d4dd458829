"""Furniture: models of worlds/models scaled to a piece's box, and boxes for the rest."""
from copy import deepcopy
from functools import cache
from math import pi, prod
from typing import Iterator, Sequence

import numpy as np
from lxml import etree

from angen_apps.plan.travel import Obstacle
from angen_apps.plan.model import Piece
from angen_apps.plan.polygons import rectangle
from angen_models.sdf import (ANGEN, Part, Vector, add, add_home, add_link, new_model, numbers,
                              rotation, spanned)
from angen_tools.world import sdf
from angen_tools.world.models import find

SAME = 0.02  # a scale within this of 1 is 1
STEPS = 15
TREADS = 0.69  # share of the height of a flight with its railing that is steps
TRAY = 0.02  # m, height of a shower's tray; a walking body does not climb one of 0.08
THIN = 0.02  # m: a flatter thing on the floor is not in anyone's way


@cache
def _template(name: str) -> tuple[etree._Element, np.ndarray, np.ndarray] | None:
    """A model and the corners of the box around its collisions; None if it is not found."""
    file = find(f'model://{name}')
    model = sdf.read(file).find('model') if file is not None else None
    if model is None:
        return None
    boxes = [(at - reach, at + reach) for at, reach in _collisions(model)]
    if not boxes:
        return None
    lows, highs = zip(*boxes)
    return model, np.min(lows, axis=0), np.max(highs, axis=0)


def _collisions(model: etree._Element) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """The middle and half lengths of the box around each collision, along the model's axes."""
    for link in model.iterfind('link'):
        base = np.array(sdf.parse_pose(link.findtext('pose', '0 0 0')))[:3]
        for collision in link.iterfind('collision'):
            half = _half(collision.find('geometry'))
            if half is not None:
                pose = sdf.parse_pose(collision.findtext('pose', '0 0 0'))
                yield base + np.array(pose[:3]), np.abs(rotation(pose[3:])) @ half


def _half(geometry: etree._Element) -> np.ndarray | None:
    if geometry.find('box') is not None:
        return np.array([float(v) for v in geometry.findtext('box/size').split()]) / 2
    if geometry.find('cylinder') is not None:
        radius = float(geometry.findtext('cylinder/radius'))
        return np.array([radius, radius, float(geometry.findtext('cylinder/length')) / 2])
    if geometry.find('sphere') is not None:
        return np.full(3, float(geometry.findtext('sphere/radius')))
    return None


def piece_model(piece: Piece, seat_sensor: bool) -> etree._Element | None:
    """The <model> of a piece; None if it is nothing that can be built."""
    if min(piece.width, piece.depth, piece.height) < 1e-3:
        return None
    template = _template(piece.model) if piece.model else None
    upright = not any(piece.tilt)
    if template is not None and upright:
        model = _scaled(template, piece, seat_sensor)
    else:
        model = _boxes(piece)
    model.set('name', piece.name)
    if piece.mesh and model.find('plugin') is None:  # a device needs visuals of its own
        _dress(model, piece)
    _add_thing(model, piece)
    return model


def _dress(model: etree._Element, piece: Piece) -> None:
    """A model's looks are its mesh, which is in a unit box; its collisions stay."""
    for link in model.iterfind('link'):
        for visual in link.findall('visual'):
            link.remove(visual)
    link = model.find('link')
    at, own = (np.array(sdf.parse_pose(element.findtext('pose', '0 0 0'))[:3])
               for element in (model, link))
    c, s = np.cos(piece.yaw), np.sin(piece.yaw)
    x, y, z = np.array([piece.x, piece.y, piece.z]) - at
    height = -piece.height / 2 if any(piece.tilt) else z
    place = np.array([x * c + y * s, y * c - x * s, height]) - own
    visual = add(link, 'visual', name='mesh')
    add(visual, 'pose', numbers(*(round(float(v), 5) for v in place), 0, 0, 0))
    mesh = add(add(visual, 'geometry'), 'mesh')
    add(mesh, 'uri', piece.mesh)
    add(mesh, 'scale', numbers(piece.depth, piece.width, piece.height))
    color = numbers(*(round(v, 3) for v in piece.color), 1)
    material = add(visual, 'material')
    for part in ('ambient', 'diffuse'):
        add(material, part, color)


def _scaled(template: tuple[etree._Element, np.ndarray, np.ndarray], piece: Piece,
            seat_sensor: bool) -> etree._Element:
    original, low, high = template
    size = np.array([piece.depth, piece.width, piece.height])
    scale = size / (high - low)
    scale[np.abs(scale - 1) < SAME] = 1.0
    model = deepcopy(original)
    _freeze(model, seat_sensor)
    for element in list(model.iter()):
        if isinstance(element.tag, str):
            _scale(element, scale)
    middle = (low + high) / 2 * scale
    foot = low[2] * scale[2]
    c, s = np.cos(piece.yaw), np.sin(piece.yaw)
    x = piece.x - middle[0] * c + middle[1] * s
    y = piece.y - middle[0] * s - middle[1] * c
    _set_pose(model, (x, y, piece.z - foot, 0, 0, piece.yaw))
    return model


def _freeze(model: etree._Element, seat_sensor: bool) -> None:
    """Makes a model static, and removes the elements that only a moving model needs."""
    for static in model.findall('static'):
        model.remove(static)
    static = etree.Element('static')
    static.text = 'true'
    model.insert(0, static)
    for link in model.iterfind('link'):
        for inertial in link.findall('inertial'):
            link.remove(inertial)
        if not seat_sensor:
            for sensor in link.findall('sensor'):
                if sensor.get('type') == 'contact':
                    link.remove(sensor)


def _scale(element: etree._Element, scale: np.ndarray) -> None:
    """Scales one element's own numbers."""
    name = etree.QName(element).localname
    text = (element.text or '').split()
    if name == 'pose' and len(text) in (3, 6):
        values = [float(v) for v in text]
        values[:3] = list(np.array(values[:3]) * scale)
    elif name == 'place' and len(text) == 4:
        values = [float(v) for v in text]
        # a place before the front stays as far before it
        values[:3] = list(np.array(values[:3]) * (scale if element.get('posture') != 'stand'
                                                  else np.array([1, scale[1], 1])))
    elif name == 'size' and len(text) == 3:
        values = list(_turned(element, scale) * [float(v) for v in text])
    elif name == 'scale' and len(text) == 3 and element.getparent().tag == 'mesh':
        values = list(scale * [float(v) for v in text])
    elif name == 'mesh':
        if element.find('scale') is None and not np.all(scale == 1):
            etree.SubElement(element, 'scale').text = '1 1 1'
        return
    elif name == 'radius':
        values = [float(text[0]) * (scale[0] * scale[1]) ** 0.5]
    elif name == 'length':
        values = [float(text[0]) * scale[2]]
    elif name == 'rectangle' and len(text) == 2:
        values = [float(text[0]) * scale[1], float(text[1]) * scale[2]]
    elif name == 'position' and len(text) == 3:
        values = list(scale * [float(v) for v in text])
    else:
        return
    element.text = numbers(*(round(v, 5) for v in values))


def _turned(element: etree._Element, scale: np.ndarray) -> np.ndarray:
    """The scale along the axes of a shape, which may be turned by quarter turns."""
    pose = element.getparent().getparent().getparent().findtext('pose', '0 0 0')
    turn = np.abs(rotation(sdf.parse_pose(pose)[3:]))
    return np.asarray(turn.T @ scale / turn.sum(axis=0))


def _set_pose(model: etree._Element, pose: Sequence[float]) -> None:
    for old in model.findall('pose'):
        model.remove(old)
    element = etree.Element('pose')
    element.text = numbers(*(round(float(v), 5) for v in pose))
    model.insert(1, element)


def _boxes(piece: Piece) -> etree._Element:
    _, model = new_model(piece.name, static=True)
    _set_pose(model, (piece.x, piece.y, piece.z, *piece.tilt, piece.yaw))
    add_link(model, 'body', _parts(piece), moves=False)
    return model


def _parts(piece: Piece) -> list[Part]:
    deep, wide, high = piece.depth, piece.width, piece.height

    def box(name: str, low: Vector, top: Vector, collide: bool = True) -> Part:
        return spanned(name, low, top, material=piece.color, collide=collide)

    low, top = (-deep / 2, -wide / 2, 0.0), (deep / 2, wide / 2, high)
    if any(piece.tilt):  # turned about its middle
        return [box('body', (-deep / 2, -wide / 2, -high / 2), (deep / 2, wide / 2, high / 2))]
    if piece.shape == 'cylinder':
        return [Part('body', (min(wide, deep) / 2, high), (0, 0, high / 2),
                     material=piece.color)]
    if piece.shape == 'flat' or (high < THIN and prod((wide, deep)) > 0.1):
        return [box('body', low, top, collide=False)]
    if piece.shape == 'tray':
        return [box('tray', low, (deep / 2, wide / 2, min(TRAY, high)))]
    if piece.shape in ('stairs', 'curved_stairs'):
        return [box(f'step_{i}', *step) for i, step in enumerate(
            steps(deep, wide, high, piece.shape == 'curved_stairs'))]
    return [box('body', low, top)]


def steps(deep: float, wide: float, high: float, curved: bool
          ) -> list[tuple[Vector, Vector]]:
    """Solid steps that rise from the front to the back; curved: first from right to left."""
    top = high * TREADS
    found: list[tuple[Vector, Vector]] = []
    first = 4 if curved and deep > wide else 0
    turn = wide if first else 0.0
    for i in range(first):
        y = wide / 2 - wide * i / first
        found.append(((deep / 2 - turn, y - wide / first, 0.0),
                      (deep / 2, y, top * (i + 1) / STEPS)))
    rest = STEPS - first
    for i in range(rest):
        x = deep / 2 - turn - (deep - turn) * i / rest
        found.append(((x - (deep - turn) / rest, -wide / 2, 0.0),
                      (x, wide / 2, top * (first + i + 1) / STEPS)))
    return found


def obstacles(model: etree._Element, name: str) -> list[Obstacle]:
    """The obstacles to a leaf in a model: its collisions, seen from above."""
    at = np.array(sdf.parse_pose(model.findtext('pose', '0 0 0')))
    turn = rotation(list(at[3:]))
    found = []
    for middle, reach in _collisions(model):
        x, y, z = at[:3] + turn @ middle
        rise, yaw, wide = float(np.abs(turn[2]) @ reach), at[5], reach[:2]
        if any(at[3:5]):
            yaw, wide = 0.0, np.abs(turn[:2, :2]) @ reach[:2] + np.abs(turn[:2, 2]) * reach[2]
        corners = rectangle(x, y, yaw, (-wide[0], -wide[1]), (wide[0], wide[1]))
        found.append(Obstacle(name, corners, float(z) - rise, float(z) + rise))
    return found


# seat height as a share of the height of a thing that has no model
SEATS = {'chair': 0.5, 'armchair': 0.5, 'sofa': 0.5, 'toilet': 0.6, 'bed': 0.55, 'bathtub': 0.4}
STANDING = ('desk', 'table', 'stove', 'sink', 'fridge', 'washing_machine', 'tv', 'wardrobe',
            'bookshelf', 'cabinet')


def _add_thing(model: etree._Element, piece: Piece) -> None:
    """Marks a model as a thing with its places, unless the model's own file does."""
    if not piece.thing or model.find(f'{{{ANGEN}}}thing') is not None:
        return
    add_home(model, 'thing', piece.thing)
    seat = piece.height * SEATS.get(piece.thing, 0)
    if piece.thing == 'bed':
        add_home(model, 'place', numbers(0, 0, round(seat, 3), pi), posture='lie')
    elif piece.thing in SEATS:
        add_home(model, 'place', numbers(0, 0, round(seat, 3), 0), posture='sit')
    elif piece.thing in STANDING and not piece.model:
        front = round(piece.depth / 2 + 0.35, 3)
        add_home(model, 'place', numbers(front, 0, 0, pi), posture='stand')
    elif piece.thing == 'shower':
        add_home(model, 'place', numbers(0, 0, TRAY, 0), posture='stand')

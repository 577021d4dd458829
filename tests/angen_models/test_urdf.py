"""The TurtleBot's URDF agrees with its SDF."""
from pathlib import Path

import pytest
from lxml import etree

MODEL = Path(__file__).resolve().parents[2] / 'worlds/models/turtlebot'


@pytest.fixture(scope='module')
def sdf() -> etree._Element:
    return etree.parse(str(MODEL / 'model.sdf')).find('model')


@pytest.fixture(scope='module')
def urdf() -> etree._Element:
    return etree.parse(str(MODEL / 'turtlebot.urdf')).getroot()


def twin(name: str) -> str:
    """The URDF's link for one of the SDF: its root holds the body and has no mass."""
    return 'base_link' if name == 'base_footprint' else name


def numbers(text: str) -> list[float]:
    return [float(word) for word in text.split()]


def test_links_and_their_masses_are_the_same(sdf, urdf):
    ours = {twin(link.get('name')): float(link.findtext('inertial/mass'))
            for link in sdf.iter('link')}
    theirs = {link.get('name'): float(link.find('inertial/mass').get('value'))
              for link in urdf.iter('link') if len(link)}
    assert theirs == pytest.approx(ours) and len(ours) == 3


def test_wheels_turn_at_the_same_places_about_the_same_axes(sdf, urdf):
    joints = {joint.get('name'): joint for joint in urdf.iter('joint')}
    root = joints.pop('base_footprint_joint')
    assert root.get('type') == 'fixed' and root.find('origin') is None
    assert root.find('parent').get('link') == 'base_footprint'
    assert root.find('child').get('link') == 'base_link'
    assert len(urdf.find("link[@name='base_footprint']")) == 0
    for joint in sdf.iter('joint'):
        other = joints.pop(joint.get('name'))
        child = joint.findtext('child')
        assert other.find('parent').get('link') == twin(joint.findtext('parent'))
        assert other.find('child').get('link') == child
        pose = numbers(sdf.find(f"link[@name='{child}']").findtext('pose'))
        assert numbers(other.find('origin').get('xyz')) == pytest.approx(pose[:3])
        assert other.find('axis').get('xyz') == joint.findtext('axis/xyz')
    assert not joints


@pytest.mark.parametrize('kind', ['visual', 'collision'])
def test_shapes_are_as_many_and_at_the_same_places(sdf, urdf, kind):
    for link in sdf.iter('link'):
        other = urdf.find(f"link[@name='{twin(link.get('name'))}']").findall(kind)
        ours = link.findall(kind)
        assert len(other) == len(ours)
        for shape, double in zip(ours, other):
            place = numbers(shape.findtext('pose', '0 0 0 0 0 0'))
            origin = double.find('origin')
            there = [0.0] * 6 if origin is None else numbers(
                origin.get('xyz') + ' ' + origin.get('rpy'))
            assert there == pytest.approx(place)

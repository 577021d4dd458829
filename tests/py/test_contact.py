"""Contact sensors in a world: a sitter's weight."""
import numpy as np
import pytest

import angen
from conftest import WORLDS

G = 9.8  # m/s2, SDF's default
CHAIR = '<include><uri>model://chair</uri><name>chair1</name><pose>0 0 0.001 0 0 0</pose></include>'
SEAT = 0.471  # m, its top


@pytest.fixture(autouse=True)
def models(monkeypatch):
    monkeypatch.setenv('ANGEN_MODEL_PATH', str(WORLDS / 'models'))


def weight(world: angen.World) -> float:
    """What the chair's sensor says that its seat carries, N."""
    forces = np.reshape(world.sensor('contact', 'chair1')['forces'], (-1, 3))
    return -float(forces[:, 2].sum())


def test_a_sitter_weighs_what_it_weighs_also_asleep(world):
    w = world(CHAIR)
    w.run(1)
    w.spawn('model://sitter', 'ann', [0, 0, SEAT + 0.001, 0, 0, 0])
    body = w.links.index('ann::body')
    awake = []
    for _ in range(10):
        w.run(0.5)
        awake.append(w.awake_bodies)
        if len(awake) > 2:
            assert weight(w) == pytest.approx(75 * G, rel=0.02), awake
    place = w.link_poses[body]
    assert awake[-1] == 0, 'sitter and chair sleep'
    w.run(60)
    assert weight(w) == pytest.approx(75 * G, rel=0.02)
    assert np.array_equal(w.link_poses[body], place)
    w.delete('ann')
    w.run(1.1)
    assert weight(w) == 0.0

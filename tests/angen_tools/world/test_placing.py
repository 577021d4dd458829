"""The places of sensors."""
from collections import Counter

import angen
import numpy as np
import pytest

from angen_tools.common.failure import Failure
from angen_tools.common.geometry import quaternion
from angen_tools.world import apartment as world_maker
from angen_tools.world import models, placing

COUNTS = {'pir': 30, 'switch': 15, 'luminosity': 14, 'contact': 25}


@pytest.mark.parametrize('kind', placing.KINDS)
def test_one_more_sensor_moves_none(kind: str) -> None:
    before = world_maker.apartment(2, COUNTS, 1)
    after = world_maker.apartment(2, COUNTS | {kind: COUNTS[kind] + 1}, 1)
    assert set(before) < set(after) and len(after) == len(before) + 1


def test_sensors_go_round_the_rooms() -> None:
    rooms = Counter(sensor.name.split('_')[0] + str(int(sensor.pose[2] // 4))
                    for sensor in placing.placements('pir', 120, 2, 1))
    assert len(rooms) == 12 and set(rooms.values()) == {10}


def test_the_first_sensors_stand_where_the_building_has_them() -> None:
    built = angen.World(str(models.building()))
    for kind, count in (('pir', 24), ('switch', 12), ('luminosity', 12), ('contact', 19)):
        for sensor in placing.placements(kind, count, 2, 1, elevator=True):
            pose = [*sensor.pose[:3], *quaternion(*sensor.pose[3:])]
            assert np.allclose(built.motion(sensor.name)[0], pose, atol=1e-5), sensor.name


@pytest.mark.parametrize('kind', placing.KINDS)
def test_more_than_fits_is_an_error(kind: str) -> None:
    with pytest.raises(Failure, match=rf'a floor has room for \d+ {kind} sensors, not 5000'):
        placing.placements(kind, 5000, 1, 1)


def test_floors_for_gives_the_fewest_that_hold_them() -> None:
    floors = placing.floors_for('contact', 200, 2)
    assert len(placing.placements('contact', 200, floors, 1)) == 200
    with pytest.raises(Failure):
        placing.placements('contact', 200, floors - 1, 1)

"""Malformed orders are rejected before anything is sent."""
from typing import Any

import numpy as np
import pytest
from angen_apps.web.orders import LONGEST, Orders, about_z, number, text
from angen_apps.web.store import Store

from angen_tools.common.failure import Failure
from angen_tools.common.geometry import quaternion


@pytest.mark.parametrize('order, reason', [
    ({}, 'unknown order'), ({'do': 'exec'}, 'unknown order'), ({'do': ['pause']}, 'unknown order'),
    ({'do': 'command'}, "'target' must be a text"),
    ({'do': 'command', 'target': 'lamp/all'}, "'text' must be a text"),
    ({'do': 'command', 'target': 'x' * (LONGEST + 1), 'text': 'On'}, "'target' must be a text"),
    ({'do': 'rate', 'rate': -1}, "'rate' must be a number from 0 to 1000"),
    ({'do': 'rate', 'rate': 'fast'}, "'rate' must be a number"),
    ({'do': 'rate', 'rate': True}, "'rate' must be a number"),
    ({'do': 'step', 'seconds': 1e300}, "'seconds' must be a number"),
    ({'do': 'spawn', 'kind': '../../etc', 'name': 'a'}, 'is not a kind of sensor'),
    ({'do': 'spawn', 'kind': 'lamp', 'name': 'a'}, 'is not a kind of sensor'),
    ({'do': 'spawn', 'kind': 'pir', 'name': 'a', 'pose': 5}, "'x' must be a number"),
    ({'do': 'spawn', 'kind': 'pir', 'name': 'a', 'pose': {'z': float('nan')}}, "'z' must be"),
    ({'do': 'drive', 'name': '../cmd_vel', 'speed': 1, 'turn': 0}, 'no robot is named'),
    ({'do': 'goal', 'x': float('inf'), 'y': 0}, "'x' must be a number"),
    ({'do': 'goal', 'x': 10 ** 400, 'y': 0}, "'x' must be a number"),
    ({'do': 'goal', 'x': 0, 'y': 0, 'yaw': 7}, "'yaw' must be a number"),
    ({'do': 'move', 'x': 0, 'y': 0}, "'model' must be a text"),
    ({'do': 'move', 'model': 'chair', 'x': float('nan')}, "'x' must be a number"),
    ({'do': 'move', 'model': 'chair', 'turn': 7}, "'turn' must be a number"),
    ({'do': 'command', 'target': '\ud800', 'text': 'On'}, "'target' must be a text"),
])
def test_malformed_orders_are_rejected(order: dict[str, Any], reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        Orders(Store()).execute(order)


def test_texts_and_numbers_pass() -> None:
    assert text({'a': 'Küche'}, 'a') == 'Küche'
    assert number({'a': 3}, 'a', 0, 5) == 3.0
    for wrong in ('', 5, None, ['a']):
        with pytest.raises(Failure):
            text({'a': wrong}, 'a')


def test_a_pose_is_turned_about_the_vertical() -> None:
    for roll, pitch, yaw, turn in ((0.0, 0.25, 0.5, 1.0), (0.3, -0.2, 3.0, 0.5)):
        assert np.allclose(about_z(turn, *quaternion(roll, pitch, yaw)),
                           quaternion(roll, pitch, yaw + turn)) or np.allclose(
            about_z(turn, *quaternion(roll, pitch, yaw)),
            [-part for part in quaternion(roll, pitch, yaw + turn)])

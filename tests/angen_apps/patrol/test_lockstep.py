"""The connections of a task to the node that it steps."""
from __future__ import annotations

import sys
from types import SimpleNamespace
from typing import Any

import pytest

from angen_apps.patrol.lockstep import Lockstep


class Time(float):
    def to_sec(self) -> float:
        return float(self)

    def __sub__(self, other: float) -> Time:
        return Time(float(self) - float(other))


def test_its_messages_do_not_wait_for_acknowledgments(monkeypatch: pytest.MonkeyPatch) -> None:
    """TCP holds back a small message until the one before is acknowledged: up to 40 ms."""
    asked: list[bool] = []

    def connect(*_: Any, tcp_nodelay: bool = False, **more: Any) -> SimpleNamespace:
        asked.append(tcp_nodelay)
        return SimpleNamespace(get_num_connections=lambda: 1)

    def step(ticks: int) -> SimpleNamespace:
        return SimpleNamespace(success=True, sim_time=Time(0.001 * ticks))

    monkeypatch.setitem(sys.modules, 'rospy', SimpleNamespace(
        init_node=lambda *_, **__: None, Subscriber=connect, Publisher=connect,
        ServiceProxy=lambda *_, **__: step, ServiceException=OSError))
    for name in ('angen_msgs', 'angen_msgs.msg', 'angen_msgs.srv'):
        monkeypatch.setitem(sys.modules, name, SimpleNamespace(Event=None, List=None, Step=None))
    lockstep = Lockstep(0.1)
    lockstep.subscribe('/odom', object)
    lockstep.advertise('/cmd_vel', object)
    assert asked == [True, True, True]

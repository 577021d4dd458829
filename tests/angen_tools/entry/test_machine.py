"""Whom ./angen run lets reach the master: this machine, unless the environment says otherwise."""
import os

import pytest

from angen_tools.entry.machine import has_display, stay_local


@pytest.mark.parametrize('given, host', [
    ({}, 'localhost'),
    ({'ROS_MASTER_URI': 'http://localhost:11311'}, 'localhost'),
    ({'ROS_MASTER_URI': 'http://127.0.0.1:1234/'}, 'localhost'),
    ({'ROS_MASTER_URI': 'http://[::1]:1234'}, 'localhost'),
    ({'ROS_MASTER_URI': 'http://localhost.lab.example:11311'}, None),
    ({'ROS_MASTER_URI': 'http://robot:11311'}, None),
    ({'ROS_MASTER_URI': 'http://10.0.0.7:11311'}, None),
    ({'ROS_IP': '10.0.0.8'}, None),
    ({'ROS_HOSTNAME': 'lab'}, 'lab'),
    ({'ROS_IP': '', 'ROS_HOSTNAME': ''}, 'localhost'),
])
def test_only_this_machine_unless_the_environment_says_otherwise(
        monkeypatch: pytest.MonkeyPatch, given: dict[str, str], host: str | None) -> None:
    for name in ('ROS_IP', 'ROS_HOSTNAME', 'ROS_MASTER_URI'):
        monkeypatch.delenv(name, raising=False)
    for name, value in given.items():
        monkeypatch.setenv(name, value)
    stay_local()
    assert os.environ.get('ROS_HOSTNAME') == host


@pytest.mark.parametrize('display', ['', ':4711'])
def test_a_missing_display_is_none(monkeypatch: pytest.MonkeyPatch,
                                   display: str) -> None:
    monkeypatch.setenv('DISPLAY', display)
    assert not has_display()

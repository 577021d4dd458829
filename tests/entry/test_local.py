"""Whom ./angen run lets reach the master: this machine, unless the environment says otherwise."""
import os
from pathlib import Path
import subprocess

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize('given, host', [
    ({}, 'localhost'),
    ({'ROS_MASTER_URI': 'http://localhost:11311'}, 'localhost'),
    ({'ROS_MASTER_URI': 'http://127.0.0.1:1234/'}, 'localhost'),
    ({'ROS_MASTER_URI': 'http://[::1]:1234'}, 'localhost'),
    ({'ROS_MASTER_URI': 'http://localhost.lab.example:11311'}, ''),
    ({'ROS_MASTER_URI': 'http://robot:11311'}, ''),
    ({'ROS_MASTER_URI': 'http://10.0.0.7:11311'}, ''),
    ({'ROS_IP': '10.0.0.8'}, ''),
    ({'ROS_HOSTNAME': 'lab'}, 'lab'),
    ({'ROS_IP': '', 'ROS_HOSTNAME': ''}, 'localhost'),
])
def test_only_this_machine_unless_the_environment_says_otherwise(given, host):
    environment = {key: value for key, value in os.environ.items()
                   if key not in ('ROS_IP', 'ROS_HOSTNAME', 'ROS_MASTER_URI')}
    result = subprocess.run(
        ['/bin/bash', '-c', 'source "$1"; stay_local; printf %s "${ROS_HOSTNAME:-}"', 'test',
         ROOT / 'angen'], capture_output=True, text=True, env={**environment, **given})
    assert (result.stdout, result.stderr) == (host, '')

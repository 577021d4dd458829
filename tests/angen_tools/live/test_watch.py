"""States and readings in words."""
from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from angen_msgs.msg import DoorState, ElevatorState, LampState
from angen_tools.live import watch

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / 'src/angen_tools/scripts/angen'


def angen(*words: str, **options: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(SCRIPT), *words], text=True, timeout=60,
                          stdin=subprocess.DEVNULL, **{'capture_output': True, **options})


def test_a_live_table_needs_a_terminal() -> None:
    done = angen('watch')
    assert done.returncode == 1 and '--once' in done.stderr and done.stdout == ''


@pytest.mark.parametrize('state, text', [
    (DoorState(mode=DoorState.OPENING, position=-0.5, target=-1.57),
     'opening at -0.50 rad, to -1.57 rad'),
    (DoorState(position=-0.0001), 'shut at 0.00 rad'),
    (ElevatorState(mode=ElevatorState.UP, position=2.5, floor=-1, target_floor=1),
     'going up at 2.50 m, to floor 1, doors shut'),
    (LampState(on=True, level=40, luminous_flux=320), 'on at 40 %, 320 lm')])
def test_states_in_words(state: object, text: str) -> None:
    assert watch.value_of(state) == text

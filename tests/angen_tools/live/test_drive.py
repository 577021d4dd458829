"""Keys and the robot's motion by them; the test sets the time."""
import json

import pytest

from angen_tools.live.drive import FIRST_HOLD, HOLD, SPEED, STEP, TURN, JsonLines, Keys

UP, DOWN, RIGHT, LEFT = (b'\x1b[' + end for end in (b'A', b'B', b'C', b'D'))


@pytest.mark.parametrize('key, expected', [
    (UP, (SPEED, 0)), (DOWN, (-SPEED, 0)), (LEFT, (0, TURN)), (RIGHT, (0, -TURN)),
    (b'\x1bOA', (SPEED, 0)), (b'\x1bOD', (0, TURN))])
def test_arrows_drive_and_turn(key: bytes, expected: tuple[float, float]) -> None:
    keys = Keys()
    assert keys.command(0.0) == (0, 0)
    keys.read(key, 0.0)
    assert keys.command(0.0) == expected


def test_it_drives_while_the_key_repeats_and_stops_after() -> None:
    keys = Keys()
    keys.read(UP, 10.0)
    last = 10.0 + FIRST_HOLD - 0.01  # when X begins to repeat
    for _ in range(50):
        assert keys.command(last) == (SPEED, 0)
        keys.read(UP, last)
        last += HOLD / 2
    last -= HOLD / 2
    assert keys.command(last + HOLD - 0.01) == (SPEED, 0)
    assert keys.command(last + HOLD) == (0, 0)


def test_a_single_key_ends_by_itself() -> None:
    keys = Keys()
    keys.read(LEFT, 1.0)
    assert keys.command(1.0 + FIRST_HOLD) == (0, 0)


@pytest.mark.parametrize('key', [b' ', b's', b'x', b'\x1b[F'])
def test_any_other_key_stops(key: bytes) -> None:
    keys = Keys()
    keys.read(UP + key, 0.0)
    assert keys.command(0.0) == (0, 0) and not keys.quit


def test_a_key_may_come_in_parts() -> None:
    keys = Keys()
    keys.read(b'\x1b', 0.0)
    keys.read(b'[', 0.0)
    keys.read(b'A', 0.0)
    assert keys.command(0.0) == (SPEED, 0)


def test_escape_stops_and_swallows_nothing() -> None:
    keys = Keys()
    keys.read(UP + b'\x1b', 0.0)
    keys.read(b'', 0.05)
    assert keys.command(0.05) == (0, 0)
    keys.read(LEFT, 0.1)
    assert keys.command(0.1) == (0, TURN)


def test_speeds_change_within_the_limits_of_the_robot() -> None:
    keys = Keys()
    keys.read(UP + b'+', 0.0)
    assert keys.command(0.0) == (SPEED * STEP, 0)
    keys.read(b'--', 0.0)
    assert keys.command(0.0)[0] == pytest.approx(SPEED / STEP)
    keys.read(b'+' * 30, 0.0)
    assert keys.command(0.0) == (0.7, 0) and keys.turn == 3.1


@pytest.mark.parametrize('key', [b'q', b'Q', b'\x04'])
def test_q_ends_it(key: bytes) -> None:
    keys = Keys()
    keys.read(UP + key, 0.0)
    assert keys.quit and keys.command(0.0) == (0, 0)


def test_each_change_of_the_command_is_a_line_of_json(capsys: pytest.CaptureFixture[str]) -> None:
    lines = JsonLines('robot2')
    for command in ((0.0, 0.0), (SPEED, 0.0), (SPEED, 0.0)):
        lines.show(Keys(), *command)
    lines.end()
    shown = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert shown == [{'robot': 'robot2', 'speed_m_per_s': SPEED, 'turn_rad_per_s': 0.0},
                     {'robot': 'robot2', 'speed_m_per_s': 0.0, 'turn_rad_per_s': 0.0}]

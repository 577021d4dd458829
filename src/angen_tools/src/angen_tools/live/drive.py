"""angen drive: a robot by the arrow keys."""
import json
import os
import select
import sys
import time
from contextlib import suppress
from typing import Any

from angen_tools.common.failure import Failure
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.terminal import single_keys
from angen_tools.session.live import Live
from angen_tools.session.messages import twist

HOLD = 0.25  # s after the last key, and it stops: a held key repeats faster
FIRST_HOLD = 0.7  # s after the first one: as long as X waits before a held key repeats
PERIOD = 0.05  # s between commands
STEP = 1.25  # faster or slower by one key
SPEED, TURN = 0.2, 1.0  # m/s and rad/s to begin with
MOST_SPEED, MOST_TURN = 0.7, 3.1  # the limits of the drive
ARROWS = {b'A': (1, 0), b'B': (-1, 0), b'C': (0, -1), b'D': (0, 1)}  # ahead, to the left
STARTS = (b'\x1b[', b'\x1bO')  # first bytes of an arrow key, in either mode of the keypad
HELP = 'arrows drive and turn, + and - change the speed, space or s stops, q quits'


class Keys:
    """The command of the pressed keys: a direction that ends when the keys stop."""

    def __init__(self) -> None:
        self.speed, self.turn = SPEED, TURN  # m/s, rad/s
        self.quit = False
        self._way = (0, 0)
        self._ends = 0.0
        self._part = b''

    def read(self, text: bytes, now: float) -> None:
        """Handles the terminal's input at a time in s, b'' where there was none."""
        if not text and self._part:  # the escape key itself
            self._part = b''
            self._way = (0, 0)
        text = self._part + text
        while text:
            size = 1 if text[:1] != b'\x1b' else 3
            if size == 3 and len(text) < 3:
                break
            self._press(text[:size], now)
            text = text[size:]
        self._part = text

    def _press(self, key: bytes, now: float) -> None:
        way = ARROWS.get(key[2:]) if key[:2] in STARTS else None
        if way is not None:
            held = way == self._way and now < self._ends
            self._way, self._ends = way, now + (HOLD if held else FIRST_HOLD)
        elif key in (b'+', b'='):
            self.speed = min(self.speed * STEP, MOST_SPEED)
            self.turn = min(self.turn * STEP, MOST_TURN)
        elif key in (b'-', b'_'):
            self.speed, self.turn = self.speed / STEP, self.turn / STEP
        else:
            self.quit = self.quit or key in (b'q', b'Q', b'\x03', b'\x04')
            self._way = (0, 0)

    def command(self, now: float) -> tuple[float, float]:
        """m/s ahead and rad/s to the left at a time in s."""
        if now >= self._ends:
            self._way = (0, 0)
        return self._way[0] * self.speed, self._way[1] * self.turn


def drive(robot: str | None, as_json: bool) -> None:
    """Drives a robot, the first without a name, until q or Ctrl-C; it is at rest when this returns.

    Shows the command in one line that changes, or each new one as a line of JSON. Failure if
    there is no such robot, it has not subscribed or is deleted, or stdin is not a terminal.
    """
    if not sys.stdin.isatty():
        raise Failure('drive needs a terminal; use rostopic pub to drive from a script')
    world = Live()
    name = _chosen(robot, [entity.name for entity in world.entities('drive')])
    wheel = _Wheel(world, f'{name}/cmd_vel')
    line = JsonLines(name) if as_json else Line()
    print(f'{name}: {HELP}', file=sys.stderr if as_json else sys.stdout)
    try:
        with single_keys(), suppress(KeyboardInterrupt):
            _drive(wheel, line)
    finally:
        line.end()
        wheel.stop()


def _chosen(robot: str | None, known: list[str]) -> str:
    if not known:
        raise Failure('the world has no robot')
    if robot is not None and robot not in known:
        raise Failure(f"there is no robot '{robot}'; "
                      + did_you_mean(robot, known, 'angen list --kind drive'))
    return robot or known[0]


class _Wheel:
    """Commands to one robot."""

    def __init__(self, world: Live, topic: str) -> None:
        from geometry_msgs.msg import Twist
        self._publisher: Any = world.publisher(topic, Twist)

    def send(self, ahead: float, left: float) -> None:
        """m/s and rad/s; Failure if the robot has been deleted."""
        if self._publisher.get_num_connections() == 0:
            raise Failure(f'{self._publisher.resolved_name} has no subscriber any more')
        self._publisher.publish(twist(ahead, left))

    def stop(self) -> None:
        """Stops it, if it still exists."""
        with suppress(Failure):
            self.send(0.0, 0.0)
            time.sleep(0.1)  # the message is on its way


class Line:
    """Shows the command in one line of the terminal."""

    def show(self, keys: Keys, ahead: float, left: float) -> None:
        """m/s and rad/s."""
        print(f'\r\033[K{ahead:+.2f} m/s {left:+.2f} rad/s   (speed {keys.speed:.2f} m/s, '
              f'{keys.turn:.2f} rad/s)', end='', flush=True)

    def end(self) -> None:
        print()


class JsonLines(Line):
    """Prints each new command as JSON."""

    def __init__(self, robot: str) -> None:
        self._robot = robot
        self._last = (0.0, 0.0)

    def show(self, keys: Keys, ahead: float, left: float) -> None:
        if (ahead, left) != self._last:
            print(json.dumps({'robot': self._robot, 'speed_m_per_s': ahead,
                              'turn_rad_per_s': left}), flush=True)
        self._last = ahead, left

    def end(self) -> None:
        """The robot stops."""
        self.show(Keys(), 0.0, 0.0)


def _drive(wheel: _Wheel, line: Line) -> None:
    keys, stopped = Keys(), True
    while not keys.quit:
        text = b''
        if select.select([sys.stdin], [], [], PERIOD)[0]:
            text = os.read(sys.stdin.fileno(), 64)
            keys.quit = not text  # the terminal is closed
        keys.read(text, time.monotonic())
        ahead, left = keys.command(time.monotonic())
        moves = ahead != 0.0 or left != 0.0
        if moves or not stopped:
            wheel.send(ahead, left)
        stopped = not moves
        line.show(keys, ahead, left)

"""angen drive in a terminal of its own, against the real node."""
import json
import os
import signal
import subprocess
import termios
from typing import Iterator

import pytest
from harness import Angen, Cli, Inbox, open_terminal, own_terminal, until
from nav_msgs.msg import Odometry
from std_srvs.srv import Empty

UP, LEFT = b'\x1b[A', b'\x1b[D'


class Driver:
    """angen drive at a pseudo-terminal."""

    def __init__(self, cli: Cli, *words: str) -> None:
        self._ours, self._theirs = open_terminal()
        self._before = termios.tcgetattr(self._theirs)
        self.process = subprocess.Popen(
            [*cli.words, 'drive', *words], env=cli.environment, stdin=self._theirs,
            stdout=self._theirs, stderr=self._theirs, preexec_fn=own_terminal)
        self._said = b''
        os.set_blocking(self._ours, False)

    def press(self, keys: bytes) -> None:
        os.write(self._ours, keys)

    def said(self) -> str:
        """All its output until now."""
        try:
            while more := os.read(self._ours, 4096):
                self._said += more
        except OSError:
            pass
        return self._said.decode()

    def is_as_before(self) -> bool:
        return termios.tcgetattr(self._theirs) == self._before

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        os.close(self._ours)
        os.close(self._theirs)


@pytest.fixture(scope='module', autouse=True)
def put_back(angen: Angen) -> Iterator[None]:
    """The robot is where other tests expect it, when these are done."""
    yield
    angen.call('/gazebo/reset_world', Empty)


@pytest.fixture
def driver(cli: Cli) -> Iterator[Driver]:
    """Ready to read keys."""
    started = Driver(cli)
    until(lambda: 'm/s' in started.said(), 'it waits for keys')
    yield started
    started.close()


def test_it_drives_while_keys_come_and_stops_when_they_stop(angen: Angen, driver: Driver) -> None:
    with Inbox('/odom', Odometry) as inbox:
        def speed() -> float:
            driver.said()
            return inbox.messages[-1].twist.twist.linear.x if inbox.messages else 0.0

        def turning() -> float:
            return inbox.messages[-1].twist.twist.angular.z

        start = inbox.wait(lambda _: True, 'the robot is somewhere').pose.pose.position.x
        until(lambda: driver.press(UP) or speed() > 0.15, 'it drives')
        until(lambda: speed() == 0.0, 'it stops when the keys stop')
        assert inbox.messages[-1].pose.pose.position.x > start + 0.02
        until(lambda: driver.press(LEFT) or turning() > 0.8, 'it turns')
        driver.press(b's')
        until(lambda: turning() == 0.0, 'it stops')
    assert driver.process.poll() is None and not driver.is_as_before()
    driver.press(b'q')
    assert driver.process.wait(30) == 0 and driver.is_as_before()
    assert '+0.20 m/s' in driver.said()


@pytest.mark.parametrize('ended_by, code', [(signal.SIGINT, 0), (signal.SIGTERM, 143),
                                            (signal.SIGHUP, 129)])
def test_the_terminal_is_put_back_and_the_robot_stands(angen: Angen, driver: Driver,
                                                       ended_by: int, code: int) -> None:
    with Inbox('/odom', Odometry) as inbox:
        until(lambda: driver.press(UP) or driver.said() and inbox.messages
              and inbox.messages[-1].twist.twist.linear.x > 0.1, 'it drives')
        driver.process.send_signal(ended_by)
        assert driver.process.wait(30) == code and driver.is_as_before()
        until(lambda: inbox.messages[-1].twist.twist.linear.x == 0.0, 'it has stopped')


def test_what_is_wrong_is_reported(cli: Cli) -> None:
    assert 'needs a terminal' in cli.fails('drive')
    driver = Driver(cli, '--robot', 'missing')
    assert driver.process.wait(30) == 1
    assert "there is no robot 'missing'; did you mean turtlebot?" in driver.said()
    driver.close()


def test_commands_may_be_read_as_json(cli: Cli) -> None:
    driver = Driver(cli, '--json')
    until(lambda: 'q quits' in driver.said(), 'it waits for keys')
    until(lambda: driver.press(UP) or '}' in driver.said(), 'it drives')
    driver.press(b'q')
    assert driver.process.wait(30) == 0
    shown = [json.loads(line) for line in driver.said().splitlines() if line.startswith('{')]
    assert [one['speed_m_per_s'] for one in shown] == [0.2, 0.0]
    driver.close()


def test_a_robot_that_goes_away_ends_it(cli: Cli, angen: Angen) -> None:
    cli.does('spawn', 'model', 'model://turtlebot', 'guest', '--pose', '-6 -6 0.01')
    driver = Driver(cli, '--robot', 'guest')
    until(lambda: 'm/s' in driver.said(), 'it waits for keys')
    cli.does('delete', 'guest')
    until(lambda: driver.press(UP) or driver.said() and driver.process.poll() is not None,
          'it ends')
    assert driver.process.returncode == 1 and driver.is_as_before()
    assert '/guest/cmd_vel has no subscriber any more' in driver.said()
    driver.close()

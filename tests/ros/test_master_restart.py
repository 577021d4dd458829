"""The node when its master ends, or is restarted."""
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Iterator
from urllib.parse import urlparse

import pytest
from harness import WORLD, Master, end, node_binary, until, world_file

from angen_tools.common.watchdog import watchdog

BALL = """<model name="ball"><pose>1 1 9 0 0 0</pose><link name="link">
  <inertial><mass>1</mass></inertial>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link></model>"""
HOUSE = WORLD.replace("</world>", BALL + "</world>")


@pytest.fixture
def master(tmp_path: Path) -> Iterator[Master]:
    with watchdog():  # ends the processes that a failed test leaves
        started = Master(tmp_path)
        yield started
        if started.process.poll() is None:
            end(started.process)


def killed_and_restarted(master: Master, folder: Path) -> Master:
    master.process.kill()
    master.process.wait()
    time.sleep(2.5)  # the node must outlive that
    return Master(folder, int(urlparse(master.uri).port or 0))


def test_it_ends_with_its_world_saved(master: Master, tmp_path: Path) -> None:
    log, saved = tmp_path / "log", tmp_path / "saved.world"
    process = master.node(world_file(HOUSE, tmp_path), log, rescue=saved)
    until(lambda: "/angen/stats" in master.topics(), "it runs")
    restarted = killed_and_restarted(master, tmp_path)
    try:
        assert process.poll() is None, log.read_text()
        assert process.wait(20) == 75, log.read_text()
        text = log.read_text()
        assert "does not answer; the simulation continues" in text
        assert "was restarted and does not know this node; the world as of" in text
        assert str(saved) in text
        assert saved.stat().st_mode & 0o777 == 0o600
        assert [path.name for path in tmp_path.glob("saved*")] == ["saved.world"]
        end(restarted.node(saved, tmp_path / "second"))  # a node continues the saved world
        height = float(saved.read_text().split('name="ball"')[1].split("<pose>")[1].split()[2])
        assert height == pytest.approx(0.1, abs=0.01)  # it fell from 9 m in the meantime
    finally:
        end(restarted.process)


def test_the_default_place_is_the_users_own(master: Master, tmp_path: Path) -> None:
    kept = tmp_path / "precious"
    kept.write_text("mine")
    state = tmp_path / "state"
    (state / "angen").mkdir(parents=True, mode=0o777)
    (state / "angen" / "rescue.world").symlink_to(kept)
    master.environment["XDG_STATE_HOME"] = str(state)
    process = master.node(world_file(HOUSE, tmp_path), tmp_path / "log")
    restarted = killed_and_restarted(master, tmp_path)
    try:
        assert process.wait(20) == 75
        saved = state / "angen" / "rescue.world"
        assert saved.is_file() and not saved.is_symlink() and kept.read_text() == "mine"
        assert saved.stat().st_mode & 0o777 == 0o600
        assert (state / "angen").stat().st_mode & 0o777 == 0o700
    finally:
        end(restarted.process)


def test_a_world_that_cannot_be_saved_is_an_error(master: Master, tmp_path: Path) -> None:
    log = tmp_path / "log"
    process = master.node(world_file(HOUSE, tmp_path), log, rescue=tmp_path / "none/saved.world")
    restarted = killed_and_restarted(master, tmp_path)
    try:
        assert process.wait(20) == 1
        assert "cannot be saved in" in log.read_text()
    finally:
        end(restarted.process)


def test_a_master_that_only_sleeps_is_waited_for(master: Master, tmp_path: Path) -> None:
    log = tmp_path / "log"
    process = master.node(world_file(HOUSE, tmp_path), log)
    try:
        master.process.send_signal(signal.SIGSTOP)
        time.sleep(3)
        master.process.send_signal(signal.SIGCONT)
        time.sleep(3)
        assert process.poll() is None, log.read_text()
        assert "/angen/ready" in master.topics()
    finally:
        assert end(process) == 0


class Client:
    """A process that has connected to services of the node, and calls them without its master."""

    SOURCE = """
import sys
import rospy
from angen_msgs.srv import Delete, Spawn, Step
services = {name: rospy.ServiceProxy('/angen/' + name, kind, persistent=True)
            for name, kind in (('spawn', Spawn), ('delete', Delete), ('step', Step))}
services['spawn'](name=''), services['delete'](name='nobody'), services['step']()
print('connected', flush=True)
for line in sys.stdin:
    words = line.split()
    if words[0] == 'spawn':
        answer = services['spawn'](name=words[1], xml='model://pir').success
    elif words[0] == 'delete':
        answer = services['delete'](name=words[1]).success
    else:
        answer = services['step']().sim_time.to_nsec()
    print(int(answer), flush=True)
"""

    def __init__(self, master: Master) -> None:
        self._process = subprocess.Popen([sys.executable, "-c", self.SOURCE], text=True,
                                         env=master.environment, stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE)
        assert self._line() == "connected"

    def _line(self) -> str:
        assert self._process.stdout is not None
        return self._process.stdout.readline().strip()

    def says(self, words: str) -> int:
        """Whether it was done, or for "time" the simulated time in ns."""
        assert self._process.stdin is not None
        self._process.stdin.write(words + "\n")
        self._process.stdin.flush()
        return int(self._line())

    def end(self) -> None:
        self._process.communicate()


def test_without_a_master_it_spawns_and_deletes(master: Master, tmp_path: Path) -> None:
    process = master.node(world_file(HOUSE, tmp_path), tmp_path / "log")
    client = Client(master)
    master.process.kill()
    master.process.wait()
    for _ in range(3):
        before = client.says("time")
        assert client.says("spawn late") == 1
        until(lambda: client.says("time") > before + 100_000_000, "time goes on")
        assert client.says("delete late") == 1
    client.end()
    assert end(process) == 0


def test_a_master_that_slept_is_told_of_spawned_sensors(master: Master, tmp_path: Path) -> None:
    process = master.node(world_file(HOUSE, tmp_path), tmp_path / "log")
    client = Client(master)
    try:
        assert client.says("spawn early") == 1
        assert "/angen/pir/early" in master.topics()
        master.process.send_signal(signal.SIGSTOP)
        before = client.says("time")
        assert client.says("delete early") == 1 and client.says("spawn late") == 1
        until(lambda: client.says("time") > before + 100_000_000, "time goes on")
        master.process.send_signal(signal.SIGCONT)
        until(lambda: "/angen/pir/late" in master.topics(), "the new topic")
        assert "/angen/pir/early" not in master.topics()
    finally:
        master.process.send_signal(signal.SIGCONT)
        client.end()
        assert end(process) == 0


def test_usage_names_it() -> None:
    done = subprocess.run([str(node_binary()), "--help"], text=True, capture_output=True,
                          timeout=60, check=True)
    assert "_rescue:=FILE" in done.stdout and "exit code 75" in done.stdout

"""The begin and the end of the node, and its remains."""

from __future__ import annotations

import fcntl
import signal
import subprocess
import time
from pathlib import Path

import psutil
import pytest
from angen_msgs.srv import Delete, Spawn
from harness import WORLD, Angen, Master, end, node_binary, until


def check(world: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(node_binary()), "--check", str(world)], text=True,
                          capture_output=True, timeout=60, check=False)


def test_a_world_that_loads(tmp_path: Path) -> None:
    world = tmp_path / "small.world"
    world.write_text(WORLD)
    done = check(world)
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"{world}: 5 models, 4 devices, 5 sensors\n"


@pytest.mark.parametrize(("right", "wrong", "part"), [
    ("model://pir", "model://no_such_model", "no_such_model"),
    ("<max_step_size>0.001", "<max_step_size>quick", "quick"),
    ("<wheelSeparation>0.23</wheelSeparation>", "<wheelSeperation>0.23</wheelSeperation>",
     "wheelSeperation"),
    ("libdoor_world_plugin.so", "libno_such_plugin.so", "libno_such_plugin.so"),
    ("</world>", "", ""),
])
def test_a_broken_world_is_explained_without_a_master(tmp_path: Path, right: str, wrong: str,
                                                      part: str) -> None:
    world = tmp_path / "broken.world"
    world.write_text(WORLD.replace(right, wrong))
    done = check(world)
    assert done.returncode == 1 and not done.stdout
    lines = done.stderr.splitlines()
    assert len(lines) == 1, done.stderr
    file, line, message = lines[0].split(":", 2)
    assert file == str(world) and int(line) > 0 and part in message


def test_a_world_that_is_not_there(tmp_path: Path) -> None:
    done = check(tmp_path / "none.world")
    assert done.returncode == 1 and "none.world" in done.stderr


def test_an_empty_path_is_named() -> None:
    done = subprocess.run([str(node_binary()), "--check", ""], text=True, capture_output=True,
                          timeout=60, check=False)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "'': not a path; give the file of a world\n"


@pytest.mark.parametrize("seed", ["1e30", "0.5", "-1", "x"])
def test_a_seed_that_is_none_is_an_error(master: Master, tmp_path: Path, seed: str) -> None:
    world = tmp_path / "small.world"
    world.write_text(WORLD)
    done = subprocess.run([str(node_binary()), str(world), f"_seed:={seed}"], text=True,
                          env=master.environment, capture_output=True, timeout=60, check=False)
    master.api.deleteParam("/test", "/angen/seed")
    assert done.returncode == 1
    assert "~seed" in done.stderr and "must be" in done.stderr


def test_interrupt_ends_it(master: Master, tmp_path: Path) -> None:
    own = Master(tmp_path)
    try:
        world = tmp_path / "small.world"
        world.write_text(WORLD)
        process = own.node(world, tmp_path / "log", rate=0)
        process.send_signal(signal.SIGINT)
        assert process.wait(20) == 0
        assert not own.topics()
    finally:
        end(own.process)


def threads_and_descriptors(angen: Angen) -> tuple[int, int]:
    """Without connections to the master: roscpp keeps as many as were ever in use at once."""
    node = psutil.Process(angen.process.pid)
    port = int(angen.master.uri.rsplit(":", 1)[1])
    kept = [c for c in node.connections() if c.raddr and c.raddr.port == port]
    return node.num_threads(), node.num_fds() - len(kept)


def test_what_comes_and_goes_leaves_nothing(angen: Angen) -> None:
    def cycle(count: int) -> tuple[int, int]:
        """The most threads and descriptors meanwhile."""
        most = threads_and_descriptors(angen)
        for i in range(count):
            spawned = angen.call("/angen/spawn", Spawn, name=f"cycle{i % 3}", xml="model://pir")
            assert spawned.success, spawned.message
            assert angen.call("/angen/delete", Delete, name=f"cycle{i % 3}").success
            now = threads_and_descriptors(angen)
            most = max(most[0], now[0]), max(most[1], now[1])
        return most

    before = cycle(10)
    topics = angen.master.topics()
    cycle(50)
    assert angen.master.topics() == topics
    for _ in range(100):  # roscpp closes the last service's connection when it next polls
        after = threads_and_descriptors(angen)
        if after[0] <= before[0] and after[1] <= before[1]:
            break
        time.sleep(0.05)
    assert after[0] <= before[0] and after[1] <= before[1], (before, after)


def test_a_second_node_of_the_name_leaves_the_first_alone(tmp_path: Path) -> None:
    world = tmp_path / "small.world"
    world.write_text(WORLD)
    master = Master(tmp_path)

    def second(*words: str) -> subprocess.Popen[str]:
        return subprocess.Popen([str(node_binary()), str(world), *words], text=True,
                                env=master.environment, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE)

    first = master.node(world, tmp_path / "log")
    replacing = None
    try:
        rejected = second()
        _, said = rejected.communicate(timeout=60)
        assert rejected.returncode == 1, said
        line = said.splitlines()[-1]
        assert line.startswith("a simulator runs already in the namespace /: node /angen, which")
        assert "_replace:=true" in line
        named = second("__name:=angen2", "_replace:=true")
        _, said = named.communicate(timeout=60)
        line = said.splitlines()[-1]
        assert named.returncode == 1 and "node /angen; " in line and "ROS_NAMESPACE" in line, said
        assert first.poll() is None and "/angen/ready" in master.topics()
        replacing = second("_replace:=true")
        assert first.wait(60) == 0  # the master ended it
        first = master.node(world, tmp_path / "log", replace="true")  # and it was replaced in turn
        assert replacing.wait(60) == 0
        killed = master.api.lookupNode("/test", "/angen")[2]
        first.kill()  # it stays registered, but a dead node hinders no other
        first.wait()
        first = master.node(world, tmp_path / "again")
        until(lambda: master.api.lookupNode("/test", "/angen")[2] != killed, "it runs")
        assert first.poll() is None
    finally:
        for process in (first, replacing, master.process):
            if process is not None:
                end(process)


def test_a_node_waits_for_the_end_of_the_one_before(tmp_path: Path) -> None:
    world = tmp_path / "small.world"
    world.write_text(WORLD)
    folder = tmp_path / "angen"
    folder.mkdir(mode=0o700)
    master = Master(tmp_path)
    master.environment["XDG_STATE_HOME"] = str(tmp_path)
    node = None
    try:
        with (folder / "nodes.lock").open("w") as lock:
            fcntl.lockf(lock, fcntl.LOCK_EX)  # all names, as a node that ends has its own
            node = subprocess.Popen([str(node_binary()), str(world)], env=master.environment)
            time.sleep(1.0)
        until(lambda: "/angen/ready" in master.topics(), "it serves")
    finally:
        for process in (node, master.process):
            if process is not None:
                end(process)


def test_of_nodes_that_start_at_once_one_lives(tmp_path: Path) -> None:
    world = tmp_path / "small.world"
    world.write_text(WORLD)
    master = Master(tmp_path)
    nodes: list[subprocess.Popen[str]] = []
    try:
        for attempt in range(3):
            logs = [tmp_path / f"log{attempt}{i}" for i in range(2)]
            nodes = [subprocess.Popen([str(node_binary()), str(world)], text=True,
                                      env=master.environment, stdout=log.open("w"),
                                      stderr=subprocess.STDOUT) for log in logs]
            until(lambda: any(node.poll() is not None for node in nodes), "one leaves")
            left = int(nodes[1].poll() is not None)
            said = logs[left].read_text().splitlines()[-1]
            assert nodes[left].returncode == 1, said
            assert said.startswith("a simulator runs already"), said
            until(lambda: "/angen/ready" in master.topics(), "the other one serves")
            other = nodes[1 - left]
            assert other.poll() is None, logs[1 - left].read_text()
            other.send_signal(signal.SIGINT)
            assert other.wait(60) == 0
    finally:
        for process in (*nodes, master.process):
            end(process)

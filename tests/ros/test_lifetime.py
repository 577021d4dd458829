"""The begin and the end of the node, and its remains."""
import fcntl
import os
import signal
import subprocess
import time
from pathlib import Path

import pytest
from angen_tools.common.port import free_port
from harness import WORLD, Master, end, node_binary, own_node, until, world_file


def check(world: Path | str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(node_binary()), "--check", str(world)], text=True,
                          capture_output=True, timeout=60, check=False)


def test_a_world_that_loads(tmp_path: Path) -> None:
    world = world_file(WORLD, tmp_path)
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
    world = world_file(WORLD.replace(right, wrong), tmp_path)
    done = check(world)
    assert done.returncode == 1 and not done.stdout
    lines = done.stderr.splitlines()
    assert len(lines) == 1, done.stderr
    file, line, message = lines[0].split(":", 2)
    assert file == str(world) and int(line) > 0 and part in message


def test_a_path_without_a_world_is_named(tmp_path: Path) -> None:
    done = check(tmp_path / "none.world")
    assert done.returncode == 1 and "none.world" in done.stderr
    done = check("")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "'': not a path; give the file of a world\n"


@pytest.mark.parametrize("seed", ["1e30", "0.5", "-1", "x"])
def test_a_seed_that_is_none_is_an_error(master: Master, tmp_path: Path, seed: str) -> None:
    said = master.rejected(world_file(WORLD, tmp_path), f"_seed:={seed}")
    master.api.deleteParam("/test", "/angen/seed")
    assert "~seed" in said and "must be" in said


def test_interrupt_ends_it(tmp_path: Path) -> None:
    with own_node(tmp_path, WORLD, rate=0) as node:
        node.process.send_signal(signal.SIGINT)
        assert node.process.wait(20) == 0
        assert not node.master.topics()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_while_it_waits_for_a_master(tmp_path: Path, number: int) -> None:
    uri = f"http://127.0.0.1:{free_port()}"
    node = subprocess.Popen([str(node_binary()), str(world_file(WORLD, tmp_path))], text=True,
                            stderr=subprocess.PIPE, env={**os.environ, "ROS_MASTER_URI": uri})
    assert node.stderr is not None
    try:
        assert node.stderr.readline() == f"angen_node: waiting for the ROS master at {uri}\n"
        node.send_signal(number)
        assert node.wait(20) == 0
    finally:
        node.kill()
        node.stderr.close()


def test_a_second_node_of_the_name_leaves_the_first_alone(tmp_path: Path) -> None:
    world = world_file(WORLD, tmp_path)
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
    world = world_file(WORLD, tmp_path)
    folder = tmp_path / "angen"
    folder.mkdir(mode=0o700)
    with Master(tmp_path) as master:
        master.environment["XDG_STATE_HOME"] = str(tmp_path)
        with (folder / "nodes.lock").open("w") as lock:
            fcntl.lockf(lock, fcntl.LOCK_EX)  # all names, as a node that ends has its own
            node = subprocess.Popen([str(node_binary()), str(world)], env=master.environment)
            time.sleep(1.0)
        try:
            until(lambda: "/angen/ready" in master.topics(), "it serves")
        finally:
            end(node)


def test_of_nodes_that_start_at_once_one_lives(tmp_path: Path) -> None:
    world = world_file(WORLD, tmp_path)
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

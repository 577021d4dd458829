"""Actions of several clients over ROS are recorded, and give the same fingerprints again.

ANGEN_REPLAY_SECONDS says how long the session is, in simulated seconds.
"""
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, Iterator

import pytest
from harness import SLOWNESS, WORLD, Cli, Master, end, node_binary, until, world_file

SECONDS = float(os.environ.get("ANGEN_REPLAY_SECONDS", "60"))
RATE = 10.0
LISTENED = ("/tf", "/angen/markers", "/angen/pir/eye", "/angen/lamp/kitchen0", "/scan",
            "/camera/depth/points")  # the last two are sampled on demand
CLIENTS = ("ann", "bob", "eve")


@pytest.fixture(scope="module")
def own_master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Master]:
    with Master(tmp_path_factory.mktemp("master")) as started:
        started.api.setParam("/test", "/use_sim_time", True)
        yield started


def session(master: Master, folder: Path, seconds: float, kill: bool = False, **params: object
            ) -> tuple[Path, list[str]]:
    """The log of a session, and the actions of each client."""
    log = folder / "session.log"
    node = master.node(world_file(WORLD, folder), folder / "node", seed=7, rate=RATE, record=log,
                       **params)
    clients = [subprocess.Popen([sys.executable, Path(__file__).with_name("replay_client.py"),
                                 name, str(seconds)], env=master.environment, text=True,
                                stdout=subprocess.PIPE) for name in CLIENTS]
    done = []
    try:
        if kill:
            half = seconds * 500  # ticks
            until(lambda: log.exists() and any(line.get("tick", 0) > half for line in lines(log)),
                  "half of it", 300.0)
            node.kill()
        else:
            limit = SLOWNESS * (60 + 3 * seconds)
            done = [client.communicate(timeout=limit)[0] for client in clients]
            node.send_signal(signal.SIGINT)
            assert node.wait(20) == 0
    finally:
        for process in (*clients, node):
            process.kill()
            process.wait()
    return log, done


def lines(log: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in log.read_text().splitlines(keepends=True)
            if line.endswith("\n")]


def replay(master: Master, log: Path, *words: str) -> str:
    """The line that says how it went; the numbers of equal fingerprints and of actions in it."""
    done = subprocess.run([*Cli(master).words, "replay", str(log), *words],
                          env=master.environment, text=True, capture_output=True, timeout=1800)
    assert done.returncode == 0, done.stderr
    print(done.stderr + done.stdout)
    return done.stdout


def seen(master: Master) -> dict[str, str]:
    """The environment in which a node's output is in its log at once."""
    return dict(master.environment, ROSCONSOLE_STDOUT_LINE_BUFFERED="1")


@pytest.fixture(scope="module")
def recorded(own_master: Master, tmp_path_factory: pytest.TempPathFactory) -> Path:
    began = time.monotonic()
    log, done = session(own_master, tmp_path_factory.mktemp("session"), SECONDS)
    print(*done, f"{log.stat().st_size} bytes, {time.monotonic() - began:.0f} s", sep="\n")
    return log


def test_all_kinds_of_actions_of_each_client_are_in_the_log(recorded: Path) -> None:
    said = lines(recorded)
    kinds = {line["do"] for line in said[1:]}
    assert kinds >= {"command", "spawn", "delete", "pause", "step", "note", "request",
                     "fingerprint", "reject"}
    spawned = {line["name"].partition("_")[0] for line in said if line.get("do") == "spawn"}
    assert spawned == set(CLIENTS)
    assert len([line for line in said if line.get("do") == "fingerprint"]) >= SECONDS


def test_a_replay_is_the_same_each_second(own_master: Master, recorded: Path) -> None:
    checks = [line for line in lines(recorded) if line.get("do") == "fingerprint"]
    for words in ((), ("--every-tick",)):
        said = replay(own_master, recorded, *words)
        assert f"all {len(checks)} fingerprints are equal" in said


@pytest.mark.parametrize("rate", ["0", "fast"])
def test_a_node_replays_with_listeners_at_another_rate(own_master: Master, recorded: Path,
                                                       tmp_path: Path, rate: str) -> None:
    checks = [line for line in lines(recorded) if line.get("do") == "fingerprint"]
    log = tmp_path / "node"
    listener = subprocess.Popen(["/usr/bin/rostopic", "hz", *LISTENED],
                                env=own_master.environment, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL)
    with log.open("w") as out:
        node = subprocess.Popen(
            [str(node_binary()), f"_replay:={recorded}", "_record:=", "_until:=",
             "_fast:=" + str(rate == "fast").lower(), "_rate:=0"],
            env=seen(own_master), text=True, stdout=out, stderr=out)
    try:
        until(lambda: "live from" in log.read_text(), "the end of the replay",
              60 + 3 * SECONDS)
        assert f"{len(checks)} fingerprints were equal" in log.read_text()
        assert "the fingerprint is" not in log.read_text()
    finally:
        listener.kill()
        listener.wait()
        end(node)


def test_until_stops_there_and_continues_live(own_master: Master, recorded: Path, tmp_path: Path
                                              ) -> None:
    log, second = tmp_path / "node", tmp_path / "second.log"
    with log.open("w") as out:
        node = subprocess.Popen(
            [str(node_binary()), f"_replay:={recorded}", "_until:=20.5", "_rate:=1",
             f"_record:={second}", "_fast:=false"],
            env=seen(own_master), text=True, stdout=out, stderr=out)
    try:
        until(lambda: "live from 20.500 s" in log.read_text(), "the replay is there", 120.0)
        cli = Cli(own_master)
        assert "17 %" in cli.does("set", "lamp", "kitchen0", "17")
    finally:
        end(node)
    # The replayed node records a log of its own, of the old actions and the new one.
    before = [line for line in lines(recorded)[1:] if line["tick"] <= 20_000]
    after = [line for line in lines(second)[1:] if line["tick"] <= 20_000]
    assert [line["hash"] for line in before if line["do"] == "fingerprint"] == [
        line["hash"] for line in after if line["do"] == "fingerprint"]
    assert "fingerprints are equal" in replay(own_master, second)


def test_what_kill_9_leaves_is_replayed(own_master: Master, tmp_path: Path) -> None:
    log, _ = session(own_master, tmp_path, 30.0, kill=True)
    assert lines(log)[-1]["tick"] > 15_000
    assert "fingerprints are equal" in replay(own_master, log)
    # the same with half a line at its end
    text = log.read_bytes()
    log.write_bytes(text[:text.rindex(b"\n", 0, -1) + 30])
    done = Cli(own_master).run("replay", str(log))
    assert done.returncode == 0
    assert re.search(r"warning: .*session.log:\d+: the line that begins at byte \d+ is incomplete",
                     done.stderr)


def test_commands_of_a_launch_are_executed_before_time_begins(own_master: Master, tmp_path: Path
                                                              ) -> None:
    log = tmp_path / "session.log"
    with own_master.serving(WORLD, tmp_path, record=log,
                            commands="lamp/kitchen0 Dim 40; door/bathroom0 Open") as node:
        assert "40 %" in Cli(own_master).does("watch", "--once", "kitchen0")
        assert end(node.process) == 0
    actions = [line for line in lines(log) if line.get("do") == "command"]
    assert [(line["tick"], line["name"], line["text"]) for line in actions] == [
        (0, "lamp/kitchen0", "Dim 40"), (0, "door/bathroom0", "Open")]


def test_a_log_that_is_damaged_or_missing_is_one_line(own_master: Master, recorded: Path,
                                                      tmp_path: Path) -> None:
    cli = Cli(own_master)
    bad = tmp_path / "bad.log"
    text = recorded.read_bytes().splitlines(keepends=True)
    text[5] = text[5].replace(b'"tick":', b'"tick":1')
    bad.write_bytes(b"".join(text))
    assert cli.fails("replay", str(bad)).startswith(f"{bad}:6: is damaged, the line that begins")
    assert cli.fails("replay", str(tmp_path / "none")).endswith(
        "cannot be read; give a log that record:= wrote")
    assert f"{bad}:6: is damaged" in own_master.rejected(f"_replay:={bad}", "__name:=other")

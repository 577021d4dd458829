"""Two houses on one master, each in a namespace of its own."""
import subprocess
from typing import Iterator

import pytest
from harness import ROOT, SLOWNESS, Master, end, node_binary, until

HOUSES = ("/house1", "/house2")


@pytest.fixture(scope="module")
def master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Master]:
    """A master with both houses, whose doors are shut."""
    folder = tmp_path_factory.mktemp("houses")
    started = Master(folder)
    processes = [started.process]
    try:
        for house in HOUSES:
            with (folder / f"log{house[1:]}").open("w") as log:
                processes.insert(0, subprocess.Popen(
                    [str(node_binary()), str(ROOT / "worlds/angen.world")], text=True, stdout=log,
                    stderr=log, env=started.environment | {"ROS_NAMESPACE": house}))
        until(lambda: {f"{house}/angen/ready" for house in HOUSES} <= started.topics().keys(),
              "both serve", 120.0)
        yield started
        assert [end(process) for process in processes[:2]] == [0, 0]
    finally:
        for process in processes:
            end(process)


def angen(master: Master, *words: str) -> str:
    """The output of the angen command."""
    done = subprocess.run(["angen", *words], env=master.environment, capture_output=True,
                          text=True, timeout=60 * SLOWNESS)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_all_names_are_in_the_namespaces(master: Master) -> None:
    registered = master.api.getSystemState("/test")[2]
    names = {name for kind in registered for name, _ in kind}
    outside = {name for name in names if not name.startswith(HOUSES)}
    assert outside <= {"/rosout", "/clock"}  # roscpp subscribes to /clock, but nobody publishes it
    assert "/clock" not in master.topics()
    for house in HOUSES:
        for name in ("clock", "tf", "angen/list", "angen/door/bathroom0", "gazebo/model_states",
                     "gazebo/Door_controller", "turtlebot/cmd_vel", "cmd_vel"):
            assert f"{house}/{name}" in names


def test_a_command_reaches_one_house(master: Master) -> None:
    angen(master, "--ns", "house1", "set", "door", "bathroom0", "open")
    until(lambda: "OPEN " in angen(master, "--ns", "house1", "watch", "--once", "bathroom0"),
          "the door of one house opens")
    assert "CLOSED " in angen(master, "--ns", "house2", "watch", "--once", "bathroom0")


def test_without_a_namespace_there_is_no_simulator(master: Master) -> None:
    done = subprocess.run(["angen", "list"], env=master.environment, capture_output=True, text=True)
    assert done.returncode == 1 and "/house1, /house2; choose one: angen --ns" in done.stderr

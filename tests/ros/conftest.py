"""The nodes of the tests in ROS, on the master of tests/conftest.py."""
from pathlib import Path
from typing import Iterator

import pytest
from browser import Page, Server
from harness import ROOT, WORLD, Angen, Cli, Master, unregister_publishers


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Marks every test of this folder, for -m ros and -m 'not ros'."""
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.ros)


@pytest.fixture(scope="module", autouse=True)
def publishers() -> Iterator[None]:
    """Those that a module's tests have opened end with it."""
    yield
    unregister_publishers()


@pytest.fixture(scope="module")
def angen(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
          ) -> Iterator[Angen]:
    """The node with a small world at rate 1; each file of tests has one of its own."""
    with master.serving(WORLD, tmp_path_factory.mktemp("node"), seed=7) as node:
        yield node


@pytest.fixture
def paused(angen: Angen) -> Iterator[None]:
    with angen.paused():
        yield


@pytest.fixture
def cli(angen: Angen) -> Cli:
    return Cli(angen.master)


@pytest.fixture(scope="module")
def home(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
         ) -> Iterator[Angen]:
    """The building that ./angen run starts: two floors, a robot, a person."""
    with master.serving(ROOT / "worlds/angen.world", tmp_path_factory.mktemp("home")) as node:
        yield node


@pytest.fixture(scope="module")
def page(home: Angen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """angen web beside that building in a browser, which downloads to the folder of the tests."""
    with Server(home.master, tmp_path_factory.mktemp("web")) as server, \
            Page(tmp_path_factory.mktemp("browser"), 1100, 800) as opened:
        opened.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {
            "behavior": "allow", "downloadPath": str(tmp_path_factory.getbasetemp())})
        opened.open(server.url)
        opened.first_view()
        yield opened

"""Runs all tests in units, the longest first; Ctrl-C ends all processes that tests start.

The tests in ROS share a master of their own.
"""
import os
import re
import signal
from typing import Any, Iterator

import pytest
from harness import Master

# Parts of tests' files, the longest units first: a unit runs on one worker, and should not begin
# last. Without an entry a test runs after these: a unit of Python alone takes some seconds.
LONG = ('docs/test_commands.py', 'ros/test_soak.py', 'ros/test_edit.py', 'ros/test_web_plan.py',
        'docs/test_thesis.py', 'ros/test_replay_run.py', 'ros/test_patrol_run.py',
        'data/test_checks.py', 'ros/test_cli.py', 'data/test_generate.py',
        'automation/test_command.py', 'ros/test_controls.py', 'py/test_limits.py',
        'ros/test_traffic.py', 'ros/', 'entry/', 'residents/', 'walktest/test_command.py',
        'seek/', 'care/', 'py/', 'angen_models/')
PAGES = re.compile(r'docs/test_commands\.py::.*\[docs/(build_apartment|robot|tutorial|plugins)')

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

# A shell ignores SIGINT in a process that it starts by &, and children inherit that.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


def unit(name: str) -> str:
    """The unit of a test: tests of a file share a master and a node; pages need not, but two build
    the same plug-in."""
    pages = PAGES.search(name)
    return pages.group().replace('plugins', 'tutorial') if pages else name.partition('::')[0]


def place(name: str) -> int:
    """When a test runs, of all."""
    file = name.partition('::')[0]
    return next((at for at, part in enumerate(LONG) if part in file), len(LONG))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keeps the order within a unit."""
    items.sort(key=lambda item: place(item.nodeid))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """With --dist loadfile: a worker gets one unit after the other."""
    if config.getoption('dist') != 'loadfile':
        return None
    from xdist.scheduler import LoadScopeScheduling

    class Units(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return unit(nodeid)

    return Units(config, log)


@pytest.fixture(autouse=True)
def same_signals() -> Iterator[None]:
    """A test that leaves another handler of a signal fails, not one that needs it later."""
    before = {number: signal.getsignal(number) for number in SIGNALS}
    yield
    after = {number: signal.getsignal(number) for number in SIGNALS}
    for number, handler in before.items():
        signal.signal(number, handler)
    assert after == before


@pytest.fixture(scope='session')
def master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Master]:
    with Master(tmp_path_factory.mktemp('ros')) as started:
        yield started


@pytest.fixture(scope='session')
def rospy_node(master: Master) -> None:
    """This process as a ROS node of that master."""
    for key in ('ROS_MASTER_URI', 'ROS_IP', 'ROS_LOG_DIR', 'ROS_HOME'):
        os.environ[key] = master.environment[key]
    os.environ.pop('ROS_HOSTNAME', None)
    master.api.setParam('/test', '/use_sim_time', True)
    import rospy
    rospy.init_node('angen_tests', disable_signals=True)

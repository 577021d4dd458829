"""./angen run where the ROS master is lost: with a node of the tests that does as the real one."""
import os
from pathlib import Path
import signal
import subprocess
import sys

import pytest

from angen_tools.common.watchdog import marked
from test_run import NODE_RUNS, environment, restore_signals, until  # noqa: F401, a fixture

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.ros

LAUNCH = '''<launch>
  <arg name="world" default="none"/>
  <arg name="rescue" default=""/>
  <node name="angen" pkg="fake_sim" type="fake_node" required="true" output="screen"
        args="$(arg world) $(arg rescue)"/>
</launch>
'''
# Counts in its world how often it has been started.
NODE = '''#!/usr/bin/env python3
import os, sys, time
from xmlrpc.client import ServerProxy
world, rescue = sys.argv[1:3]
count = int(open(world).read())
master = ServerProxy(os.environ["ROS_MASTER_URI"])
mine = master.getPid("/fake")
master.registerService("/fake", "/angen/list", "rosrpc://localhost:1", "http://localhost:1")
print(f"node {count} runs on {world}", flush=True)
while True:
    time.sleep(0.1)
    try:
        if master.getPid("/fake") != mine:
            break
    except OSError:
        pass
if count < 9:
    open(rescue, "w").write(str(count + 1))
print("the ROS master is another", flush=True)
sys.exit(75)
'''


@pytest.fixture
def fake(tmp_path):
    """A package with the node, its launch file, and a world."""
    package = tmp_path / 'fake_sim'
    package.mkdir()
    (package / 'package.xml').write_text(
        '<package format="2"><name>fake_sim</name><version>0.0.0</version><description>a'
        '</description><maintainer email="a@example.org">a</maintainer><license>a</license>'
        '</package>')
    (package / 'fake_node').write_text(NODE)
    (package / 'fake_node').chmod(0o755)
    (package / 'fake.launch').write_text(LAUNCH)
    (package / 'first.world').write_text('0')
    return package


def start(environment, fake, count):  # noqa: F811
    """./angen run as its script starts it."""
    (fake / 'first.world').write_text(str(count))
    environment['ROS_PACKAGE_PATH'] = f'{fake}:{environment.get("ROS_PACKAGE_PATH", "")}'
    environment['XDG_STATE_HOME'] = str(fake.parent)
    return subprocess.Popen(
        [sys.executable, '-m', 'angen_tools.entry.run', fake / 'fake.launch',
         f'world:={fake}/first.world'], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, env=environment, preexec_fn=restore_signals)


def master_of(environment):  # noqa: F811
    """The process id of the master."""
    mark = f'ANGEN_TEST_MARK={environment["ANGEN_TEST_MARK"]}'
    found, = (number for number in marked(mark)
              if b'rosmaster' in Path(f'/proc/{number}/cmdline').read_bytes())
    return found


def test_master_and_node_start_anew_with_the_world(environment, fake):  # noqa: F811
    process = start(environment, fake, 0)
    first = until(process, NODE_RUNS)
    os.kill(master_of(environment), signal.SIGKILL)
    printed = until(process, 'node 1 runs')
    said = [line for line in printed if line.startswith('angen: ')]
    assert ['another one is started' in line for line in said] == [True, False], said
    assert 'starting again with the saved world' in said[1]
    assert 'Traceback' not in ''.join(first + printed)
    assert str(fake.parent / f'angen/rescued-{process.pid}.world') in printed[-1]
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130
    assert list((fake.parent / 'angen').iterdir()) == []
    assert marked(f'ANGEN_TEST_MARK={environment["ANGEN_TEST_MARK"]}') == []


def test_a_node_that_saves_nothing_ends_it(environment, fake):  # noqa: F811
    process = start(environment, fake, 9)
    until(process, NODE_RUNS)
    os.kill(master_of(environment), signal.SIGKILL)
    rest = process.communicate(timeout=60)[0]
    assert process.returncode == 1 and 'the simulator ended unexpectedly' in rest

"""A node that leaps over time in which nothing happens."""
import subprocess
from pathlib import Path

from harness import Cli, Master, end, own_node, until, world_file

STILL = '''<sdf version="1.6"><world name="still">
  <include>
    <uri>model://bathroom_door</uri><name>bathroom_door0</name><pose>0 0 0.02 0 0 0</pose>
  </include>
  <include><uri>model://pir</uri><name>eye</name><pose>0 4 1.5 0 0 0</pose></include>
  <plugin name="doors" filename="libdoor_world_plugin.so"/>
</world></sdf>
'''


def clocks(master: Master, count: int) -> list[float]:
    """That many messages of /clock in a row, s."""
    done = subprocess.run(['/usr/bin/rostopic', 'echo', '-n', str(count), '-p', '/clock'],
                          env=master.environment, text=True, capture_output=True, timeout=60)
    return [int(line.split(',')[1]) * 1e-9 for line in done.stdout.splitlines()[1:]]


def test_it_leaps_and_tells_every_event_and_state(tmp_path: Path) -> None:
    with own_node(tmp_path, STILL, fast='true') as node:
        master, cli = node.master, Cli(node.master)
        times = clocks(master, 20)
        assert max(b - a for a, b in zip(times, times[1:])) > 1.0
        said = (tmp_path / 'said').open('w')
        subscriber = subprocess.Popen(['/usr/bin/rostopic', 'echo', '/angen/events/event'],
                                      env=master.environment, stdout=said)
        until(lambda: any('/rostopic' in name for _, names in
                          master.api.getSystemState('/test')[2][1] for name in names
                          if _ == '/angen/events'), 'rostopic subscribes')
        assert 'OPEN' in cli.does('set', 'door', 'bathroom0', 'open')
        until(lambda: '"opened"' in (tmp_path / 'said').read_text(), 'the door says so')
        end(subscriber)
        assert 'OPEN, -1.57 rad' in cli.does('set', 'door', 'bathroom0', 'open')


def test_fast_needs_no_rate(master: Master, tmp_path: Path) -> None:
    said = master.rejected(world_file(STILL, tmp_path), '_fast:=true', '_rate:=2',
                           '__name:=rejected')
    assert said.splitlines()[-1] == '~fast runs without a rate: leave ~rate out, or give 0'

"""angen care on the running simulator."""
import csv
import subprocess
from pathlib import Path
from typing import Iterator

import pytest
from harness import Angen, Cli, Inbox, end, until

RULES = '''
starts: 23:59
signals:
  lamp on: {of: lamp/kitchen0, is: on}
  door open: {of: "door/*", is: open}
rules:
  - name: lamp_left_on
    reason: The lamp is on.
    at: kitchen_lamp0
    when: [{is: lamp on, for: [1 s, 3 s]}]
  - name: door_open
    reason: The door is open.
    when: [door open, {time: 12:00 to 11:59}]
'''


@pytest.fixture
def care(angen: Angen, cli: Cli, tmp_path: Path) -> Iterator[subprocess.Popen[str]]:
    """The command, which follows the simulator with the lamp off and the door shut."""
    rules = tmp_path / 'rules.yaml'
    rules.write_text(RULES)
    cli.does('set', 'lamp', 'kitchen0', 'off')
    cli.does('set', 'door', 'bathroom0', 'close')
    from angen_msgs.msg import DoorState
    angen.wait('/angen/door/bathroom0', DoorState, lambda state: state.mode == DoorState.CLOSED)
    process = subprocess.Popen([*cli.words, 'care', '--rules', str(rules),
                                '--out', str(tmp_path / 'out')],
                               env=cli.environment, text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
    until(lambda: '/angen/warnings/acknowledge' in [
        topic for topic, _ in angen.master.api.getSystemState('/test')[2][1]], 'care follows')
    yield process
    if process.poll() is None:
        end(process)


def test_a_warning_comes_is_acknowledged_and_ends(care: subprocess.Popen[str], angen: Angen,
                                                  cli: Cli, tmp_path: Path) -> None:
    from angen_msgs.msg import CareWarning, CareWarningArray, Event
    from std_msgs.msg import String
    from visualization_msgs.msg import Marker, MarkerArray
    with Inbox('/angen/warnings', CareWarning) as warnings, Inbox('/angen/events', Event) as log, \
            Inbox('/angen/warnings/markers', MarkerArray) as drawn:
        until(lambda: warnings._subscriber.get_num_connections() > 0, 'care publishes')
        cli.does('set', 'lamp', 'kitchen0', 'on')
        raised = warnings.wait(lambda m: m.rule == 'lamp_left_on', 'the lamp is noticed')
        assert raised.state == CareWarning.RAISED and 0.5 <= raised.degree < 1.0
        assert raised.reason == 'The lamp is on.' and raised.detail.startswith('lamp on since ')
        assert raised.header.stamp == raised.raised
        assert (raised.place.x, raised.place.y, raised.place.z) == (0.0, 3.0, 2.5)
        entry = log.wait(lambda m: m.kind == 'care', 'the event log has it')
        assert (entry.source, entry.event) == ('lamp_left_on', 'warning')
        assert entry.detail.startswith('degree 0.') and entry.header.stamp >= raised.raised
        active = angen.wait('/angen/warnings/active', CareWarningArray, lambda m: m.warnings)
        assert [w.rule for w in active.warnings] == ['lamp_left_on']
        shown = drawn.wait(lambda m: len(m.markers) > 1, 'a marker')
        text = next(m for m in shown.markers if m.type == Marker.TEXT_VIEW_FACING)
        assert text.text == 'The lamp is on.'
        assert (text.pose.position.x, text.pose.position.y) == (0.0, 3.0)
        angen.send('/angen/warnings/acknowledge', String('lamp_left_on'))
        warnings.wait(lambda m: m.state == CareWarning.ACKNOWLEDGED, 'it is acknowledged')
        cli.does('set', 'lamp', 'kitchen0', 'off')
        warnings.wait(lambda m: m.state == CareWarning.ENDED, 'it ends')
        angen.wait('/angen/warnings/active', CareWarningArray, lambda m: not m.warnings)
        cli.does('set', 'lamp', 'kitchen0', 'on')
        until(lambda: [m.state for m in warnings.messages].count(CareWarning.RAISED) == 2,
              'it comes again')
    assert end(care) == 0
    assert care.stdout is not None and 'lamp_left_on raised, degree 0.' in care.stdout.read()
    with (tmp_path / 'out/warnings.csv').open() as file:
        first, second = csv.DictReader(file)
    assert first['acknowledged'] and first['ended'] and not second['ended']
    assert (tmp_path / 'out/care.png').exists()


def test_what_holds_when_it_starts_counts(care: subprocess.Popen[str], angen: Angen, cli: Cli,
                                          tmp_path: Path) -> None:
    end(care)
    cli.does('set', 'door', 'bathroom0', 'open')
    process = subprocess.Popen([*cli.words, 'care', '--rules', str(tmp_path / 'rules.yaml'),
                                '--out', str(tmp_path / 'again')], env=cli.environment, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    assert process.stdout is not None
    line = process.stdout.readline()
    end(process)
    assert 'door_open raised, degree 1.00: The door is open. (door open since ' in line


def test_entities_that_the_world_lacks_are_reported(cli: Cli, tmp_path: Path) -> None:
    rules = tmp_path / 'wrong.yaml'
    rules.write_text(RULES.replace('lamp/kitchen0', 'lamp/kichen0'))
    assert cli.fails('care', '--rules', str(rules)) == (
        f"{rules}:4: signal 'lamp on': the world has no lamp/kichen0; did you mean lamp/kitchen0?")


def test_anybody_may_add_to_the_event_log(angen: Angen) -> None:
    from angen_msgs.msg import Event
    with Inbox('/angen/events', Event) as log:
        until(lambda: log._subscriber.get_num_connections() > 0, 'the log is published')
        angen.send('/angen/events/add', Event(source='clock', kind='test', event='struck',
                                              detail='twelve'))
        entry = log.wait(lambda m: m.kind == 'test', 'the event')
    assert (entry.source, entry.event, entry.detail) == ('clock', 'struck', 'twelve')
    assert entry.header.stamp.to_sec() > 0


def test_it_begins_anew_when_time_does(care: subprocess.Popen[str], angen: Angen, cli: Cli) -> None:
    from angen_msgs.msg import CareWarning
    from std_srvs.srv import Empty
    with Inbox('/angen/warnings', CareWarning) as warnings:
        until(lambda: warnings._subscriber.get_num_connections() > 0, 'care publishes')
        cli.does('set', 'door', 'bathroom0', 'open')
        warnings.wait(lambda m: m.rule == 'door_open', 'the door is noticed')
        angen.call('/gazebo/reset_simulation', Empty)
        before = len(warnings.messages)
        cli.does('set', 'door', 'bathroom0', 'open')
        until(lambda: any(m.state == CareWarning.RAISED and m.rule == 'door_open'
                          for m in warnings.messages[before:]), 'it is noticed again')

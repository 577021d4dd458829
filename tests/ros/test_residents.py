"""People who live in the node by its public topics and services, started before it."""
import json
import math
import subprocess
from pathlib import Path
from typing import Iterator

import pytest
from angen_apps.plan.apartment import apartment
from angen_apps.plan.writer import write_world
from gazebo_msgs.srv import GetModelState
from harness import ROOT, Angen, Inbox, Master, end
from std_msgs.msg import String

SCRIPT = ROOT / 'src/angen_apps/scripts/residents'
ENDS = 240.0  # s of wall time, at most, until residents miss the node in a call
HOUSEHOLD = '''starts: 12
residents: {anna: retired, tom: cat}
'''


@pytest.fixture(scope='module')
def lived(master: Master, rospy_node: None, tmp_path_factory: pytest.TempPathFactory
          ) -> Iterator[tuple[Angen, subprocess.Popen[bytes], Inbox]]:
    folder = tmp_path_factory.mktemp('lived')
    write_world(apartment(1, 1, 7), folder / 'home.world')
    (folder / 'who.yaml').write_text(HOUSEHOLD)
    with Inbox('/angen/residents', String) as truth:
        people = subprocess.Popen(
            ['/usr/bin/python3', str(SCRIPT), str(folder / 'who.yaml'),
             str(folder / 'home.world')], env=master.environment)
        with master.serving(folder / 'home.world', folder, rate=3) as node:
            yield node, people, truth
            end(people)


def test_residents_wait_for_the_node_and_publish_what_they_do(lived) -> None:
    angen, people, truth = lived
    for name in ('anna', 'tom'):
        row = json.loads(truth.wait(lambda m: json.loads(m.data)['resident'] == name,
                                    f'the truth of {name}', 60.0).data)
        assert row['phase'] in ('does', 'goes', 'waits', 'away') and row['activity']
    assert people.poll() is None
    assert not any('NaN' in m.data for m in truth.messages)


def test_a_resident_is_where_the_truth_says(lived) -> None:
    angen, people, truth = lived
    row = json.loads(truth.wait(
        lambda m: (json.loads(m.data)['resident'], json.loads(m.data)['phase'])
        == ('anna', 'does'), 'an activity of anna', 240.0).data)
    state = angen.call('/gazebo/get_model_state', GetModelState, model_name='anna')
    assert state.success
    at = state.pose.position
    assert math.dist((at.x, at.y), (row['x'], row['y'])) < 1.5  # she may have stepped on
    walkers = angen.names('person')
    assert 'tom' in walkers


def test_residents_end_with_the_node(lived, tmp_path: Path) -> None:
    angen, people, _ = lived
    end(angen.process)
    assert people.wait(ENDS) == 1

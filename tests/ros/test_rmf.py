"""Doors and lifts by Open-RMF's topics: requests, states, sessions."""
import subprocess
import time
from pathlib import Path
from typing import Callable, Iterator

import pytest
import rospy
from harness import Angen, Inbox, end, until
from rmf_door_msgs.msg import DoorMode, DoorRequest, DoorState
from rmf_lift_msgs.msg import LiftRequest, LiftState
from std_msgs.msg import String
from std_srvs.srv import Empty

SCRIPT = Path(__file__).resolve().parents[2] / 'src/angen_apps/scripts/rmf'
AGV, END = LiftRequest.REQUEST_AGV_MODE, LiftRequest.REQUEST_END_SESSION


@pytest.fixture(scope='module')
def rmf(angen: Angen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """The node on a world with a door; an elevator comes later. Its log."""
    log = tmp_path_factory.mktemp('rmf') / 'log'
    with log.open('w') as out:
        process = subprocess.Popen(['/usr/bin/python3', '-u', str(SCRIPT)],
                                   env=angen.master.environment, text=True, stdout=out,
                                   stderr=out)
    try:
        until(lambda: 'serving' in log.read_text(), 'the node serves')
        # its cabin's floor is below its origin
        angen.spawn('lift', 'model://elevator', -6.0, 0.0, 0.3)
        yield log
    finally:
        code = end(process)
        assert code == 0, log.read_text()


@pytest.fixture(scope='module')
def doors(rmf: Path) -> Iterator[Inbox]:
    with Inbox('/door_states', DoorState) as inbox:
        yield inbox


@pytest.fixture(scope='module')
def lifts(rmf: Path) -> Iterator[Inbox]:
    with Inbox('/lift_states', LiftState) as inbox:
        yield inbox


def follow(inbox: Inbox, accept: Callable[[object], bool], what: str, timeout: float = 40.0
           ) -> object:
    """The first message from now on that `accept` accepts."""
    seen = len(inbox.messages)
    return until(lambda: next((m for m in inbox.messages[seen:] if accept(m)), None), what, timeout)


def ask_door(angen: Angen, mode: int, name: str = 'bathroom0') -> None:
    angen.send('/door_requests', DoorRequest(requester_id='test', door_name=name,
                                             requested_mode=DoorMode(mode)))


def ask_lift(angen: Angen, session: str, floor: str = '', kind: int = AGV, name: str = 'lift'
             ) -> None:
    angen.send('/lift_requests', LiftRequest(lift_name=name, session_id=session, request_type=kind,
                                             destination_floor=floor))


def test_a_door_opens_and_closes_by_request(angen: Angen, doors: Inbox) -> None:
    closed = doors.wait(lambda m: m.current_mode.value == DoorMode.MODE_CLOSED, 'it is shut')
    assert closed.door_name == 'bathroom0'
    before = rospy.Time.now()
    follow(doors, lambda _: True, 'a state that may be older')
    later = follow(doors, lambda _: True, 'another one')
    assert before < later.door_time < rospy.Time.now() + rospy.Duration(0.5)
    for mode in (DoorMode.MODE_OPEN, DoorMode.MODE_CLOSED):
        ask_door(angen, mode)
        moving = follow(doors, lambda m: m.current_mode.value == DoorMode.MODE_MOVING, 'it moves')
        done = follow(doors, lambda m, at=mode: m.current_mode.value == at, 'it is there')
        assert 1.0 < (done.door_time - moving.door_time).to_sec() < 10.0


def test_states_come_once_a_simulated_second(doors: Inbox, lifts: Inbox) -> None:
    for inbox, time_of in ((doors, 'door_time'), (lifts, 'lift_time')):
        seen = len(inbox.messages)
        until(lambda: len(inbox.messages) > seen + 4, 'more states')
        times = [getattr(m, time_of).to_sec() for m in inbox.messages[seen:seen + 5]]
        assert (times[-1] - times[0]) / 4 == pytest.approx(1.0, abs=0.3)


def test_two_sessions_compete_for_the_lift(angen: Angen, lifts: Inbox, rmf: Path) -> None:
    free = lifts.wait(lambda m: m.lift_name == 'lift' and m.current_floor,
                      'the elevator that was spawned has stopped')
    assert free.available_floors == ['Floor0', 'Floor1']
    assert (free.session_id, free.current_floor) == ('', 'Floor0')
    assert list(free.available_modes) == [LiftState.MODE_HUMAN, LiftState.MODE_AGV]
    ask_lift(angen, 'first', 'Floor1')
    ask_lift(angen, 'second', 'Floor0')
    up = follow(lifts, lambda m: m.motion_state == LiftState.MOTION_UP, 'it moves up')
    assert (up.session_id, up.destination_floor, up.current_floor) == ('first', 'Floor1', 'Floor0')
    assert (up.door_state, up.current_mode) == (LiftState.DOOR_CLOSED, LiftState.MODE_AGV)
    there = follow(lifts, lambda m: m.current_floor == 'Floor1'
                   and m.door_state == LiftState.DOOR_OPEN, 'it has arrived')
    assert (there.motion_state, there.session_id) == (LiftState.MOTION_STOPPED, 'first')
    assert "session 'second' has to wait: 'first' has it" in rmf.read_text()
    angen.send('/gazebo/Elevator_controller', String('Floor0'))  # knows no sessions
    follow(lifts, lambda m: m.motion_state == LiftState.MOTION_DOWN, 'it is called away')
    back = follow(lifts, lambda m: m.motion_state == LiftState.MOTION_UP, 'its session calls it')
    assert (back.session_id, back.destination_floor) == ('first', 'Floor1')
    ask_lift(angen, 'first', kind=END)
    ended = follow(lifts, lambda m: m.session_id == '', 'the session ends')
    assert ended.current_mode == LiftState.MODE_HUMAN
    ask_lift(angen, 'second', 'Floor0')
    down = follow(lifts, lambda m: m.motion_state == LiftState.MOTION_DOWN, 'it moves down')
    assert down.session_id == 'second'


def test_what_is_unknown_is_one_line(angen: Angen, doors: Inbox, lifts: Inbox, rmf: Path) -> None:
    for _ in range(2):
        ask_door(angen, DoorMode.MODE_OPEN, 'attic')
        ask_door(angen, DoorMode.MODE_OFFLINE)
        ask_lift(angen, 'second', 'Floor9')
        ask_lift(angen, 'second', 'Floor1', name='dumbwaiter')
    follow(doors, lambda _: True, 'states go on')
    log = until(lambda: "no lift 'dumbwaiter'" in (text := rmf.read_text()) and text, 'the lines')
    for line in ("there is no door 'attic'; there are: bathroom0", 'requested_mode 3 is neither',
                 "there is no floor 'Floor9', it serves Floor0 to Floor1",
                 "there is no lift 'dumbwaiter'; there are: lift"):
        assert log.count(line) == 1, log
    assert 'Traceback' not in log
    assert doors.messages[-1].current_mode.value == DoorMode.MODE_CLOSED
    assert lifts.messages[-1].destination_floor == 'Floor0'


def test_a_reset_ends_sessions(angen: Angen, lifts: Inbox) -> None:
    lifts.wait(lambda m: m.session_id == 'second', 'a session')
    angen.call('/gazebo/reset_simulation', Empty)
    follow(lifts, lambda m: m.session_id == '' and m.lift_time.to_sec() < 20, 'it is free')


def test_what_is_deleted_is_silent(angen: Angen, lifts: Inbox) -> None:
    angen.delete('lift')
    time.sleep(0.5)
    seen, now = len(lifts.messages), rospy.get_time()
    until(lambda: rospy.get_time() > now + 3.0, 'time advances')
    assert len(lifts.messages) == seen

"""A lift's sessions, their commands, and its reports."""
import pytest
from angen_apps.rmf.lifts import Lift
from angen_tools.session import State
from genpy import Time
from rmf_lift_msgs.msg import LiftRequest, LiftState

END, AGV, HUMAN = (LiftRequest.REQUEST_END_SESSION, LiftRequest.REQUEST_AGV_MODE,
                   LiftRequest.REQUEST_HUMAN_MODE)


def request(session: str, floor: str = '', kind: int = AGV) -> LiftRequest:
    return LiftRequest(lift_name='lift', session_id=session, request_type=kind,
                       destination_floor=floor, door_state=LiftRequest.DOOR_OPEN)


def state(**fields: object) -> State:
    return State('elevator', 'lift', 0.0, {'mode': 'IDLE', 'target_floor': 0, **fields})


def standing(floor: int) -> State:
    return state(mode='IDLE', floor=floor, target_floor=floor, floors=3,
                 door_mode='OPEN')


@pytest.fixture
def lift() -> Lift:
    made = Lift('lift')
    made.take(standing(0))
    return made


def test_it_reports_its_place(lift: Lift) -> None:
    assert lift.report(Time(7)) == LiftState(
        lift_name='lift', lift_time=Time(7), available_floors=['Floor0', 'Floor1', 'Floor2'],
        current_floor='Floor0', destination_floor='Floor0', door_state=LiftState.DOOR_OPEN,
        motion_state=LiftState.MOTION_STOPPED,
        available_modes=[LiftState.MODE_HUMAN, LiftState.MODE_AGV],
        current_mode=LiftState.MODE_HUMAN, session_id='')


def test_on_its_way_the_current_floor_is_the_one_it_left(lift: Lift) -> None:
    assert lift.request(request('robot', 'Floor2')) == 'Floor2'
    assert lift.take(state(mode='UP', floor=-1, target_floor=2, floors=3,
                           door_mode='CLOSED'))
    shown = lift.report(Time())
    assert (shown.current_floor, shown.destination_floor) == ('Floor0', 'Floor2')
    assert (shown.motion_state, shown.door_state) == (LiftState.MOTION_UP, LiftState.DOOR_CLOSED)
    assert (shown.current_mode, shown.session_id) == (LiftState.MODE_AGV, 'robot')
    assert not lift.take(state(mode='UP', floor=-1, position=1.0, target_floor=2, floors=3,
                               door_mode='CLOSED'))


@pytest.mark.parametrize('door', ['OPENING', 'CLOSING', 'BLOCKED'])
def test_a_door_in_between_moves(lift: Lift, door: str) -> None:
    lift.take(state(floor=0, floors=3, door_mode=door))
    assert lift.report(Time()).door_state == LiftState.DOOR_MOVING


def test_one_session_at_a_time(lift: Lift) -> None:
    lift.request(request('first', 'Floor1'))
    with pytest.raises(ValueError, match="session 'second' has to wait: 'first' has it"):
        lift.request(request('second', 'Floor2'))
    with pytest.raises(ValueError, match='has to wait'):
        lift.request(request('second', kind=END))
    assert lift.report(Time()).session_id == 'first'
    assert lift.report(Time()).destination_floor == 'Floor1'
    assert lift.request(request('first', kind=END)) == ''
    assert lift.report(Time()).session_id == ''
    assert lift.request(request('second', 'Floor2', HUMAN)) == 'Floor2'
    assert lift.report(Time()).current_mode == LiftState.MODE_HUMAN


def test_a_repeated_request_is_one_command(lift: Lift) -> None:
    assert lift.request(request('robot', 'Floor1')) == 'Floor1'
    lift.take(state(mode='IDLE', floor=0, target_floor=1, floors=3,
                    door_mode='CLOSING'))
    assert lift.request(request('robot', 'Floor1')) == ''
    assert lift.request(request('robot', 'Floor2')) == 'Floor2'
    assert lift.request(request('robot', 'Floor1')) == 'Floor1'  # cancels the waiting request


def test_a_session_gets_the_lift_back_that_somebody_calls_away(lift: Lift) -> None:
    lift.request(request('robot', 'Floor1'))
    lift.take(standing(1))
    assert lift.command() == ''
    lift.take(standing(0))
    assert lift.is_standing and lift.command() == 'Floor1'
    lift.request(request('robot', kind=END))
    assert lift.command() == ''


@pytest.mark.parametrize('message, why', [
    (request('', 'Floor1'), 'needs a session_id'),
    (request('robot', 'Floor3'), "no floor 'Floor3', it serves Floor0 to Floor2"),
    (request('robot', 'L1'), "no floor 'L1'"),
    (request('robot', ''), "no floor ''"),
    (request('robot', 'Floor²'), 'no floor'),
    (request('robot', 'Floor' + '9' * 1000), "no floor 'Floor9{75}'"),
    (request('robot', 'Floor1', 7), 'request_type 7')])
def test_what_cannot_be_served_changes_nothing(lift: Lift, message: LiftRequest, why: str) -> None:
    before = lift.report(Time())
    with pytest.raises(ValueError, match=why):
        lift.request(message)
    assert lift.report(Time()) == before


def test_it_reports_nothing_before_it_is_known() -> None:
    lift = Lift('lift')
    assert lift.report(Time()) is None and lift.command() == ''
    with pytest.raises(ValueError, match='not reported'):
        lift.request(request('robot', 'Floor1'))

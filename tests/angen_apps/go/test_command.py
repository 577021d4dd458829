"""The goals of angen go."""
import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from angen import Grid

from angen_apps.go import command
from angen_apps.go.command import goal_of, loaded, without
from angen_apps.robot.planner import Planner
from angen_apps.robot.rooms_route import lift_of
from angen_tools.common.failure import Failure, WrongWords
from angen_tools.common.home import Elevator, Home, Landing, Room, Storey

WALL, TABLE = 100, (slice(35, 46), slice(15, 26))  # a table in the middle of the room


def room(name: str, x: float) -> Room:
    return Room(name, '', 0, [(x, 0.0), (x + 2.0, 0.0), (x + 2.0, 4.0), (x, 4.0)], [], 0.0, 2.8,
                8.0, False)


@pytest.fixture
def planners() -> dict[int, Planner]:
    cells = np.zeros((80, 80), np.int8)
    cells[TABLE] = WALL
    return {0: Planner(Grid(cells, (0.0, 0.0), 0.05, 0), 0.22)}


HOME = Home(rooms=[room('kitchen0', 0.0), room('hall0', 2.0)], elevators=[
    Elevator('lift', (-3.0, 5.0, 0.0, 0.0, 0.0, 0.0, 1.0),
             [Landing(0, 'hall0', (-1.7, 5.0, 0.0, 0.0)), Landing(1, '', (-1.6, 5.0, 4.0, 0.0))])])


def test_a_goal_is_the_middle_of_a_room_or_beside_an_obstacle(planners: dict[int, Planner]) -> None:
    assert goal_of(['hall0'], HOME, planners).at == pytest.approx((3.0, 2.0))
    x, y = goal_of(['kitchen0'], HOME, planners).at
    assert 0.25 + 0.22 <= max(abs(x - 1.0), abs(y - 2.0)) and math.dist((x, y), (1.0, 2.0)) < 0.6


def test_a_place_is_as_given(planners: dict[int, Planner]) -> None:
    goal = goal_of(['1.5', '3'], HOME, planners)
    assert (goal.at, goal.floor) == ((1.5, 3.0), 0)


@pytest.mark.parametrize('words, part', [
    (['kitchen'], 'did you mean kitchen0?'), (['1'], 'neither a room nor X Y'),
    (['1', '2', '7'], 'there is no floor 7; known are 0'), (['1', 'nan'], 'neither a room')])
def test_a_wrong_goal_is_named(words: list[str], part: str, planners: dict[int, Planner]) -> None:
    with pytest.raises(Failure) as caught:
        goal_of(words, HOME, planners)
    assert part in str(caught.value)


@pytest.mark.parametrize('words, robot, part', [
    (['hal0'], '', "'hal0' is neither a room .* did you mean hall0"),
    (['1', '2', '7'], '', 'there is no floor 7; known are 0'),
    (['hall0'], 'bot2', 'the world has no robot bot2; did you mean bot'),
    (['hall0'], '', 'it is surveyed')])
def test_wrong_words_are_named_before_the_building_is_surveyed(
        words: list[str], robot: str, part: str, monkeypatch: pytest.MonkeyPatch) -> None:
    class Simulator:
        @property
        def home(self) -> Home:
            return replace(HOME, storeys=[Storey(0, 'Floor 0', 0.0, 2.8)])

        def entities(self, kind: str) -> list[SimpleNamespace]:
            return [SimpleNamespace(name='bot')]

    def survey(*_: object) -> None:
        raise Failure('it is surveyed')

    monkeypatch.setattr(command, 'Live', Simulator)
    monkeypatch.setattr(command, 'Surveyed', survey)
    with pytest.raises(Failure, match=part):
        command.go(words, robot, False)


def test_it_waits_before_the_doors_of_the_elevator_on_its_own_floor() -> None:
    planner = Planner(Grid(np.zeros((80, 120), np.int8), (-5.0, 3.0), 0.05, 0), 0.22)
    for floor, x in ((0, -1.7), (1, -1.6)):
        lift = lift_of(HOME, planner, floor)
        assert lift is not None and math.dist(lift.cabin, (-3.0, 5.0)) < 0.1
        assert math.dist(lift.landing, (x + 0.6, 5.0)) < 0.1
    assert lift_of(HOME, planner, 2) is None


def test_an_elevator_that_the_robot_cannot_enter_is_none() -> None:
    cells = np.full((80, 120), WALL, np.int8)
    assert lift_of(HOME, Planner(Grid(cells, (-5.0, 3.0), 0.05, 0), 0.22), 0) is None


def test_a_plug_in_of_the_world_that_only_the_node_has_is_left_out(tmp_path: Path) -> None:
    door = '<plugin name="doors" filename="libdoor_world_plugin.so"/>'
    xml = '<sdf version="1.6"><world name="w">%s' + door + '<model name="a"><link name="b"/>' \
        '%s</model><include><uri>model://bath_door0</uri></include></world></sdf>'
    foreign = [f'<plugin name="{name}" filename="lib{name}.so"/>' for name in ('mine', 'yours')]
    world = loaded(tmp_path / 'now.world', xml % tuple(foreign))
    assert world.devices('door') == ['bathroom0']
    with pytest.raises(Failure, match='<pose>'):
        loaded(tmp_path / 'now.world', xml % ('<model name="c"><pose>x</pose></model>', ''))


def test_a_model_of_the_running_world_may_come_from_any_folder(tmp_path: Path) -> None:
    (tmp_path / 'own').mkdir()
    (tmp_path / 'own/eye.sdf').write_text(
        '<sdf version="1.6"><model name="eye"><static>true</static><link name="l"/></model></sdf>')
    (tmp_path / 'saved').mkdir()
    world = loaded(tmp_path / 'saved/now.world', f'''<sdf version="1.6"><world name="w"><include>
        <uri>file://{tmp_path}/own/eye.sdf</uri><name>eye</name></include></world></sdf>''')
    assert world.models == ['eye']


def test_too_many_words() -> None:
    with pytest.raises(WrongWords, match=r'has 4 words; give ROOM or X Y \[FLOOR\]'):
        goal_of(['1', '2', '3', '4'], HOME, {})


def test_maps_leave_out_plug_ins_that_only_the_node_has() -> None:
    left = without("""<sdf version="1.6" xmlns:angen="angen"><world name="w">
      <angen:room name="hall0"/>
      <include><uri>file:///tape.sdf</uri><name>tape1</name></include>
      <include><uri>model://chair</uri><name>chair1</name></include>
      <model name="walls"><link name="link"><collision name="c"/>
        <sensor name="s"><plugin filename="libtape.so"/></sensor></link></model>
      <model name="pir0"><link name="link"><sensor name="s"/></link></model></world></sdf>""",
                   {'tape1', 'walls'})
    assert 'tape' not in left and 'xmlns:angen="angen"' in left
    for kept in ('<angen:room name="hall0"', 'chair1', '<collision name="c"', 'name="walls"'):
        assert kept in left
    assert left.count('<sensor') == 1

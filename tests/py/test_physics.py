"""The measurements of bench/physics.py, from SDF to published values, within its tolerances."""
import pytest

import angen
import physics

EXPERIMENTS = {
    'fall': physics.free_fall,
    'small swing': lambda: physics.pendulum(0.05),
    'large swing': lambda: physics.pendulum(2.5),
    'slope': physics.slide,
    'door swing': physics.door_swing,
    'door step': physics.door_step,
    'elevator step': physics.elevator_step,
    'loaded elevator': lambda: physics.elevator_step(300.0),
    'stacks asleep': lambda: physics.drift('stacks', physics.stack_world(True), 120.0),
    'stacks awake': lambda: physics.drift('stacks', physics.stack_world(False), 0.5, settle=1.0),
}


@pytest.mark.parametrize('experiment', EXPERIMENTS)
def test_agrees_with_its_closed_form(experiment: str) -> None:
    for check in EXPERIMENTS[experiment]().checks:
        assert check.ok, check.line()


def test_nothing_in_the_building_drifts(building: str) -> None:
    result = physics.drift('building', angen.World(building), 20.0, settle=10.0)
    assert result.checks[0].ok, result.checks[0].line()


def test_a_number_beyond_its_tolerance_is_wrong() -> None:
    assert not physics.Check('x', 1.02, 'm', 0.01, 1.0).ok
    assert physics.Check('x', 1.005, 'm', 0.01, 1.0).ok

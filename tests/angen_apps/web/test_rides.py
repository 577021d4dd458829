"""A cabin of a generated day carries who stands in it."""
import pytest
from angen_apps.web.rides import Cabin, Rider, cabins

SLIDES = [(0.0, 'lift', 'cabin', 0.1), (0.0, 'lift', 'landing_door', 0.0),
          (9.0, 'lift', 'landing_door', 0.0), (20.0, 'lift', 'cabin', 1.5),
          (21.0, 'lift', 'cabin', 4.1), (50.0, 'lift', 'cabin', 2.0),
          (51.0, 'lift', 'cabin', 0.1), (9.0, 'crane', 'hook', 7.0)]
MIDDLE = (3.0, 1.0)


@pytest.fixture
def cabin() -> Cabin:
    return cabins(SLIDES, {'lift': MIDDLE})['lift']


def test_the_cabin_is_the_part_that_rises(cabin: Cabin) -> None:
    assert cabin.heights == [0.1, 1.5, 4.1, 2.0, 0.1]
    assert [cabin.height(time) for time in (0.0, 19.9, 20.0, 30.0)] == [0.1, 0.1, 1.5, 4.1]
    assert not cabins(SLIDES[:3], {'lift': MIDDLE})


def test_its_state_is_of_its_rides() -> None:
    cabin = Cabin(*MIDDLE, [0.0, 34.0, 34.5, 35.0, 35.5, 90.0, 90.5],
                  [0.0, 0.0, 1.0, 3.0, 3.0, 2.0, 0.0])
    assert [*cabin.states()] == [
        (0.0, 'IDLE', 0.0), (34.0, 'UP', 0.0), (34.5, 'UP', 1.0), (35.0, 'IDLE', 3.0),
        (35.5, 'IDLE', 3.0), (90.0, 'DOWN', 2.0), (90.5, 'IDLE', 0.0)]


def test_a_passenger_rises_with_it_and_stays_upstairs(cabin: Cabin) -> None:
    rider = Rider([cabin], 0.0)
    assert list(rider.step(5.0, 0.0, 0.0, 0.0, 10.0)) == [(5.0, 0.0)]
    ride = [*rider.step(10.0, 3.1, 1.0, None, 20.5), *rider.step(20.5, 3.0, 1.0, 0.0, 30.0)]
    assert ride == [(10.0, 0.0), (20.0, pytest.approx(1.4)), (20.5, pytest.approx(1.4)),
                    (21.0, pytest.approx(4.0))]
    assert list(rider.step(30.0, 1.0, 1.0, 4.0, 90.0)) == [(30.0, 4.0)]  # it leaves without her


def test_a_person_beside_it_stays(cabin: Cabin) -> None:
    rider = Rider([cabin], 0.0)
    assert list(rider.step(10.0, 1.5, 1.0, 0.0, 60.0)) == [(10.0, 0.0)]

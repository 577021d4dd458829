"""Which events count as a detection."""
import numpy as np
import pytest

from angen_apps.patrol.report import first_detection, moving


def test_a_detection_counts_from_when_the_robot_moves() -> None:
    moved = np.array([5.0, 5.1, 9.0])
    assert first_detection(2.0, [(1.0, 1.5), (3.0, 3.5), (4.0, 6.0)], moved) == pytest.approx(4.9)
    assert first_detection(2.0, [(8.95, 9.2)], moved) == pytest.approx(8.95)
    assert first_detection(2.0, [(1.0, 1.5), (3.0, 3.5)], moved) is None
    assert first_detection(None, [(1.0, 1.5)], moved) is None


def test_turning_is_moving() -> None:
    track = np.array([[0.1, 0, 0, 0, 0], [0.2, 0, 0, 0, 0], [0.3, 0, 0, 0, 0.1],
                      [0.4, 0.1, 0, 0, 0.1]])
    assert moving(track).tolist() == [0.3, 0.4]

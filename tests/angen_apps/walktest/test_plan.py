"""The walks of people in a walk test."""
import math

import pytest

from angen_apps.walktest.plan import Area, approaches, boundary, cells, crossings, walk


def test_cells_fill_the_area_and_no_more():
    area = Area(6.0, 90.0)
    places = cells(area, 0.5)
    assert len(places) * 0.25 == pytest.approx(math.pi / 4 * (36 - 0.25), rel=0.06)
    assert all(area.holds(*place) for place in places)
    assert len(set(places)) == len(places)


def test_a_walk_crosses_every_cell_at_its_speed_and_stops_at_the_edges():
    probes = crossings(Area(4.0, 90.0), 1.0, 'across')
    way = walk(probes, 0.5, 2.0)
    for probe in probes:
        assert probe.ends - probe.begins == pytest.approx(2.0)
        middle = [(a + b) / 2 for a, b in zip(probe.start, probe.end)]
        assert middle == pytest.approx(probe.place)
    assert all(b.begins - a.ends >= 2.0 for a, b in zip(probes, probes[1:]))
    times = [point[0] for point in way.waypoints]
    assert times == sorted(set(times)) and way.duration == times[-1]


def test_towards_is_from_far_to_near():
    for probe in crossings(Area(4.0, 90.0), 1.0, 'towards'):
        assert probe.start[0] > probe.end[0] and probe.start[1] == probe.end[1]


def test_boundary_walks_end_inside():
    area = Area(8.0, 90.0)
    probes = boundary(area, 2.0, 3.0)
    assert len(probes) == 7
    for probe in probes:
        assert math.hypot(*probe.place) == pytest.approx(8.0)
        assert math.hypot(*probe.end) < 8.0 < math.hypot(*probe.start)
        assert math.dist(probe.start, probe.end) == pytest.approx(3.0)


def test_approaches_come_straight_from_every_direction_of_the_area():
    probes = approaches(Area(4.0, 90.0), 37, 0.8)
    off = [math.degrees(math.atan2(*reversed(probe.start))) for probe in probes]
    assert off == pytest.approx([2.5 * k - 45 for k in range(37)])
    for probe in probes:
        assert math.hypot(*probe.start) == pytest.approx(4.0)
        assert math.hypot(*probe.end) == pytest.approx(0.8)
        assert math.atan2(*probe.end) == pytest.approx(math.atan2(*probe.start))

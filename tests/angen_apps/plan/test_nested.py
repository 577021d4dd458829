"""Rooms that are drawn within another room."""
from angen_apps.plan.model import Opening, Plan, Room, Storey, Wall
from angen_apps.plan.finish import finish
from angen_apps.plan.polygons import area


def square(x: float, y: float, side: float) -> tuple[tuple[float, float], ...]:
    return (x, y), (x + side, y), (x + side, y + side), (x, y + side)


def walls(corners: tuple[tuple[float, float], ...]) -> list[Wall]:
    return [Wall(a, b, 0.1, 0.0, 2.5) for a, b in zip(corners, corners[1:] + corners[:1])]


def plan(*rooms: Room, walled: tuple[int, ...]) -> Plan:
    storey = Storey(0, 'Ground', 0.0, 2.5)
    storey.rooms = list(rooms)
    storey.walls = [wall for i in walled for wall in walls(rooms[i].polygon)]
    return Plan('home', [storey])


def room(name: str, polygon: tuple[tuple[float, float], ...]) -> Room:
    return Room(name, '', polygon, 0.0, 2.5)


LOFT, BATH, SHOWER = square(0, 0, 10), square(4, 4, 3), square(5, 5, 1)


def test_a_walled_room_is_a_hole_in_the_room_around_it():
    made = finish(plan(room('Loft', LOFT), room('Bath', BATH), room('Shower', SHOWER),
                       walled=(0, 1, 2)))
    holes = {r.name: r.holes for r in made.storeys[0].rooms}
    assert holes == {'loft0': (BATH,), 'bath0': (SHOWER,), 'shower0': ()}


def test_a_part_of_a_room_without_walls_is_none():
    made = finish(plan(room('Loft', LOFT), room('Dining', BATH), walled=(0,)))
    assert [r.holes for r in made.storeys[0].rooms] == [(), ()]


def test_the_same_room_drawn_twice_is_none():
    made = finish(plan(room('Loft', LOFT), room('Loft', LOFT), walled=(0,)))
    assert [r.holes for r in made.storeys[0].rooms] == [(), ()]
    assert area(made.storeys[0].rooms[0].polygon) == 100.0


def test_the_door_of_an_inner_room_leads_into_the_outer_one():
    both = plan(room('Loft', LOFT), room('Bath', BATH), walled=(0, 1))
    door = Opening('door', 5.5, 4.0, 0.0, 0.8, 0.0, 2.0, (-0.05, 0.05))
    both.storeys[0].openings.append(door)
    made = finish(both)
    assert [opening.name for opening in made.storeys[0].openings] == ['bath0']

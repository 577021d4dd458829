"""The person of the whole building, and a door that opens towards it."""
import angen


def until(world: angen.World, seconds: float, done) -> bool:
    """Runs until done(), at most so many simulated seconds."""
    end = world.time + seconds
    while not done() and world.time < end:
        world.run(0.1)
    return done()


def test_person_waits_at_a_shut_door_and_makes_room_for_it_to_open(building):
    world = angen.World(building)
    world.step()

    def person():
        return world.device('person', 'person')

    assert until(world, 60, lambda: 6 < person()['x'] < 8 and person()['y'] < 3.5)
    world.command('door', 'livingroom0', 'Close')
    assert until(world, 30, lambda: person()['mode'] == 'BLOCKED')
    assert person()['y'] < 4  # inside the livingroom, into which its door opens
    world.command('door', 'livingroom0', 'Open')
    assert until(world, 20, lambda: person()['y'] > 4.5)
    assert world.device('door', 'livingroom0')['mode'] == 'OPEN'

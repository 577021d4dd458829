"""Locates tags in a world, by the readings of its sensors, and compares with the truth."""
from typing import Callable

from angen_apps.locate.belief import STEP, Answer, Belief, Evidence
from angen_apps.locate.score import Row, compare
from angen_apps.locate.site import KINDS, make_site
from angen_apps.robot.entities import entities_of
from angen_tools.common.failure import Failure
from angen_tools.session import State, World

SAMPLE = 0.1  # s, at which PIRs and readers publish


class Locator:
    """Keeps a belief by the readings that come."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.site = make_site(world.home, entities_of(world))
        if not self.site.of_kind('rfid'):
            raise Failure('no room has an RFID reader: people cannot be distinguished')
        self.belief = Belief(self.site)
        self._evidence = Evidence()
        self._stepped = world.now
        self._latest: dict[tuple[str, str], State] = {}
        world.states(*KINDS)  # from now on

    def take(self) -> bool:
        """Takes the new readings; whether the belief has been updated."""
        now = self.world.now
        for state in self.world.states(*KINDS, 'door'):
            self._take(state)
            self._latest[state.kind, state.name] = state
        if now <= self._stepped:  # no time has passed, or the clock was set back
            self._stepped = now
            return False
        for state in self._latest.values():  # a reading is valid until the next
            self._take(state)
        if now < self._stepped + STEP - 1e-6:
            return False
        self.belief.step(self._evidence, round(now - self._stepped, 6))
        self._evidence, self._stepped = Evidence(), now
        return True

    def _take(self, state: State) -> None:
        name, pressed = state.name, self._evidence.pressed
        if state.kind == 'pir':
            self._evidence.add_motion(name, bool(state['motion']))
        elif state.kind == 'rfid':
            self._evidence.add_reads(name, state['ids'], state['distances'])
        elif state.kind == 'pressure':
            pressed[name] = pressed.get(name, False) or bool(state['pressed'])
        else:
            self._evidence.open[name] = state['mode'] != 'CLOSED'


def locate(world: World, seconds: float, report: Callable[[float], None],
           drive: Callable[[World], None] = lambda _: None) -> tuple[list[Row], list[Answer]]:
    """Locates for `seconds` of simulated time; the answers beside the truth, and the last ones.

    Calls `drive` before each sample.
    """
    world.run(SAMPLE)  # until all have reported
    locator = Locator(world)
    carriers = {world.state('tag', tag.name)['id']: tag.name for tag in world.entities('tag')}
    began, rows = world.now, list[Row]()
    while world.now < began + seconds - SAMPLE:
        while not locator.take():
            drive(world)
            world.run(SAMPLE)
        at = {tag.name: tag.pose[:3] for tag in world.entities('tag')}
        truth = {tag: at[name] for tag, name in carriers.items() if name in at}
        rows += compare(world.now, locator.belief.answers(), truth, locator.site.home)
        report((world.now - began) / seconds)
    return rows, locator.belief.answers()


def watch(world: World) -> None:
    """Draws the table again and again until q or Ctrl-C."""
    import time
    from contextlib import suppress

    from angen_apps.locate.score import ANSWERS, cells
    from angen_tools.common.terminal import LiveTable
    locator = Locator(world)
    with LiveTable() as screen, suppress(KeyboardInterrupt):
        while not screen.closed():
            answers = locator.belief.answers()
            title = (f'{world.now:.1f} s simulated, {len(answers)} tags read, '
                     f'{sum(bool(answer.room) for answer in answers)} located')
            screen.draw(title, ANSWERS, list(map(cells, answers)), right=ANSWERS[2:])
            time.sleep(STEP)
            locator.take()

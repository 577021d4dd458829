"""angen locate: estimates the rooms of tags in the running simulator, by its public topics."""
from __future__ import annotations

import sys
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Callable

from angen_apps.locate.belief import STEP, Answer, Belief, Evidence
from angen_apps.locate.score import Row, compare
from angen_apps.locate.site import KINDS as SENSORS
from angen_apps.locate.site import make_site
from angen_apps.robot.entities import entity_of
from angen_tools.common.failure import Failure
from angen_tools.common.output import as_json, number, table
from angen_tools.live.client import CONNECT_LIMIT, Client, Mailbox

if TYPE_CHECKING:
    from rich.console import RenderableType

KINDS = (*SENSORS, 'door')
HEAD = ('TAG', 'ROOM', 'CHANCE', 'X', 'Y', 'Z')
REFRESH = 0.5    # s of wall time between two pictures
SILENCE = 30.0   # s of wall time without a message after which the simulator counts as ended


class Locator:
    """Subscribes to sensors and keeps a belief; its time is that of the messages' stamps."""

    def __init__(self, client: Client) -> None:
        self.client = client
        entities = client.entities()
        home = client.home()
        self.site = make_site(home, [entity_of(entity, home) for entity in entities])
        if not self.site.of_kind('rfid'):
            raise Failure('no room has an RFID reader: people cannot be distinguished')
        self.belief = Belief(self.site)
        self.time = 0.0
        self._evidence = Evidence()
        self._stepped = -1.0
        self._doors: dict[str, bool] = {}
        self._pressed: dict[str, bool] = {}
        self._what = {entity.topic: (entity.kind, entity.name) for entity in entities
                      if entity.kind in KINDS}
        self._mail = Mailbox(client)
        for entity in entities:
            if entity.kind in KINDS:
                self._mail.subscribe(entity.topic, entity.type)

    def receive(self, limit: float) -> bool:
        """Takes the messages of up to `limit` s of wall time; false where none came."""
        return self._mail.drain(self._take, limit)

    def _take(self, topic: str, message: Any) -> None:
        kind, name = self._what[topic]
        if kind == 'pir':
            self._evidence.add_motion(name, message.motion)
        elif kind == 'rfid':
            self._evidence.add_reads(name, message)
        elif kind == 'pressure':
            self._pressed[name] = message.pressed
        else:
            self._doors[name] = message.mode != message.CLOSED
            return  # latched: its stamp may be long past
        self._advance(message.header.stamp.to_sec())

    def _advance(self, now: float) -> None:
        if self._stepped < 0.0 or now < self._stepped - 1.0:  # the first, or the clock was set back
            self._stepped = now
        self.time = max(now, self._stepped)
        if now < self._stepped + STEP:
            return
        self._evidence.open = dict(self._doors)
        self._evidence.pressed = dict(self._pressed)
        self.belief.step(self._evidence, now - self._stepped)
        self._evidence = Evidence()
        self._stepped = now

    def truth(self, carriers: dict[str, str]) -> dict[str, tuple[float, float, float]]:
        """x y z of the model of each tag, as /angen/list says; only to be compared with."""
        at = {entity.name: entity.pose.position for entity in self.client.entities('tag')}
        return {tag: (at[name].x, at[name].y, at[name].z)
                for tag, name in carriers.items() if name in at}

    def carriers(self) -> dict[str, str]:
        """The name of the tag device of each id."""
        mail, found = Mailbox(self.client), {}
        tags = self.client.entities('tag')

        def take(topic: str, message: Any) -> bool:
            texts = dict(zip(message.text_names, message.texts))
            found[texts['id']] = message.name
            return len(found) == len(tags)

        for entity in tags:
            mail.subscribe(entity.topic, entity.type)
        if tags:
            mail.until(take, CONNECT_LIMIT)
        return found


def _cells(answer: Answer) -> list[str]:
    at = [number(v, 1) for v in answer.at] if answer.room else ['', '', '']
    return [answer.tag, answer.room or 'unknown', number(answer.chance), *at]


def locate_for(seconds: float, report: Callable[[float], None]
               ) -> tuple[list[Row], list[Answer]]:
    """Locates for `seconds` of simulated time; answers beside the truth, about once a second."""
    locator = Locator(Client())
    carriers = locator.carriers()
    rows: list[Row] = []
    start, compared, heard = -1.0, -1.0, time.monotonic()
    while start < 0.0 or locator.time < start + seconds:
        if locator.receive(REFRESH):
            heard = time.monotonic()
        elif time.monotonic() > heard + SILENCE:
            raise Failure('no readings received; is the simulation paused?')
        if start < 0.0 < locator.time:
            start = locator.time
        if locator.time >= compared + 1.0:
            compared = locator.time
            rows += compare(compared, locator.belief.answers(), locator.truth(carriers),
                            locator.site.home)
            report(compared - start)
    return rows, locator.belief.answers()


def answers_table(answers: list[Answer], json: bool) -> RenderableType:
    """The answers as a table, or as JSON."""
    if json:
        return as_json([{'tag': a.tag, 'room': a.room or None, 'chance': round(a.chance, 3),
                         'at': [round(v, 3) for v in a.at] if a.room else None} for a in answers])
    return table(HEAD, map(_cells, answers), right=('CHANCE', 'X', 'Y', 'Z'))


def watch() -> None:
    """Draws the table again and again until q or Ctrl-C."""
    from angen_tools.common.terminal import LiveTable
    if not sys.stdin.isatty() or not sys.stdout.isatty():
        raise Failure('a live table needs a terminal; use --for TIME for one table')
    locator = Locator(Client())
    with LiveTable() as screen, suppress(KeyboardInterrupt):
        while not screen.closed():
            answers = locator.belief.answers()
            title = (f'{locator.time:.1f} s simulated, {len(answers)} tags read, '
                     f'{sum(bool(a.room) for a in answers)} located')
            screen.draw(title, HEAD, list(map(_cells, answers)), right=HEAD[2:])
            locator.receive(REFRESH)

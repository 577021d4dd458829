"""In which room each tag is: a Bayes filter over rooms, whose doors join them."""
from dataclasses import dataclass, field
from typing import Iterable, Mapping

import numpy as np

from angen_apps.locate.site import Site

STEP = 0.5  # s between two updates


@dataclass(frozen=True)
class Model:
    """Assumptions about people and sensors; all are probabilities except rates."""

    leaves: float = 0.15          # 1/s: how often a person leaves a room by an open way
    through_shut: float = 0.001   # share through a shut door: it may have opened since
    seen: float = 0.5             # a PIR fires in a step while a person is in its room
    stray: float = 0.2            # and while no tag is: through a doorway, or by a stranger
    explains: float = 0.95        # the other tag in a room explains a sensor that fires there
    weight_of_motion: float = 0.5   # exponent of a likelihood: successive steps are correlated
    weight_of_silence: float = 0.2  # no PIR detects a person who sits still
    pressed: float = 0.3          # a mat is pressed while a person is in its room
    press_stray: float = 0.002
    read: float = 0.9             # a tag that is read is in the reader's room, or is seen
    #                               through a door
    hidden: float = 0.8           # a tag in a reader's room is not read in a step: too far, or
    #                               behind the body that carries it
    known: float = 0.5            # a tag whose likeliest room is less likely than this is unknown
    slack: float = 0.3            # m of a reader's distance


@dataclass
class Evidence:
    """The messages of public topics during a step."""

    reads: dict[str, dict[str, float]] = field(default_factory=dict)  # reader: tag: m
    motion: dict[str, bool] = field(default_factory=dict)             # PIR: fired in this step
    open: dict[str, bool] = field(default_factory=dict)               # door: not shut
    pressed: dict[str, bool] = field(default_factory=dict)            # mat

    def add_motion(self, pir: str, motion: bool) -> None:
        self.motion[pir] = self.motion.get(pir, False) or motion

    def add_reads(self, reader: str, ids: Iterable[str], distances: Iterable[float]) -> None:
        """Takes a reading: the tags and their distances (m)."""
        self.reads.setdefault(reader, {}).update(zip(ids, distances))


@dataclass(frozen=True)
class Answer:
    """The estimated place of a tag; `room` is '' if it is unknown."""

    tag: str
    room: str
    chance: float
    at: tuple[float, float, float]  # m; not a number if the room is unknown


class Belief:
    """The chance of each room, for each tag that has ever been read."""

    def __init__(self, site: Site, model: Model | None = None) -> None:
        self.site = site
        self.model = model or Model()
        self.chances: dict[str, np.ndarray] = {}
        self._places: dict[str, tuple[int, np.ndarray]] = {}  # at the last distance: room, x y

    def step(self, evidence: Evidence, seconds: float = STEP) -> None:
        """Takes the evidence of the last `seconds`."""
        for tags in evidence.reads.values():
            for tag in tags:
                self.chances.setdefault(tag, np.full(len(self.site.rooms),
                                                     1.0 / len(self.site.rooms)))
        if not self.chances:
            return
        moves = self._moves(evidence.open, seconds)
        before = {tag: chances @ moves for tag, chances in self.chances.items()}
        for tag, chances in before.items():
            others = [other for name, other in before.items() if name != tag]
            likely = (chances * self._of_motion(evidence.motion, others)
                      * self._of_mats(evidence.pressed, others)
                      * self._of_reads(tag, evidence.reads))
            total = likely.sum()
            self.chances[tag] = likely / total if total > 0.0 else chances

    def answers(self) -> list[Answer]:
        """The present estimate for each tag."""
        return [self._answer(tag) for tag in sorted(self.chances)]

    def _answer(self, tag: str) -> Answer:
        chances = self.chances[tag]
        best = int(chances.argmax())
        if chances[best] < self.model.known:
            return Answer(tag, '', float(chances[best]), (np.nan,) * 3)
        room = self.site.rooms[best]
        place = np.array(room.center)
        if tag in self._places and self._places[tag][0] == best:
            place = self._places[tag][1]
        return Answer(tag, room.name, float(chances[best]),
                      (float(place[0]), float(place[1]), room.floor))

    def _moves(self, is_open: Mapping[str, bool], seconds: float) -> np.ndarray:
        """The chance of each room (column) after a step that began in a room (row)."""
        count = len(self.site.rooms)
        rates = np.zeros((count, count))
        for a, b, door in self.site.ways:
            passes = 1.0 if not door or is_open.get(door, True) else self.model.through_shut
            rates[a, b] = rates[b, a] = max(rates[a, b], self.model.leaves * passes)
        stay = np.exp(-rates.sum(axis=1) * seconds)
        share = rates / np.maximum(rates.sum(axis=1, keepdims=True), 1e-12)
        return share * (1.0 - stay)[:, None] + np.diag(stay)

    def _explained(self, others: list[np.ndarray], stray: float) -> np.ndarray:
        """The chance that a sensor in each room fires for another reason than this tag."""
        unexplained = np.full(len(self.site.rooms), 1.0 - stray)
        for other in others:
            unexplained *= 1.0 - self.model.explains * other
        return 1.0 - unexplained

    def _of_motion(self, motion: Mapping[str, bool], others: list[np.ndarray]) -> np.ndarray:
        """The likelihood of the PIRs, for each room that this tag may be in."""
        model, rooms = self.model, self.site.of_kind('pir')
        explained = self._explained(others, model.stray)
        fired: dict[int, bool] = {}
        for name, fires in motion.items():
            if name in rooms:
                fired[rooms[name]] = fired.get(rooms[name], False) or fires
        return self._of_rooms(fired, explained, model.seen, model.weight_of_motion,
                              model.weight_of_silence)

    def _of_mats(self, pressed: Mapping[str, bool], others: list[np.ndarray]) -> np.ndarray:
        rooms = self.site.of_kind('pressure')
        explained = self._explained(others, self.model.press_stray)
        stepped_on = {rooms[name]: on for name, on in pressed.items() if name in rooms}
        return self._of_rooms(stepped_on, explained, self.model.pressed, 1.0, 0.0)

    def _of_rooms(self, fired: Mapping[int, bool], explained: np.ndarray, rate: float,
                  weight_of_motion: float, weight_of_silence: float) -> np.ndarray:
        """Likelihoods of rooms whose sensors fired or did not, with these exponents."""
        likely = np.ones(len(self.site.rooms))
        for room, fires in fired.items():
            without = explained[room]
            with_tag = 1.0 - (1.0 - rate) * (1.0 - without)
            if fires:
                likely[room] *= (with_tag / without) ** weight_of_motion
            else:
                likely[room] *= ((1.0 - with_tag) / (1.0 - without)) ** weight_of_silence
        return likely

    def _of_reads(self, tag: str, reads: Mapping[str, Mapping[str, float]]) -> np.ndarray:
        """The likelihood that readers read this tag at their distances, or do not."""
        model, rooms = self.model, self.site.of_kind('rfid')
        likely = np.ones(len(self.site.rooms))
        for reader, tags in reads.items():
            if reader not in rooms:
                continue
            own = rooms[reader]
            if tag not in tags:
                likely[own] *= model.hidden
                continue
            for room in range(len(likely)):
                places = self.site.tag_places(reader, room, round(tags[tag], 1), model.slack)
                near = room == own
                likely[room] *= (model.read if near else 1.0 - model.read) if len(places) else 1e-6
                if near and len(places):
                    self._places[tag] = (room, places.mean(axis=0))
        return likely

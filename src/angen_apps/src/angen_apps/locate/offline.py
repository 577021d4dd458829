"""Locating in a world of this process: its sensors' readings, beside the truth."""
from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Callable

from angen_apps.locate.belief import STEP, Answer, Belief, Evidence
from angen_apps.locate.score import Row, compare
from angen_apps.locate.site import make_site
from angen_apps.maps.gridmap import load_world
from angen_apps.robot.entities import entities_of
from angen_tools.common.failure import Failure
from angen_tools.common.home import Home
from angen_tools.common.progress import Progress

SAMPLE = 0.1  # s, at which PIRs and readers publish


def run(path: str, seconds: float, seed: int, drive: Callable[[Any], None] | None = None
        ) -> tuple[list[Row], list[Answer]]:
    """Locates in a world file for `seconds` of simulated time; calls `drive` ten times a second.

    Failure where the world does not load, has no rooms or no reader.
    """
    world = load_world(path, seed)
    world.run(SAMPLE)  # until all have reported
    site = make_site(Home.of_world(world), entities_of(world))
    if not site.of_kind('rfid'):
        raise Failure('no room of the world has an RFID reader: people cannot be distinguished')
    belief, rows = Belief(site), []
    carriers = _carriers(world)
    with Progress('locate') as progress:
        while world.time < seconds:
            evidence = Evidence()
            for _ in range(round(STEP / SAMPLE)):
                if drive is not None:
                    drive(world)
                world.run(SAMPLE)
                _take(world, evidence)
            belief.step(evidence)
            truth = {tag: _place(world, model) for tag, model in carriers.items()}
            rows += compare(world.time, belief.answers(), truth, site.home)
            progress.update(world.time / seconds)
    return rows, belief.answers()


def _take(world: Any, evidence: Evidence) -> None:
    """Adds the current readings and states, as their topics would."""
    for name in world.sensors('pir'):
        evidence.add_motion(name, bool(world.sensor('pir', name)['motion']))
    for name in world.sensors('rfid'):
        evidence.add_reads(name, SimpleNamespace(**world.sensor('rfid', name)))
    for name in world.sensors('pressure'):
        pressed = bool(world.sensor('pressure', name)['pressed'])
        evidence.pressed[name] = evidence.pressed.get(name, False) or pressed
    for name in world.devices('door'):
        evidence.open[name] = world.device('door', name)['mode'] != 'CLOSED'


def _carriers(world: Any) -> dict[str, str]:
    """The model that carries each tag; the truth, for comparison only."""
    return {world.device('tag', name)['id']: model
            for _, name, model, _ in world.entities('tag')}


def _place(world: Any, model: str) -> tuple[float, float, float]:
    index = next(i for i, link in enumerate(world.links) if link.startswith(f'{model}::'))
    x, y, z = (float(v) for v in world.link_poses[index][:3])
    return (x, y, z)

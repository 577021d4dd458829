"""angen task seek: from the words of the command to the folder that it leaves."""
import gc
import multiprocessing
import os
import signal
import sys
from dataclasses import asdict, replace
from pathlib import Path

from angen_apps.maps.gridmap import load_world
from angen_apps.plan.draw import read_scene
from angen_apps.robot.building import write_world
from angen_apps.robot.entities import Entity, entities_of
from angen_apps.robot.rooms_route import prepare
from angen_apps.robot.route_file import Route, default_route
from angen_apps.robot.tables import write_figures
from angen_apps.seek import run
from angen_apps.seek.figure import draw_search, draw_times
from angen_apps.seek.home import Home, make_home
from angen_apps.seek.report import compare, summary, table_of, verdict, write_outcome
from angen_apps.seek.run import Figures
from angen_tools.common.output import as_json, show
from angen_tools.common.progress import Progress
from angen_tools.common.watchdog import end_with_parent
from angen_tools.session.in_process import InProcess

HOME_SHARE = 0.05  # share of the progress: the survey


def seek(route_file: Path | None, world: Path | None, seed: int, ambient: bool, limit: float,
         out: Path, json: bool) -> int:
    """Searches once; 0, or 1 where it found no person or the robot touched something."""
    with Progress('seek', 0.1) as progress:
        home, route, world = survey(route_file, world, out)
        progress.update(HOME_SHARE, 'the building is surveyed')

        def note(now: float, text: str) -> None:
            progress.note(f'{now:6.1f} s  {text}')
            progress.update(max(HOME_SHARE, now / limit), text)

        outcome = run.search(world, route, home, seed, ambient, limit, out / 'seek.world', note)
    write_outcome(outcome, home, out)
    draw_search(home, outcome, read_scene(out / 'seek.world'), out / 'search.png')
    if json:
        print(as_json(asdict(outcome.figures)))
    else:
        print(summary(outcome, home))
        print(f'wrote {out}/search.csv, track.csv, person.csv, goals.csv, events.csv, search.png, '
              'seek.world')
    if outcome.found is None:
        print(f'angen: no person was found within {outcome.figures.time_s:.0f} s', file=sys.stderr)
    return verdict(outcome.figures)


def seek_seeds(route_file: Path | None, world: Path | None, seeds: range, limit: float, out: Path,
               json: bool) -> int:
    """Searches with each seed, with and without ambient sensors, on all cores; a table and a
    figure. 0, or 1 where one found no person or touched something."""
    # By processes that end: this one, which they are made from, has no world and no threads.
    with multiprocessing.get_context('fork').Pool(1, _begin, (os.getpid(),)) as pool:
        home, route, world = pool.apply(survey, (route_file, world, out))
    jobs = [(world, route, home, seed, ambient, limit, out) for seed in seeds
            for ambient in (False, True)]
    found: list[Figures] = []
    # No maxtasksperchild: a worker made later would be killed when the pool's thread ends.
    with multiprocessing.get_context('fork').Pool(os.cpu_count(), _begin, (os.getpid(),)) as pool, \
            Progress('seek', 0.0) as progress:
        for figures in pool.imap_unordered(_one, jobs):
            found.append(figures)
            found.sort(key=lambda f: (f.seed, not f.ambient))
            write_figures(Figures, found, out / 'seek.csv')
            progress.update(len(found) / len(jobs), _line(figures))
    draw_times(found, limit, out / 'seek.png')
    if json:
        print(as_json([asdict(figures) for figures in found]))
    else:
        show(table_of(found))
        print(compare(found, limit))
        print(f'wrote {out}/seek.csv, seek.png')
    return max(verdict(figures) for figures in found)


def _line(figures: Figures) -> str:
    how = 'with ambient sensors' if figures.ambient else 'without'
    return (f'seed {figures.seed} {how}: {figures.time_s:.0f} s, '
            + (f'{figures.room}' if figures.found else 'no person found'))


def _one(job: tuple[Path, Route, Home, int, bool, float, Path]) -> Figures:
    world, route, home, seed, ambient, limit, out = job
    scratch = out / f'seed_{seed}_{"with" if ambient else "without"}.world'
    try:
        return run.search(world, route, home, seed, ambient, limit, scratch).figures
    finally:
        scratch.unlink(missing_ok=True)
        gc.collect()  # the search's world is in a reference cycle


def _begin(parent: int) -> None:
    """Ctrl-C ends the parent, which ends these."""
    end_with_parent(parent)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)


def survey(route_file: Path | None, world: Path | None, out: Path) -> tuple[Home, Route, Path]:
    """The robot's knowledge of the building of a world's file, its route there, and the world."""
    route, world, known = prepare(route_file, world, out, False)
    empty = out / 'survey.world'
    try:
        write_world(world, route.robot, None, empty)
        entities = entities_of(InProcess(load_world(str(empty))))
        route = served(route, entities)
        return make_home(route, empty, entities, (0.0, 0.0, 0.0), known), route, world
    finally:
        empty.unlink(missing_ok=True)


def served(route: Route, entities: list[Entity]) -> Route:
    """The shipped route is for a building with an elevator: without one the robot keeps to its
    floor. The elevator of a user's own route must exist."""
    lifts = [entity.name for entity in entities if entity.kind == 'elevator']
    if route.path != default_route() or route.elevator is None or route.elevator.name in lifts:
        return route
    return replace(route, elevator=None)

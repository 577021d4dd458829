"""A generated day as the source of pages: what angen generate wrote, in the home that it is of."""
import datetime
import math
import tempfile
from collections import defaultdict
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np

from angen_apps.data import shapes
from angen_apps.data.generate import CABINS, HOME, LOADS, sha256
from angen_apps.data.recorder import ACTIVE
from angen_apps.data.site import Site, apartment
from angen_apps.data.tables import (ENTRY, POWER, SLIDES, TRACK, Tables, homes, layout_of,
                                    parsed)
from angen_apps.residents.figures import walker
from angen_apps.web.history import numbers
from angen_apps.web.played import Lined
from angen_apps.web.rides import Cabin, Rider, cabins
from angen_apps.web.store import summary
from angen_tools.common.catalog import kinds, simulator
from angen_tools.common.clock import DAY
from angen_tools.common.failure import Failure

STANDBY = 0.05  # share of the most W of an appliance: with less it is off
LEAST = 1.0  # W of an appliance that is on: the maximum of an unused one is its standby power
STARTS, OPENING = 1.0, 6.0  # s in which all sensors have measured; in which all leaves open
BEFORE, SPEED = 30.0, 20.0  # s before the first gets up, where a page begins to play, and how fast
POSTURES = {'stand': 'standing', 'sit': 'sitting', 'lie': 'lying'}
LEAVES = ('door', 'window', 'cabinet')
WORDS = {'motion': ('MOTION', 'still'), 'area': ('MOTION', 'still'), 'door': ('open', 'closed'),
         'item': ('pressed', 'free'), 'power': ('on', 'off')}  # words of summaries
HAPPENED = {'open': 'opened', 'free': 'released'}  # by these: words of events, if they differ
SHOWN = (*LEAVES, 'lamp', 'appliance', 'person')  # devices whose states the files have
UNITS = {'temperature': ('temperature', '°C'), 'light': ('illuminance', 'lx')}


class Moment(NamedTuple):
    """The place of a resident at a time; `text` and `speed` where another phase begins."""

    time: float
    rank: int
    x: float
    y: float
    yaw: float | None = None
    text: str = ''
    speed: float = 0.0
    floor: float | None = None  # m of height


def moment_of(row: dict[str, str], things: dict[str, Any], floors: dict[str, float]) -> Moment:
    """The start of an interval of the truth."""
    found = _moment(row, things)
    return found._replace(floor=floors.get(row['room']))


def _moment(row: dict[str, str], things: dict[str, Any]) -> Moment:
    start, x, y = float(row['start']), float(row['x']), float(row['y'])
    doing = row['activity'].replace('_', ' ')
    if row['phase'] == 'away':
        return Moment(start, 0, x, y, 0.0, f'away · {doing}')
    if row['phase'] == 'goes':
        return Moment(start, 0, x, y, None, f'walking · {doing}', 1.0)
    text, posture, yaw = f'{POSTURES[row["posture"]]} · {doing}', row['posture'], None
    places = [place['pose'] for place in things.get(row['thing'], {'places': []})['places']
              if place['posture'] == posture != 'stand']
    if places:
        x, y, _, yaw = min(places, key=lambda at: math.dist(at[:2], (x, y)))
        yaw += math.pi if posture == 'lie' else 0.0  # a figure that lies has its feet ahead
    return Moment(start, 0, x, y, yaw, text)


def getting_up(spans: list[Any]) -> list[float]:
    """When a resident gets up, from start, end and activity of each of its intervals."""
    return [end for (_, end, what), (*_, after) in zip(spans, spans[1:])
            if what == 'sleep' != after]


class Day(Lined):
    """A Source, see server.py."""

    def __init__(self, folder: Path, world: Path | None) -> None:
        found = homes(folder)
        if found != [folder]:
            raise Failure(f'{folder}: has several homes; give one, such as {found[0]}')
        self._data, self._layout = folder, layout_of(folder)
        self._settings = parsed(folder / HOME, ENTRY)['settings']
        self._tables = Tables(folder, self._layout)
        self._sensors = {sensor['id']: sensor for sensor in self._layout['sensors']}
        self._start = datetime.datetime.fromisoformat(self._layout['start'])
        speeds = {resident['name']: resident['speed'] for resident in self._layout['residents']}
        guests = self._layout.get('guests', [])
        self._who = {'resident': shapes.word(*speeds, *(guest['name'] for guest in guests))}
        phases: dict[str, set[str]] = {}
        for row in self._truth():
            phases.setdefault(row['resident'], set()).add(row['phase'])
        speeds.update((guest['name'], speeds[guest['host']]) for guest in guests
                      if phases.get(guest['name'], set()) - {'away'})
        for name in speeds:
            if name not in phases:
                raise Failure(f'{folder}/truth.csv.gz: has no line of {name}')
        self._people: dict[str, float] = speeds  # and m/s
        self._cabins: dict[str, Cabin] = {}
        super().__init__(self._layout['days'] * DAY, folder.name)
        for table in (self._events(), self._track(), self._loads(), self._slides()):
            for _ in table:  # before a page opens, it says what is wrong
                pass
        self._world = self._furnished(world)

    def _furnished(self, given: Path | None) -> Any:
        """The world of the data, with the residents."""
        expected = self._settings['world']
        if expected and (given is None or sha256(given) != expected):
            raise Failure(f'{self._data}: is of a world of your own; give the same file, too')
        with tempfile.TemporaryDirectory() as folder:
            if not expected or given is None:
                given = Path(folder) / 'home.world'
                apartment(given)
            site = Site(given, self._settings['seed'], not self._settings['own_sensors'],
                        self._settings['light'])
        for name, speed in self._people.items():
            first = next(r for r in self._truth() if r['resident'] == name)
            room = site.home.room(first['room']) or site.home.rooms[0]
            with simulator(f'{name}: '):
                site.world.spawn(walker(name, speed, 'person'), name,
                                 [*room.center, room.floor, 0.0, 0.0, 0.0])
        self._sources = {name: (kind, model) for kind, name, model, _ in site.world.entities()}
        self._floors = {room.name: room.floor for room in site.home.rooms}
        self._elevations = {storey.number: storey.elevation for storey in site.home.storeys}
        return site.world

    def _truth(self) -> Iterator[dict[str, str]]:
        return self._tables.truth(self._who)

    def _track(self) -> Iterator[dict[str, str]]:
        return self._tables.rows('track.csv.gz', {**TRACK, **self._who})

    def _events(self) -> Iterator[dict[str, str]]:
        return self._tables.events({'sensor': shapes.word(*self._sensors)})

    def _loads(self) -> Iterator[dict[str, str]]:
        """None in data of an earlier version."""
        return self._tables.rows(LOADS, POWER) if (self._data / LOADS).exists() else iter(())

    def _slides(self) -> Iterator[dict[str, str]]:
        """None without an elevator, or in data of an earlier version."""
        return self._tables.rows(CABINS, SLIDES) if (self._data / CABINS).exists() else iter(())

    # --- from the world: the scene, and the angles of open leaves

    def _run(self) -> None:
        world = self._world
        with simulator():
            world.run(STARTS)
            moves = np.flatnonzero(self._show(world, start=self._start.isoformat()))
            self._put_rows()
            closed = world.link_poses
            for kind in LEAVES:
                if world.devices(kind):
                    world.command(kind, 'all', 'Open')
            world.run(OPENING)
            opened = world.link_poses
            self._play({i: closed[i] for i in moves}, {i: opened[i] for i in moves})
        self._finish()

    def _put_rows(self) -> None:
        shown = {*SHOWN, *(self._sources[sensor['name']][0] for sensor in self._layout['sensors']
                           if sensor['kind'] in WORDS and sensor['name'] in self._sources)}
        if (self._data / CABINS).is_file():
            shown.add('elevator')
        self.store.put_rows([  # the world's own air, light and cabins are not those of the day
            summary(kind, name, text, alarm, 0.0, values) if kind in shown
            else summary(kind, name, '', False, 0.0, [])
            for kind, name, text, alarm, _, values in self._world.summaries()], True)

    # --- from the files

    def _play(self, closed: dict[int, Any], opened: dict[int, Any]) -> None:
        self._links: dict[str, list[int]] = defaultdict(list)
        scene: dict[str, Any] = self.store.scene or {}
        self._revision = int(scene['revision'])
        for i, link in enumerate(scene['links']):
            if link['moves']:
                self._links[link['model']].append(i)
        models = {e['name']: e['model'] for e in self.store.part('entities')
                  if e['kind'] == 'lamp'}
        self._lights = {name: [i for i, light in enumerate(scene['lights'])
                               if light['model'] == model] for name, model in models.items()}
        self._closed, self._opened = closed, opened
        for link, pose in closed.items():
            self._place(0.0, link, pose)
        self._play_cabins()
        self._play_residents()
        self._play_events()
        self._play_loads()
        ribbon: list[Any] = [[name, [[float(r['start']), float(r['end']), r['activity']]
                                     for r in self._truth() if r['resident'] == name]]
                             for name in self._people]
        self._line['ribbon'] = ribbon
        first = min((time for _, spans in ribbon for time in getting_up(spans)), default=0.0)
        self._line.update(begin=max(0.0, first - BEFORE), speed=SPEED)

    def _place(self, time: float, link: int, pose: Any) -> None:
        none = np.zeros(0, np.uint32)
        self.store.put_changes(self._revision, np.array([link], np.uint32),
                               np.asarray(pose, np.float32), none, none.astype(np.float32), time)

    def _play_residents(self) -> None:
        things = {thing['name']: thing for thing in self.store.part('home')['things']}
        moments: dict[str, list[Moment]] = defaultdict(list)
        for row in self._truth():
            moments[row['resident']].append(moment_of(row, things, self._floors))
            self.store.add_event([float(row['start']), 'resident', row['resident'], row['phase'],
                                  ' '.join(filter(None, (row['activity'], row['room'])))])
        for step in self._track():
            moments[step['resident']].append(
                Moment(float(step['time']), 1, float(step['x']), float(step['y']),
                       floor=self._elevations.get(int(step.get('storey') or 0))))
        for name in self._people:
            self._walk(name, sorted(moments[name], key=lambda m: (m.time, m.rank)))

    def _walk(self, name: str, moments: list[Moment]) -> None:
        """Poses and texts of a resident; who walks faces ahead."""
        link = self._links[name][0]
        floor = next((m.floor for m in moments if m.floor is not None), 0.0)
        above = float(self._closed[link][2]) - floor  # height of the body's origin
        rider = Rider([*self._cabins.values()], floor)
        at = next(((m.x, m.y) for m in moments if not math.isnan(m.x)), (0.0, 0.0))
        yaw = 0.0
        ends = [*(m.time for m in moments[1:]), self._line['end']]
        for m, end in zip(moments, ends):
            if math.isnan(m.x):  # away
                m = m._replace(x=at[0], y=at[1])
            if m.yaw is not None:
                yaw = m.yaw
            elif math.dist((m.x, m.y), at) > 0.02:
                yaw = math.atan2(m.y - at[1], m.x - at[0])
            at = (m.x, m.y)
            for time, floor in rider.step(m.time, m.x, m.y, m.floor, end):
                self._place(time, link, (m.x, m.y, floor + above, 0, 0, math.sin(yaw / 2),
                                         math.cos(yaw / 2)))
            if m.text:
                self.store.put_rows([('person', name, m.text, False, m.time,
                                      self._values('person', 'speed', m.speed))], False)

    def _play_events(self) -> None:
        leaves = {e['model']: e for e in self.store.part('entities') if e['kind'] in LEAVES}
        for event in self._events():
            time = (datetime.datetime.fromisoformat(event['time']) - self._start).total_seconds()
            sensor = self._sensors[event['sensor']]
            kind, name = sensor['kind'], sensor['name']
            if name not in self._sources or kind == 'mains':
                continue
            source, model = self._sources[name]
            if kind in UNITS:
                field, unit = UNITS[kind]
                value = float(event['value'])
                self.store.put_rows([(source, name, f'{value:g} {unit}', False, time,
                                      self._values(source, field, value))], False)
                continue
            if kind == 'bell':
                self.store.add_event([time, kind, name, 'rang', event['resident']])
                continue
            is_on, moves = event['value'] in ACTIVE, kind in ('motion', 'area')
            word = WORDS[kind][0 if is_on else 1]
            self.store.put_rows([(source, name, word, is_on and moves, time, [])], False)
            if kind == 'door':
                self._turn(time, leaves.get(model), is_on)
            if not moves:
                self.store.add_event([time, kind, name, HAPPENED.get(word, word),
                                      event['resident']])

    def _turn(self, time: float, leaf: dict[str, Any] | None, is_open: bool) -> None:
        if leaf is None:
            return
        poses = self._opened if is_open else self._closed
        for link in self._links[leaf['model']]:
            if link in poses:
                self._place(time, link, poses[link])
        self.store.put_rows([(leaf['kind'], leaf['name'], 'OPEN' if is_open else 'CLOSED', False,
                              time, [])], False)

    def _play_loads(self) -> None:
        """Lamps and appliances as they were switched; the most of a day is full light."""
        loads = [(float(row['time']), row['kind'], row['device'], float(row['watts']))
                 for row in self._loads()]
        most: dict[str, float] = defaultdict(float)
        for _, kind, name, watts in loads:
            most[f'{kind}/{name}'] = max(most[f'{kind}/{name}'], watts)
        known = {(e['kind'], e['name']) for e in self.store.part('entities')}
        for time, kind, name, watts in loads:
            if (kind, name) not in known:  # a fridge
                continue
            share = watts / most[f'{kind}/{name}'] if watts else 0.0
            word = 'ON' if share > STANDBY and (kind == 'lamp' or watts > LEAST) else 'OFF'
            if kind == 'lamp':
                self._shine(time, name, share)
            self.store.put_rows([(kind, name, f'{word} {watts:g} W', False, time,
                                  self._values(kind, 'power', watts))], False)
            if time > 0.0:
                self.store.add_event([time, kind, name, word.lower(), f'{watts:g} W'])

    def _play_cabins(self) -> None:
        links = self.store.scene['links'] if self.store.scene else []
        found = {(link['model'], link['name']): i for i, link in enumerate(links)}
        slides = list(self._slides())
        for row in slides:
            link = found.get((row['model'], row['link']))
            if link is None:
                continue
            pose = [float(row[axis]) for axis in 'xyz']
            self._place(float(row['time']), link, [*pose, *self._closed.get(
                link, links[link]['pose'])[3:]])
        models = {e['name']: e['model'] for e in self.store.part('entities')
                  if e['kind'] == 'elevator'}
        middles = {models.get(one['name'], one['name']): (one['pose'][0], one['pose'][1])
                   for one in self.store.part('home')['elevators']}
        self._cabins = cabins([(float(row['time']), row['model'], row['link'], float(row['z']))
                               for row in slides], middles)
        for name, model in models.items():
            if model in self._cabins:  # else it stays as the world has it
                self.store.put_rows([
                    ('elevator', name, f'{mode}  {height:.2f} m', False, time,
                     self._values('elevator', 'position', height))
                    for time, mode, height in self._cabins[model].states()], False)

    def _shine(self, time: float, lamp: str, share: float) -> None:
        lights = np.array(self._lights.get(lamp, []), np.uint32)
        none = np.zeros(0, np.uint32)
        self.store.put_changes(self._revision, none, np.zeros((0, 7), np.float32), lights,
                               np.full(len(lights), share, np.float32), time)

    def _values(self, kind: str, name: str, value: float) -> list[float | None]:
        """As the fields of a summary, of which one is known."""
        return [value if field['name'] == name else None
                for field in numbers(kinds()[kind])]

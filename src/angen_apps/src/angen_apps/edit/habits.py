"""The usual day of a person who is drawn: from a profile, and as a profile of its own."""
import tempfile
from pathlib import Path
from typing import Any

import yaml

from angen_apps.plan.model import Mover, Planned
from angen_apps.residents.activities import activities
from angen_apps.residents.profiles import DAY, FOLDER, Profile, Span, names, read
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.text_file import read_text

WAKE, SLEEP = 'wake', 'sleep'  # what a planned day has besides activities
HEAD = '# angen edit wrote this, and writes it again when the home is saved\n'


def days() -> dict[str, list[dict[str, Any]]]:
    """The usual days of all profiles, as JSON has them."""
    return {name: [_plain(part) for part in planned(read(name))] for name in names()}


def durations() -> dict[str, float]:
    """How long activities last, s."""
    return {name: round((each.lasts[0] * each.lasts[1]) ** 0.5)
            for name, each in activities().items()}


def planned(profile: Profile) -> tuple[Planned, ...]:
    """The usual day of a profile."""
    found = [*_both(WAKE, profile.wakes), *_both(SLEEP, profile.sleeps)]
    found += [Planned(part.do, part.at.low, part.at.high, part.days, part.chance, part.together,
                      part.lasts) for part in profile.scheduled]
    return tuple(found)


def _both(do: str, spans: dict[str, Span]) -> list[Planned]:
    """One for all days, or one each for weekdays and weekends."""
    if len(set(spans.values())) == 1:
        spans = {'all': next(iter(spans.values()))}
    return [Planned((do,), span.low, span.high, day) for day, span in spans.items()]


def _plain(part: Planned) -> dict[str, Any]:
    made: dict[str, Any] = {'do': list(part.do), 'low': part.low, 'high': part.high,
                            'days': part.days, 'chance': part.chance, 'together': part.together}
    return {**made, 'lasts': list(part.lasts)} if part.lasts else made


def profile_text(mover: Mover) -> str:
    """The profile of a person with a day of its own; Failure if it is no day."""
    data = yaml.safe_load(read_text(FOLDER / f'{mover.habits}.yaml'))
    for do, key in ((WAKE, 'wakes'), (SLEEP, 'sleeps')):
        spans = {day: _span(part) for part in mover.day if part.do == (do,)
                 for day in (('weekday', 'weekend') if part.days == 'all' else (part.days,))}
        if len(spans) != 2:
            raise Failure(f'the day of {mover.name} must say once when it {key} on weekdays and '
                          'on weekends')
        data[key] = spans
    data['scheduled'] = [_scheduled(part) for part in mover.day
                         if part.do not in ((WAKE,), (SLEEP,))]
    if not data['scheduled']:
        del data['scheduled']
    return HEAD + str(yaml.safe_dump(data, sort_keys=False, allow_unicode=True, width=100))


def _scheduled(part: Planned) -> dict[str, Any]:
    made: dict[str, Any] = {'do': list(part.do), 'at': _span(part), 'days': part.days,
                            'chance': part.chance, 'together': part.together}
    if part.lasts:
        made['lasts'] = f'{part.lasts[0] / 60:.4g}-{part.lasts[1] / 60:.4g} min'
    return made


def _span(part: Planned) -> str:
    return '-'.join(f'{int(time % DAY // 3600)}:{int(time % 3600 // 60):02}'
                    for time in (part.low, part.high))


def write_profiles(world: Path, people: dict[str, Mover], starts: int) -> dict[str, str]:
    """Writes the profiles of people, by name, with a day of their own, and who lives there, beside
    a world; returns the profile of each who lives by habits: a name or a file. Failure, and no
    file of it, if one would not be a profile."""
    found = {name: mover.habits for name, mover in people.items() if mover.habits}
    own = {name: world.with_name(f'{world.stem}_{name}.yaml') for name, mover in people.items()
           if mover.habits and mover.day}
    texts = {path: profile_text(people[name]) for name, path in own.items()}
    if own:
        who = {name: own[name].name if name in own else habits for name, habits in found.items()}
        texts[residents_of(world)] = HEAD + yaml.safe_dump(
            {'starts': starts, 'residents': who}, sort_keys=False, allow_unicode=True)
    for path in texts:
        if path.exists() and not read_text(path).startswith(HEAD):
            raise Failure(f'{path}: is not of angen edit, which would write over it; rename it')
    for name in own:
        check_day(people[name])
    for path, text in texts.items():
        write_text(path, text)
    return {**found, **{name: str(path.resolve()) for name, path in own.items()}}


def residents_of(world: Path) -> Path:
    """The file that says who lives in a world."""
    return world.with_name(f'{world.stem}_residents.yaml')


def check_day(mover: Mover) -> None:
    """Failure if the day of a person is no profile."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'day.yaml'
        write_text(path, profile_text(mover))
        try:
            read(str(path))
        except Failure as failure:
            reason = str(failure).partition(f'{path}:')[2].partition(': ')[2] or str(failure)
            raise Failure(f'the day of {mover.name}: {reason}') from None

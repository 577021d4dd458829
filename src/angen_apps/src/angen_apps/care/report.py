"""The output of care: lines for people, warnings.csv, events.csv."""
from pathlib import Path
from typing import Any, Iterable, Sequence

from angen_tools.common.clock import show_time
from angen_apps.care.engine import RAISED, CareWarning, Change, Engine
from angen_tools.session import Event
from angen_tools.common.files import write_csv
from angen_tools.common.output import Table, table
from angen_tools.offline.events import COLUMNS, row

KIND = 'care'  # kind of its events
LOGGED = {RAISED: 'warning'}  # its name in the event log, where that differs


def line_of(change: Change, starts: float) -> str:
    """A change in a line."""
    what = change.warning
    text = f'{show_time(starts + change.time)}  {what.rule.name} {change.event}'
    if change.event != RAISED:
        return text
    return f'{text}, degree {change.degree:.2f}: {what.rule.reason} ({what.detail})'


def event_of(change: Change) -> Event:
    """A change as the event log has it."""
    what = change.warning
    detail = (f'degree {change.degree:.2f}: {what.rule.reason} ({what.detail})'
              if change.event == RAISED else '')
    return Event(change.time, what.rule.name, KIND, LOGGED.get(change.event, change.event), detail)


def warnings_of(engine: Engine) -> list[CareWarning]:
    """All warnings until now, by time."""
    return sorted([*engine.past, *engine.active.values()], key=lambda warning: warning.raised)


def as_dict(warning: CareWarning) -> dict[str, Any]:
    return {'rule': warning.rule.name, 'raised': warning.raised, 'degree': warning.degree,
            'acknowledged': warning.acknowledged, 'ended': warning.ended,
            'reason': warning.rule.reason, 'detail': warning.detail}


def table_of(warnings: Sequence[CareWarning], starts: float) -> Table:
    """The warnings by time of day."""
    def clock(time: float | None) -> str:
        return '-' if time is None else show_time(starts + time)
    return table(('RAISED', 'ENDED', 'RULE', 'DEGREE', 'CONDITIONS'),
                 [(clock(warning.raised), clock(warning.ended), warning.rule.name,
                   f'{warning.degree:.2f}', warning.detail) for warning in warnings],
                 right=('DEGREE',))


def write(engine: Engine, out: Path) -> None:
    """Writes warnings.csv into a folder; times in s, blank where there is none."""
    warnings = warnings_of(engine)
    heads = ('rule', 'raised', 'degree', 'acknowledged', 'ended', 'reason', 'detail')
    rows = [['' if value is None else f'{value:.3f}' if isinstance(value, float) else value
             for value in as_dict(warning).values()] for warning in warnings]
    write_csv(out / 'warnings.csv', heads, rows)


def write_events(events: Iterable[Event], changes: Iterable[Change], out: Path) -> None:
    """Writes events.csv as angen run --fast does, with the warnings among the events."""
    every = sorted([*events, *(event_of(change) for change in changes)],
                   key=lambda event: event.time)
    write_csv(out / 'events.csv', COLUMNS,
              (row(event.time, event.source, event.kind, event.event, event.detail)
               for event in every))

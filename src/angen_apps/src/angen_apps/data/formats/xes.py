"""XES, the standard of process mining: a trace for each day of a resident, start and complete."""
from __future__ import annotations

from pathlib import Path
from xml.sax.saxutils import quoteattr

from angen_apps.data.formats.periods import periods
from angen_apps.data.run import Data
from angen_tools.common.clock import DAY
from angen_tools.common.files import writing

OPENING = '''<?xml version="1.0" encoding="UTF-8"?>
<log xes.version="1849-2016" xmlns="http://www.xes-standard.org/">
<extension name="Concept" prefix="concept" uri="http://www.xes-standard.org/concept.xesext"/>
<extension name="Lifecycle" prefix="lifecycle" uri="http://www.xes-standard.org/lifecycle.xesext"/>
<extension name="Organizational" prefix="org" uri="http://www.xes-standard.org/org.xesext"/>
<extension name="Time" prefix="time" uri="http://www.xes-standard.org/time.xesext"/>
<classifier name="activity" keys="concept:name lifecycle:transition"/>
'''


def write(folder: Path, data: Data) -> list[Path]:
    """activities.xes."""
    path = folder / 'activities.xes'
    every = periods(data)
    with writing(path) as file:
        file.write(OPENING)
        for name, _ in data.residents:
            for day in range(data.days):
                own = [p for p in every if p.resident == name
                       and day * DAY <= p.start < (day + 1) * DAY]
                file.write(f'<trace>{_text("concept:name", f"{name} day {day + 1}")}\n')
                for time, activity, turn in sorted(
                        [(p.start, p.activity, 'start') for p in own]
                        + [(p.end, p.activity, 'complete') for p in own],
                        key=lambda entry: (entry[0], entry[2])):
                    stamp = f'{data.at(time):%Y-%m-%dT%H:%M:%S.%f}'[:-3] + '+00:00'
                    file.write('<event>' + _text('concept:name', activity)
                               + _text('lifecycle:transition', turn) + _text('org:resource', name)
                               + f'<date key="time:timestamp" value="{stamp}"/></event>\n')
                file.write('</trace>\n')
        file.write('</log>\n')
    return [path]


def _text(key: str, value: str) -> str:
    return f'<string key="{key}" value={quoteattr(value)}/>'

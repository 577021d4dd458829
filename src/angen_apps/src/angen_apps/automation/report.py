"""The results of a bench: lines for people, JUnit XML, and tables of what happened."""
import re
from pathlib import Path
from typing import Any, Sequence

from lxml import etree

from angen_apps.automation.bench import Record
from angen_apps.automation.judge import FAILED, OPEN, Verdict
from angen_tools.common.clock import show_time
from angen_tools.common.files import write_csv, write_text

UNPRINTABLE = re.compile('[^\t\n\r -\ud7ff\ue000-\ufffd]')  # what XML cannot have


def clock(record: Record, time: float) -> str:
    """The time of day, after the first day with the number of days."""
    return show_time(record.lines.since + time)


def lines_of(record: Record, verdicts: Sequence[Verdict]) -> list[str]:
    """A line for each expectation; where it is wrong also the first time."""
    found = []
    for verdict in verdicts:
        when = f', first at {clock(record, verdict.wrong[0][0])}' if verdict.wrong else ''
        where = f'{record.scenario.path}:{verdict.expectation.line}: ' \
            if verdict.outcome != 'passed' else ''
        found.append(f'{verdict.outcome:10} {where}{verdict.expectation.name}: '
                     f'{verdict.detail}{when}')
    return found


def as_dict(record: Record, verdicts: Sequence[Verdict]) -> dict[str, Any]:
    return {'scenario': str(record.scenario.path), 'tested': record.tested,
            'lasts': record.lines.end, 'cut': record.cut,
            'expectations': [{'name': verdict.expectation.name, 'outcome': verdict.outcome,
                              'detail': verdict.detail, 'line': verdict.expectation.line,
                              'wrong': [list(span) for span in verdict.wrong]}
                             for verdict in verdicts]}


def code_of(records: Sequence[tuple[Record, Sequence[Verdict]]]) -> int:
    """0 all passed; 1 one failed; 2 none failed, but one was not judged."""
    outcomes = {verdict.outcome for _, verdicts in records for verdict in verdicts}
    return 1 if FAILED in outcomes else 2 if OPEN in outcomes else 0


def suite(record: Record, verdicts: Sequence[Verdict]) -> str:
    """The XML of a run: a case for each expectation."""
    outcomes = [verdict.outcome for verdict in verdicts]
    found = etree.Element('testsuite', name=_clean(str(record.scenario.path)),
                          tests=str(len(verdicts)), failures=str(outcomes.count(FAILED)),
                          errors='0', skipped=str(outcomes.count(OPEN)),
                          time=f'{record.lines.end:.3f}')
    for verdict in verdicts:
        case = etree.SubElement(found, 'testcase', name=_clean(verdict.expectation.name),
                                classname=_clean(record.tested or record.scenario.path.stem))
        if verdict.outcome == FAILED:
            node = etree.SubElement(case, 'failure', message=_clean(verdict.detail))
            node.text = '\n'.join(f'{clock(record, low)} to {clock(record, high)}'
                                  for low, high in verdict.wrong[:100])
        elif verdict.outcome == OPEN:
            etree.SubElement(case, 'skipped', message=_clean(verdict.detail))
    return str(etree.tostring(found, encoding='unicode', pretty_print=True))


def junit(path: Path, suites: Sequence[str]) -> None:
    """Writes JUnit XML."""
    write_text(path, "<?xml version='1.0' encoding='UTF-8'?>\n<testsuites>\n"
               f'{"".join(suites)}</testsuites>\n')


def _clean(text: str) -> str:
    return UNPRINTABLE.sub('?', text)


def tables(folder: Path, record: Record) -> None:
    """Writes commands.csv, what was tested has done, and states.csv, which it saw."""
    write_csv(folder / 'commands.csv', ('time', 'clock', 'by', 'what', 'entity', 'error'),
              [(f'{done.time:.3f}', clock(record, done.time), done.by, done.what, done.entity,
                done.error) for done in record.done])
    rows = sorted((time, name, attribute, value)
                  for (name, attribute), line in record.lines.values.items()
                  for time, value in line if '.' in name)
    write_csv(folder / 'states.csv', ('time', 'clock', 'entity', 'attribute', 'value'),
              [(f'{time:.3f}', clock(record, time), name, attribute, value)
               for time, name, attribute, value in rows])

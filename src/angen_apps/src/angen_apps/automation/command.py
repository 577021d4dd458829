"""angen automation-test: automations over scenarios, judged."""
from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Callable, Sequence

from angen_apps.automation.automations import Where
from angen_apps.automation.bench import Bench, HomeAssistant, Record, Subject
from angen_apps.automation.entities import Entities
from angen_apps.automation.home import House
from angen_apps.automation.judge import Verdict, judge
from angen_apps.automation.report import as_dict, code_of, junit, lines_of, suite, tables
from angen_apps.automation.scenario import Program, Scenario, read_scenario
from angen_tools.common.clock import show_duration
from angen_tools.common.failure import Failure, WrongWords
from angen_tools.common.output import as_json
from angen_tools.common.progress import Progress
from angen_tools.common.watchdog import end_with_parent

if TYPE_CHECKING:
    from angen_apps.automation.compare import Score

Judged = tuple[Record, list[Verdict]]


def run_scenario(scenario: Scenario, automations: Sequence[Path] = ()) -> Judged:
    """Runs and judges a scenario, with its own automations or with others. A mistake in what
    somebody wrote is WrongWords."""
    paths = tuple(automations) or (() if scenario.program else scenario.automations)
    subject, read = _subject(scenario, paths)
    try:
        with Progress('bench', 0.1) as progress:
            record = Bench(scenario, subject, read, progress.update).run()
    except Failure as error:
        raise WrongWords(str(error)) from None
    record.tested = ', '.join(path.stem for path in paths) or 'program'
    return record, judge(record)


def _subject(scenario: Scenario, paths: Sequence[Path]
             ) -> tuple[Subject, Callable[[Entities], None]]:
    """What is tested, and what reads its files when the entities are known."""
    if scenario.program and not paths:
        from angen_apps.automation.program import MqttProgram
        where = Where(scenario.path, scenario.program.line)
        return MqttProgram(scenario.program, where), lambda _: None
    subject = HomeAssistant(paths)
    return subject, subject.read


def test(paths: Sequence[Path], automations: Sequence[Path], out: Path, json: bool,
         program: str = '') -> int:
    """Runs scenarios; writes junit.xml, and of each a picture and tables."""
    from angen_apps.automation.figure import draw
    try:
        scenarios = [read_scenario(path) for path in paths]
    except Failure as error:
        raise WrongWords(str(error)) from None
    if program:
        scenarios = [replace(one, program=Program(program, 1)) for one in scenarios]
    done: list[Judged] = []
    for scenario in scenarios:
        began = time.monotonic()
        record, verdicts = run_scenario(scenario, automations)
        done.append((record, verdicts))
        folder = out / scenario.path.stem if len(scenarios) > 1 else out
        tables(folder, record)
        draw(record, verdicts, folder / 'automation.png')
        if not json:
            print(f'{scenario.path}: {show_duration(record.lines.end)} in '
                  f'{time.monotonic() - began:.1f} s')
            for line in lines_of(record, verdicts):
                print(f'  {line}')
        if record.cut:
            print(f'angen: {record.cut}', file=sys.stderr)
            break
    junit(out / 'junit.xml', [suite(*each) for each in done])
    if json:
        print(as_json([as_dict(*each) for each in done]))
    else:
        print(f'see {out}/junit.xml, automation.png, commands.csv, states.csv')
    return code_of(done) or 2 * (len(done) < len(scenarios))


def list_entities(path: Path, json: bool) -> int:
    """Prints the entities of a scenario's home."""
    from angen_tools.common.output import show, table
    try:
        with tempfile.TemporaryDirectory(prefix='angen_') as folder:
            house = House(read_scenario(path), Path(folder), lambda _: None)
    except Failure as error:
        raise WrongWords(str(error)) from None
    found = [(entity.id, entity.thing.area, f'{entity.thing.kind}/{entity.thing.name}')
             for _, entity in sorted(Entities(house.world).all.items())]
    if json:
        print(as_json([dict(zip(('entity', 'room', 'thing'), row)) for row in found]))
    else:
        show(table(('ENTITY', 'ROOM', 'THING'), found))
    return 0


def compare(path: Path, automations: Sequence[Path], out: Path, json: bool) -> int:
    """Runs two automations over the same days, at once; prints and draws them side by side."""
    from angen_apps.automation import compare as side
    from angen_tools.common.output import show, table
    try:
        scenario = read_scenario(path)
    except Failure as error:
        raise WrongWords(str(error)) from None
    # By processes: this one, which they are made from, has no world and no threads.
    with multiprocessing.get_context('fork').Pool(2, end_with_parent, (os.getpid(),)) as pool:
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)  # the runs end, and say what is open
        try:
            done = pool.starmap(_scored, [(scenario, automation) for automation in automations])
        finally:
            signal.signal(signal.SIGINT, before)
    junit(out / 'junit.xml', [cases for _, cases, _, _ in done])
    cut = next((cut for *_, cut in done if cut), '')
    if cut:
        raise WrongWords(f'{cut}; not compared')
    scores, days = [one for one, *_ in done], done[0][2]
    side.draw(scores, days, out / 'compare.png')
    if json:
        print(as_json(side.as_dict(scores, days)))
    else:
        names, rows = [one.name for one in scores], [one.rows(days) for one in scores]
        show(table(('', *names), [(what, value, other) for (what, value), (_, other)
                                  in zip(*rows)], names))
        print(f'see {out}/compare.png, junit.xml')
    return 0


def _scored(scenario: Scenario, automation: Path) -> tuple[Score, str, float, str]:
    """Of a run: its score, its cases for JUnit, its days, and why it was cut."""
    from angen_apps.automation import compare as side
    record, verdicts = run_scenario(scenario, [automation])
    return side.score(record, verdicts), suite(record, verdicts), side.days_of(record), record.cut

"""angen situations: a PIR's reports of everyday situations, against expectations."""
from pathlib import Path
from typing import Any

import yaml

from angen_apps.situations import figure, report
from angen_apps.situations.stage import AIR, ROOM, Outcome, Row, play
from angen_tools.common.failure import Failure
from angen_tools.common.files import check_output
from angen_tools.common.output import as_json, show
from angen_tools.common.progress import Progress

FILE = Path(__file__).resolve().parent / 'rows.yaml'
MODELS = ('pyroelectric', 'range_difference')


def sources() -> dict[str, str]:
    """The entries that rows name."""
    return _read()['sources']


def rows(only: str = '') -> list[Row]:
    """The battery, or the rows with these words in their group or scene."""
    groups = _read()['groups']
    chosen = [_row(group, entry) for group, entries in groups.items() for entry in entries
              if only.lower() in f'{group}: {entry["scene"]}'.lower()]
    if not chosen:
        raise Failure(f"no situation has '{only}' in its group or scene; the groups are "
                      + ', '.join(groups))
    return chosen


def _read() -> dict[str, Any]:
    return yaml.safe_load(FILE.read_text(encoding='utf-8'))


def _row(group: str, entry: dict[str, Any]) -> Row:
    return Row(group, entry['scene'], entry['expect'], entry['why'], entry['source'],
               tuple(entry['cast']), entry.get('range', ''), entry.get('mount', 'wall'),
               entry.get('air', AIR), tuple(entry.get('settings', {}).items()),
               entry.get('depth', ROOM[0]), entry.get('half', ROOM[1]))


def run(only: str = '', json: bool = False, page: Path | None = None, plan: Path | None = None
        ) -> bool:
    """Plays the rows and prints the table, or writes it into a page, and draws a plan of each.
    True: each came out as it was expected."""
    chosen = rows(only)
    if page is not None:
        report.check_page(page)
    if plan is not None:
        check_output(plan, '.png')
    results: list[list[Outcome]] = []
    with Progress('situations') as progress:
        for row in chosen:
            results.append([play(row, model) for model in MODELS if row.expected(model)])
            progress.update(len(results) / len(chosen), row.scene)
    if page is not None:
        report.write_into(page, results, sources())
    if plan is not None:
        figure.draw(results, plan)
    if json:
        print(as_json([report.as_dict(outcome) for row in results for outcome in row]))
    else:
        show(report.as_table(results))
        show(report.counts(results))
    return all(outcome.passed for row in results for outcome in row)

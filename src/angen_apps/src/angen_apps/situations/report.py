"""Reports the outcomes of the situations: a table for the terminal or a page, and JSON."""
import re
from pathlib import Path
from typing import Any, Mapping, Sequence

from angen_apps.situations.stage import Outcome
from angen_tools.common import files
from angen_tools.common.failure import Failure
from angen_tools.common.output import Table, table

Results = Sequence[Sequence[Outcome]]  # each row's, of one or two models
MARKED = re.compile(r'(<!-- situations -->\n).*?(<!-- end -->)', re.DOTALL)
FAILED = 'red'


def signal_of(outcome: Outcome) -> str:
    """Its greatest signal, with the unit of its model."""
    if outcome.model == 'pyroelectric':
        return f'{1e6 * outcome.signal:.0f} µV'
    return f'{outcome.signal:.2f} m'


def as_dict(outcome: Outcome) -> dict[str, Any]:
    """A row's outcome for JSON."""
    row = outcome.row
    return {'group': row.group, 'scene': row.scene, 'model': outcome.model,
            'expected': row.expected(outcome.model), 'got': outcome.got, 'passed': outcome.passed,
            'signal': outcome.signal, 'threshold': outcome.threshold, 'why': row.why,
            'source': row.source}


def as_table(results: Results) -> Table:
    """A line for each row and model; what failed is red in a terminal."""
    outcomes = [outcome for row in results for outcome in row]
    made = table(('', 'model', 'group', 'scene', 'expected', 'got', 'signal'),
                 [('pass' if each.passed else 'FAIL', each.model, each.row.group, each.row.scene,
                   each.row.expected(each.model), each.got, signal_of(each)) for each in outcomes],
                 right=('signal',))
    for line, each in zip(made.rows, outcomes):
        line.style = None if each.passed else FAILED
    return made


def counts(results: Results) -> str:
    """The number of rows with the expected result, by model."""
    lines = []
    for model in ('pyroelectric', 'range_difference'):
        of = [each.passed for row in results for each in row if each.model == model]
        if of:
            lines.append(f'{model}: {sum(of)} of {len(of)} as expected')
    return '; '.join(lines)


def check_page(page: Path) -> str:
    """The text of a page; Failure if it cannot be read, or has no place for the table."""
    try:
        text = page.read_text(encoding='utf-8')
    except (OSError, UnicodeDecodeError) as error:
        raise Failure(f'{page}: cannot be read: {getattr(error, "strerror", error)}') from None
    if not MARKED.search(text):
        raise Failure(f'{page}: has no <!-- situations --> and <!-- end --> to write between')
    return text


def write_into(page: Path, results: Results, sources: Mapping[str, str]) -> None:
    """Puts the table between the marks of a page."""
    text = check_page(page)
    made = as_markdown(results, sources)
    with files.writing(page) as file:
        file.write(MARKED.sub(lambda match: match.group(1) + made + match.group(2), text))


def as_markdown(results: Results, sources: Mapping[str, str]) -> str:
    """The table of a page: what failed is bold. Sources are numbered below."""
    numbers = {key: number for number, key in enumerate(sources, 1)}
    lines = [counts(results) + '.\n\n']
    group = ''
    for row in results:
        if row[0].row.group != group:
            group = row[0].row.group
            lines.append(f'\n## {group.capitalize()}\n\n'
                         '| scene | expected | pyroelectric | range difference | because |\n'
                         '| --- | --- | --- | --- | --- |\n')
        lines.append(_line(row, numbers))
    lines.append('\n## Sources of the expectations\n\n')
    lines += [f'{numbers[key]}. {text}.\n' for key, text in sources.items()]
    return ''.join(lines)


def _line(outcomes: Sequence[Outcome], numbers: Mapping[str, int]) -> str:
    row = outcomes[0].row
    cells = {each.model: _cell(each) for each in outcomes}
    return (f'| {row.scene} | {row.expect} | {cells["pyroelectric"]} | '
            f'{cells.get("range_difference", "")} | {row.why} [{numbers[row.source]}] |\n')


def _cell(outcome: Outcome) -> str:
    got = outcome.got if outcome.passed else f'**FAIL: {outcome.got}**'
    expected = outcome.row.expected(outcome.model)
    other = '' if expected == outcome.row.expect or outcome.passed else f', expected {expected}'
    return f'{got}{other}, {signal_of(outcome)}'

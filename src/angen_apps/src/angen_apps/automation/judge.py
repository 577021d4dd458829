"""Judges the expectations of a scenario by what was recorded."""
from dataclasses import dataclass, field

from angen_apps.automation.bench import Record
from angen_apps.automation.claims import Spans, both, inverse, pieces, power_used, total
from angen_apps.automation.scenario import Expectation
from angen_tools.common.clock import show_duration

PASSED, FAILED, OPEN = 'passed', 'failed', 'not judged'
FEW = 1e-6  # s
SHORTEST = 0.05  # s: what one moment changes is not seen between two messages


@dataclass
class Verdict:
    """One expectation: `outcome` passed, failed or not judged, `detail` why, `wrong` when."""

    expectation: Expectation
    outcome: str
    detail: str
    wrong: Spans = field(default_factory=list)
    checked: int = 0


def judge(record: Record) -> list[Verdict]:
    """The verdict of each expectation."""
    return [_judged(record, each) for each in record.scenario.expectations]


def _judged(record: Record, each: Expectation) -> Verdict:
    found = {'expect': _expect, 'never': _lasting, 'always': _lasting, 'at_most': _limit,
             'at_least': _limit}[each.kind](record, each)
    if record.cut and found.outcome == PASSED:
        return Verdict(each, OPEN, f'the run ended at {show_duration(record.lines.end)}: '
                                   f'{record.cut}')
    return found


def _expect(record: Record, each: Expectation) -> Verdict:
    lines, end = record.lines, record.lines.end
    wanted = lines.spans(each.claims['expect'])
    during = _during(record, each)
    began = [low for low, _ in lines.spans(each.claims['of']) if low > FEW
             and any(a - FEW <= low < b for a, b in during)]
    judged = [time for time in began if time + each.within <= end]
    late = [time for time in judged
            if not any(low <= time + each.within + FEW and high > time for low, high in wanted)]
    wrong = [(time, time + each.within) for time in late]
    if wrong:
        return Verdict(each, FAILED, f'{len(wrong)} of {len(judged)} times not', wrong, len(judged))
    if not judged:
        return Verdict(each, OPEN, 'never judged: '
                       + ('its end was not reached' if began else
                          f'{each.claims["of"].text} never began'
                          + (f' while {each.claims["while"].text}' if 'while' in each.claims
                             else '')))
    return Verdict(each, PASSED, f'{len(judged)} times', checked=len(judged))


def _during(record: Record, each: Expectation) -> Spans:
    return record.lines.spans(each.claims['while']) if 'while' in each.claims \
        else [(0.0, record.lines.end)]


def _lasting(record: Record, each: Expectation) -> Verdict:
    """Judges never and always."""
    during = _during(record, each)
    if not during:
        return Verdict(each, OPEN, f'never judged: {each.claims["while"].text} never held')
    spans = record.lines.spans(each.claims[each.kind])
    if each.kind == 'always':
        spans = inverse(spans, record.lines.end)
    wrong = [span for span in both(spans, during)
             if span[1] - span[0] > max(each.held, SHORTEST) + FEW]
    if wrong:
        return Verdict(each, FAILED, f'{len(wrong)} times, {show_duration(total(wrong))}', wrong)
    return Verdict(each, PASSED, f'in {show_duration(total(during))}')


def _limit(record: Record, each: Expectation) -> Verdict:
    end = record.lines.end
    windows: Spans = [(0.0, end)]
    if each.per:
        starts = _starts(record, each)
        windows = [(low, low + each.per) for low in starts] or windows
    amounts = [(_amount(record, each, low, high), (low, min(high, end))) for low, high in windows]
    pick = max if each.kind == 'at_most' else min
    amount, span = pick(amounts)
    too = amount > each.limit + FEW if each.kind == 'at_most' else amount < each.limit - FEW
    if record.cut and each.kind == 'at_least' and too:
        return Verdict(each, OPEN, f'the run ended early: {record.cut}')
    shown = {'kWh': f'{1000.0 * amount:.4g} Wh' if amount < 0.1 else f'{amount:.3f} kWh',
             's': show_duration(amount)}.get(each.unit, f'{amount:g}')
    return Verdict(each, FAILED if too else PASSED, shown, [span] if too else [])


def _starts(record: Record, each: Expectation) -> list[float]:
    """Where windows begin: for at_least one after the other, else at each that is counted; the
    most energy may also be in one that ends there."""
    end = record.lines.end
    if each.kind == 'at_least':
        return [i * each.per for i in range(int(end / each.per))]
    moments = _moments(record, each)
    if each.counted == 'energy_of':
        moments += [time - each.per for time in moments if time > each.per]
    return moments


def _moments(record: Record, each: Expectation) -> list[float]:
    """When something that is counted happened."""
    if each.counted == 'changes_of':
        return sorted(time for name in each.things
                      for time, _ in record.lines.values[name, ''][1:])
    if each.counted == 'notes':
        return [done.time for done in record.done
                if not done.entity and each.things[0].lower() in done.what.lower()]
    if each.counted == 'energy_of':
        return sorted(time for line in _watts(record, each).values() for time, _ in line)
    return [low for low, _ in record.lines.spans(each.claims[each.counted])
            if low > FEW or each.counted == 'time_of']


def _watts(record: Record, each: Expectation) -> dict[str, list[tuple[float, str]]]:
    return {name: record.watts.get('/'.join(record.entities.find(name).thing.key), [])
            for name in each.things}


def _amount(record: Record, each: Expectation, low: float, high: float) -> float:
    end = min(high, record.lines.end)
    if each.counted == 'energy_of':
        cut = {name: [(max(time, low), value) for time, after, value in pieces(line, end)
                      if after > low and time < end]
               for name, line in _watts(record, each).items()}
        return power_used(cut, end)
    if each.counted == 'time_of':
        return total(both(record.lines.spans(each.claims['time_of']), [(low, end)]))
    return float(sum(low - FEW <= time < high - FEW for time in _moments(record, each)))

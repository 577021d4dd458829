"""Reads care rules from their YAML file; Failure has file, line, the error and its fix."""
from pathlib import Path
from typing import Any, Callable, Sequence

from angen_tools.common.clock import DAY, duration, time_of_day
from angen_apps.care.membership import Trapezoid, around
from angen_apps.care.rules import Condition, Rule, Rules, Signal
from angen_apps.care.states import STATES
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.yaml_file import Entries, YamlFile, is_list, is_text, line_of

THRESHOLD = 0.5
CONDITION = ('is', 'not', 'for', 'began', 'time')
RULE = ('name', 'when', 'and', 'threshold', 'reason', 'at')


def read_rules(path: Path) -> Rules:
    """The rules of a file."""
    return _Reader(path).rules()


class _Reader(YamlFile):

    def rules(self) -> Rules:
        top = self.entries(self.root, 'a rules file', ('starts', 'signals', 'rules'), ('rules',))
        starts = top.of('starts', self.said, None, time_of_day)
        signals = {name: self._signal(name, node)
                   for name, node in top.of('signals', self.entries, Entries()).items()}
        rules: dict[str, Rule] = {}
        for node in self.list(top['rules'], 'rules'):
            rule = self._rule(node, signals)
            if rule.name in rules:
                raise self.fail(node, f"rule '{rule.name}' is given twice; the first is in line "
                                f'{rules[rule.name].line}')
            rules[rule.name] = rule
        return Rules(self.path, starts, signals, tuple(rules.values()))

    def _signal(self, name: str, node: Any) -> Signal:
        parts = self.entries(node, f"signal '{name}'", ('of', 'is', 'tag', 'until_elsewhere', 'in'),
                             ('of', 'is'))
        of = self._sources(parts['of'], 'of')
        state = self.text(parts['is'], 'is')
        elsewhere = parts.of('until_elsewhere', self._sources, ())
        for source in (*of, *elsewhere):
            kind = source.split('/')[0]
            if kind not in STATES:
                raise self.fail(parts['of'], f"rules know no states of kind '{kind}'; "
                                f'{did_you_mean(kind, STATES)}')
            if state not in STATES[kind]:
                raise self.fail(parts['is'], f"kind {kind} has no state '{state}'; "
                                f'{did_you_mean(state, STATES[kind])}')
        if 'tag' in parts and any(not source.startswith('rfid/') for source in of):
            raise self.fail(parts['tag'], 'only rfid/NAME reads a tag')
        return Signal(name, of, state, parts.of('tag', self.text, ''), elsewhere, line_of(node),
                      parts.of('in', self.texts, ()))

    def _sources(self, node: Any, what: str) -> tuple[str, ...]:
        found = []
        for each in self.nodes(node, what):
            source = self.text(each, what)
            kind, slash, name = source.partition('/')
            if not (kind and slash and name):
                raise self.fail(each, f"'{source}' is not KIND/NAME, as pir/kitchen_pir0_a or "
                                'pir/kitchen_*')
            found.append(source)
        return tuple(found)

    def _rule(self, node: Any, signals: dict[str, Signal]) -> Rule:
        parts = self.entries(node, 'a rule', RULE, ('name', 'when', 'reason'))
        name = self.text(parts['name'], 'name')
        if name == 'all':
            raise self.fail(parts['name'], "a rule cannot be called 'all', which acknowledges all")
        when = tuple(self._condition(each, signals) for each in self.list(parts['when'], 'when'))
        product = parts.of('and', self.choice, 'min', ('min', 'product')) == 'product'
        threshold = parts.of('threshold', self.number, THRESHOLD, 0.01, 1.0)
        return Rule(name, when, product, threshold, self.text(parts['reason'], 'reason'),
                    parts.of('at', self.text, ''), line_of(node))

    def _condition(self, node: Any, signals: dict[str, Signal]) -> Condition:
        if is_text(node):
            return Condition(self._known(node, signals), False, None, None, None)
        parts = self.entries(node, 'a condition', CONDITION)
        if ('is' in parts) + ('not' in parts) + ('time' in parts) != 1:
            raise self.fail(node, "a condition has one of 'is', 'not' and 'time'")
        if 'time' in parts and len(parts) > 1:
            raise self.fail(node, "'time' is a separate condition; for when a signal began "
                            "there is 'began'")
        key = 'is' if 'is' in parts else 'not'
        return Condition(
            self._known(parts[key], signals) if key in parts else '', 'not' in parts,
            parts.of('for', self._lasting), parts.of('began', self._window),
            parts.of('time', self._window))

    def _known(self, node: Any, signals: dict[str, Signal]) -> str:
        name = self.text(node, 'a signal')
        if name not in signals:
            raise self.fail(node, f"there is no signal '{name}'; {did_you_mean(name, signals)}")
        return name

    def _lasting(self, node: Any, what: str) -> Trapezoid:
        if not is_list(node):
            least = self.said(node, what, duration)
            return Trapezoid(least, least)
        corners = self._corners(node, what, duration, (2, 4))
        if list(corners) != sorted(corners):
            raise self.fail(node, 'the durations of for must rise')
        return Trapezoid(*corners)

    def _window(self, node: Any, what: str) -> Trapezoid:
        """The membership of '22:00 to 6:00', with upright edges, or of four corners."""
        if is_list(node):
            corners = self._corners(node, what, time_of_day, (4,))
        else:
            first, _, last = self.text(node, what).partition(' to ')
            try:
                begin, end = time_of_day(first.strip()), time_of_day(last.strip())
            except ValueError:
                raise self.fail(node, f"{what} is '{node.value}'; write it as 22:00 to 6:00, or "
                                'as the four corners of a trapezoid, [21:30, 22:30, 5:30, 6:30]'
                                ) from None
            corners = (begin, begin, end, end)
        if corners[0] == 0.0 and corners[-1] == DAY:
            return Trapezoid(corners[0], corners[1], corners[2], corners[3], DAY)
        try:
            return around(corners, DAY)
        except ValueError as error:
            raise self.fail(node, f'the corners of {what} {error}') from None

    def _corners(self, node: Any, what: str, read: Callable[[str], float], counts: Sequence[int]
                 ) -> tuple[float, ...]:
        nodes = self.list(node, what)
        if len(nodes) not in counts:
            expected = ' or '.join(str(count) for count in counts)
            raise self.fail(node, f'{what} has {len(nodes)} corners, must have {expected}')
        return tuple(self.said(each, what, read) for each in nodes)

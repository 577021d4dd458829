"""A home without a simulator: its sensors and devices, and rules about it."""
from pathlib import Path

from angen_apps.care.engine import Change, Engine
from angen_apps.care.rules_file import read_rules
from angen_tools.session import Event

MIN, H = 60.0, 3600.0
EXISTING = ('plug/stove0', 'pir/kitchen_a', 'pir/kitchen_b', 'pir/bath', 'door/entrance0',
            'rfid/gate')
SIGNALS = '''
signals:
  stove on: {of: plug/stove0, is: on}
  kitchen used: {of: pir/kitchen_*, is: motion}
  in the bathroom: {of: pir/bath, is: motion, until_elsewhere: pir/*}
  door open: {of: door/entrance0, is: open}
  anna read: {of: rfid/gate, is: reads, tag: anna}
'''


class Home:
    """An engine with rules, and events as they come."""

    def __init__(self, folder: Path, rules: str, summaries: dict[str, str] | None = None,
                 starts: str = '0:00') -> None:
        path = folder / 'rules.yaml'
        path.write_text(f'starts: {starts}{SIGNALS}rules:\n{rules}')
        self.engine = Engine(read_rules(path), EXISTING, summaries or {})
        self.changes: list[Change] = []

    def at(self, time: float, source: str, event: str, detail: str = '') -> None:
        kind, name = source.split('/')
        self.changes += self.engine.observe(Event(time, name, kind, event, detail))

    def until(self, time: float) -> None:
        self.changes += self.engine.advance(time)

    def events(self) -> list[tuple[float, str, str]]:
        """Time, rule and event of all changes until now."""
        return [(c.time, c.warning.rule.name, c.event) for c in self.changes]


def rule(name: str, *conditions: str, more: str = '') -> str:
    return (f'  - name: {name}\n    reason: so it is\n    when:\n'
            + ''.join(f'      - {condition}\n' for condition in conditions) + more)

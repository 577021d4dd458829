"""The state of signals: events in; whether each is true, and since when, out."""
from typing import Collection, Mapping

from angen_apps.care.rules import Signal
from angen_apps.care.sources import chosen
from angen_apps.care.states import STATES
from angen_tools.session import Event


class LiveSignal:
    """A signal, and since when it has been true or false."""

    def __init__(self, signal: Signal, existing: Collection[str], summaries: Mapping[str, str],
                 now: float) -> None:
        """`summaries`: the state of each KIND/NAME, as on /angen/summary."""
        self.signal = signal
        self._of = chosen(signal.of, existing)
        self._elsewhere = chosen(signal.elsewhere, existing) - self._of
        self._held = {part for source in self._of
                      for part in self._shown(source, summaries.get(source, ''))}
        self.on = bool(self._held)
        self.since = now

    def _shown(self, source: str, summary: str) -> set[tuple[str, str]]:
        kind = source.split('/')[0]
        if kind == 'rfid':
            tags = summary.split('  ')[0].split()  # after them come distances
            return {(source, tag) for tag in tags if tag != 'none' and self._means(tag)}
        state = STATES[kind][self.signal.state]
        return {(source, '')} if state.matches(summary) else set()

    def _means(self, tag: str) -> bool:
        return self.signal.tag in ('', tag)

    def observe(self, event: Event) -> bool:
        """Handles an event; returns whether the signal has changed."""
        if event.key in self._of:
            self._observe_own(event)
        elif event.key in self._elsewhere:
            if event.event in STATES[event.kind][self.signal.state].begins:
                self._held.clear()
        elif event.kind == 'world' and event.event == 'deleted':
            self._held = {part for part in self._held if part[0].split('/')[1] != event.source}
        on = bool(self._held)
        if on == self.on:
            return False
        self.on, self.since = on, event.time
        return True

    def _observe_own(self, event: Event) -> None:
        state = STATES[event.kind][self.signal.state]
        tags = event.detail.split(', ') if event.kind == 'rfid' else ['']
        parts = {(event.key, tag) for tag in tags if event.kind != 'rfid' or self._means(tag)}
        if event.event in state.begins:
            self._held |= parts
        elif event.event in state.ends and not self._elsewhere:
            self._held -= parts

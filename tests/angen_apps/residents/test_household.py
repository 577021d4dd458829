"""Processes of a household continue at their times, in the order in which they were added."""
import datetime
from types import SimpleNamespace

from angen_apps.residents.household import Household
from angen_tools.common.home import Home


class Clock(SimpleNamespace):
    """A simulator in which only time passes."""

    home, now = Home(), 0.0

    def devices(self, kind=''):
        return []

    def run(self, seconds):
        self.now += seconds


def household():
    return Household(Clock(), SimpleNamespace(home=Home()), 1, 'home', datetime.date(2026, 3, 23))


def process(log, name, *times):
    for time in times:
        log.append((name, time))
        yield time
    log.append((name, 'end'))


def test_a_process_that_is_added_by_a_listener_loses_none():
    home, log = household(), []
    home.add(process(log, 'a', 1.0, 3.0))
    home.heard = lambda: home.now == 1.0 and home.add(process(log, 'b', 2.0))
    home.run(5.0)
    assert log == [('a', 1.0), ('a', 3.0), ('b', 2.0), ('b', 'end'), ('a', 'end')]


def test_processes_that_are_due_together_keep_their_order():
    home, log = household(), []
    home.add(process(log, 'short'))
    home.add(process(log, 'a', 2.0))
    home.run(1.0)
    home.add(process(log, 'b', 2.0))  # as many are left as there were before 'a'
    home.run(3.0)
    assert log[-2:] == [('a', 'end'), ('b', 'end')]

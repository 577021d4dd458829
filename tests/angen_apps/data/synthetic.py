"""A small data set that is written down, to test writers and readers without a simulator."""
from __future__ import annotations

import datetime

from angen_apps.data.recorder import Event
from angen_apps.data.run import Data
from angen_apps.data.site import Sensor
from angen_apps.residents.profiles import read
from angen_apps.residents.truth import Interval
from angen_tools.common.home import Home

SENSORS = [Sensor('D001', 'door', 'reed', 'entrance_contact', 'hall', 0, 0, 2),
           Sensor('I001', 'item', 'contact', 'chair', 'kitchen', 3, 1, 0),
           Sensor('M001', 'motion', 'pir', 'cell_kitchen_00', 'kitchen', 3, 1, 2.7),
           Sensor('T001', 'temperature', 'temperature', 'kitchen_t', 'kitchen', 3, 1, 1.5)]


def doing(start: float, end: float, who: str, what: str, phase: str = 'does') -> Interval:
    return Interval(start, end, who, what, 'free', phase, 'kitchen', '', 'stand', 3.0, 1.0)


def data(residents: int = 1) -> Data:
    truth = [doing(0, 100, 'anna', 'sleep'), doing(100, 103, 'anna', 'eat', 'goes'),
             doing(103, 200, 'anna', 'eat'), doing(200, 86400, 'anna', 'leave', 'away')]
    events = [Event(0.0, 'T001', '21.5', '', '', 'air'),
              Event(3.25, 'M001', 'ON', 'anna', 'sleep', 'motion'),
              Event(5.5, 'M001', 'OFF', 'anna', 'sleep', 'motion'),
              Event(104.000001, 'I001', 'PRESENT', 'anna', 'eat', 'seat'),
              Event(150.5, 'M001', 'ON', 'anna', 'eat', 'motion'),
              Event(152.0, 'M001', 'OFF', 'anna', 'eat', 'motion'),
              Event(199.0, 'I001', 'ABSENT', 'anna', 'eat', 'seat'),
              Event(300.0, 'D001', 'OPEN', 'anna', 'leave', 'hand')]
    who = [('anna', read('worker'))]
    if residents == 2:
        who.append(('bert', read('retired')))
        truth = sorted([*truth, doing(0, 86400, 'bert', 'read')], key=lambda i: i.start)
    return Data(datetime.datetime(2026, 3, 23), 1, 7, who, Home(), SENSORS, events, truth, [],
                {'lamp/kitchen': [(0.0, 0.0), (10.5, 60.0), (20.0, 0.0)]}, [], [], [])

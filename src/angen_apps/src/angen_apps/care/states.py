"""States of sensors and devices that rules can name: which events begin and end them."""
import re
from dataclasses import dataclass


@dataclass(frozen=True)
class State:
    """A state that lasts from one event to another."""

    begins: tuple[str, ...]  # events of angen_msgs/Event
    ends: tuple[str, ...]
    shown: str               # matches the summary of a source in that state

    def matches(self, summary: str) -> bool:
        """Whether a summary says that the state holds."""
        return re.search(self.shown, summary) is not None


POWER = r'(?<![\d.])(?!0+(\.0+)? W)\d+(\.\d+)? W'  # a power above 0
LEAF = {'open': State(('opening', 'opened', 'ajar', 'closing', 'blocked'), ('closed',),
                      r'^(OPEN|AJAR|OPENING|CLOSING|BLOCKED)'),
        'closed': State(('closed',), ('opening', 'opened', 'ajar', 'blocked'), r'^CLOSED')}
PRESSED = {'pressed': State(('pressed',), ('released',), r'^(PRESSED|touched)')}
CONTACT = {'open': State(('opened',), ('closed',), r'^open'),
           'closed': State(('closed',), ('opened',), r'^closed')}
SWITCHED = {'on': State(('on',), ('off',), r'^on\b')}

# by kind; a state of tags is distinguished by the ids in the event's detail
STATES: dict[str, dict[str, State]] = {
    'pir': {'motion': State(('motion',), ('still',), r'^MOTION')},
    'reed': CONTACT,
    'switch': CONTACT,
    'door': LEAF, 'window': LEAF, 'cabinet': LEAF,
    'lamp': SWITCHED, 'heater': SWITCHED, 'appliance': SWITCHED,
    'stove': {**SWITCHED, 'hot': State(('hot',), ('cool',), r'\bHOT\b')},
    'plug': {'on': State(('on',), ('off',), POWER)},
    'pressure': PRESSED, 'contact': PRESSED,
    'person': {'walks': State(('walks',), ('stands', 'blocked'), r'^WALKING')},
    'battery': {'empty': State(('empty',), ('charged',), r'EMPTY')},
    'rfid': {'reads': State(('read',), ('lost',), '')},
}

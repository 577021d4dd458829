"""Values out of the words that the simulator shows."""
from typing import Any

import pytest

import angen
from angen_tools.common.catalog import kinds
from angen_tools.common.shown import values_of


def field(name: str, kind: str, unit: str = '', words: tuple[str, ...] = (),
          shown: bool = True) -> dict[str, Any]:
    return {'name': name, 'type': kind, 'unit': unit, 'words': list(words), 'shown': shown}


@pytest.mark.parametrize('fields, text, values', [
    ([field('on', 'flag', '', ('on', 'off')), field('level', 'number', '1'),
      field('power', 'number', 'W')], 'off  50 %  0.5 W',
     {'on': (False, ''), 'level': (50.0, '%'), 'power': (0.5, 'W')}),
    ([field('a', 'numbers', 'm/s^2'), field('hidden', 'text', shown=False)],
     '0.02 -0.05 9.78 m/s^2', {'a': ([0.02, -0.05, 9.78], 'm/s^2')}),
    ([field('t', 'numbers', '°C')], 'kitchen 20.1, bedroom 18.0 °C',
     {'t': ({'kitchen': 20.1, 'bedroom': 18.0}, '°C')}),
    ([field('mode', 'choice'), field('angle', 'number', 'rad')], 'OPEN  -1.57 rad',
     {'mode': ('OPEN', ''), 'angle': (-1.57, 'rad')}),
    ([field('tags', 'texts')], 'none', {'tags': ([], '')}),
    ([field('range', 'number', 'm')], 'inf m', {'range': (float('inf'), 'm')}),
    ([field('range', 'number', 'm')], 'failed: x.py:3  wrong', {}),
    ([field('x', 'number', 'm', shown=False)], 'x=1.50  ok=yes',
     {'x': (1.5, ''), 'ok': ('yes', '')}),
])
def test_each_field_has_its_value_and_unit(fields: list[dict[str, Any]], text: str,
                                           values: dict[str, tuple[Any, str]]) -> None:
    assert values_of({'fields': fields}, text) == {
        name: {'value': value, 'unit': unit} for name, (value, unit) in values.items()}


def test_the_values_are_those_of_the_states() -> None:
    """Compares the shown values of each device of the building with its state."""
    from tests.docs.pages import ROOT
    world = angen.World(str(ROOT / 'worlds/angen.world'))
    world.run(2.0)
    compared = 0
    for kind, name, _, _ in world.entities():
        if name not in world.devices(kind):
            continue
        state = world.device(kind, name)
        for key, each in values_of(kinds().get(kind), world.summary(kind, name)).items():
            if isinstance(each['value'], float) and isinstance(state[key], float):
                scale = 100.0 if each['unit'] == '%' and abs(state[key]) <= 1.0 else 1.0
                assert each['value'] == pytest.approx(scale * state[key], abs=0.51)
                compared += 1
            elif isinstance(each['value'], bool):
                assert each['value'] == state[key]
                compared += 1
    assert compared > 50

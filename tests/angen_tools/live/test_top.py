"""The output of angen top for a message of costs."""
from types import SimpleNamespace
from typing import Any

from angen_tools.live import top


def cost(**changes: Any) -> SimpleNamespace:
    instances = [SimpleNamespace(kind=kind, name=name, cost=value) for kind, name, value in (
        ('pir', 'b', 10.0), ('door', 'd', 50.0), ('pir', 'a', 10.0))]
    values = {'simulated': 2.0, 'elapsed': 1.0, 'process': 200.0, 'physics': 100.0, 'devices': 50.0,
              'sensors': 20.0, 'commands': 0.0, 'snapshots': 5.0, 'publishing': 5.0,
              'network': 15.0}
    return SimpleNamespace(**{**values, 'instances': instances, **changes})


def test_the_most_expensive_comes_first_and_equals_by_name() -> None:
    assert top.rows(cost()) == [['door', 'd', '50.0', '25.0 %'], ['pir', 'a', '10.0', '5.0 %'],
                                ['pir', 'b', '10.0', '5.0 %']]
    assert top.rows(cost(process=0.0))[0][3] == '0.0 %'


def test_the_title_has_the_sum_and_the_rest() -> None:
    title = top.title(cost())
    # 200 µs a simulated second, 2 simulated seconds a second: 0.04 % of a processor
    assert 'at 0.0 % of a processor' in title and title.endswith('network 15, the rest 5')
    assert 'at 40.0 %' in top.title(cost(process=200_000.0))
    assert 'has not advanced for' in top.title(cost(simulated=0.0))


def test_json_has_each_part_and_instance() -> None:
    made = top.as_dict(cost())
    assert made['physics'] == 100.0 and len(made['instances']) == 3
    assert set(top.PARTS) <= set(made)

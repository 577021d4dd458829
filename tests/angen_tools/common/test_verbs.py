"""Commands in the words of their kind."""
import pytest

from angen_tools.common import verbs
from angen_tools.common.catalog import kind_of


@pytest.mark.parametrize('kind, words, text', [
    ('door', 'Open', 'Open'), ('door', 'close', 'Close'), ('door', '-1.2', 'Set -1.2'),
    ('door', 'SET -1.2', 'Set -1.2'), ('elevator', '01', 'Floor 01'),
    ('elevator', 'floor1', 'Floor 1'), ('elevator', 'Floor 1', 'Floor 1'), ('lamp', 'on', 'On'),
    ('lamp', '40%', 'Dim 40'), ('lamp', 'dim 40', 'Dim 40'), ('lamp', '40 %', 'Dim 40'),
    ('heater', '0', 'Set 0'), ('drive', '0.2 -0.1', '0.2 -0.1'), ('drive', '0.2, -0.1', '0.2 -0.1'),
    ('drive', 'stop', 'Stop'), ('person', 'go', 'Go'),
    ('person', 'goto 1.5, -2', 'GoTo 1.5 -2'), ('person', 'goto 1 2 1', 'GoTo 1 2 1'),
    ('person', 'goto kitchen0', 'GoTo kitchen0'), ('person', 'sit', 'Sit'),
    ('person', 'lie bed0', 'Lie bed0'), ('door', 'unlatch', 'Unlatch'),
    ('climate', 'outside -5', 'Outside -5'), ('door', '-90deg', 'Set -1.57079633'),
    ('drive', '0.2 -90deg', '0.2 -1.57079633'), ('drive', '90deg 0', None),
    ('door', 'set -45°', 'Set -0.785398163'), ('lamp', '40deg', None), ('door', '90degrees', None)])
def test_values_become_commands(kind: str, words: str, text: str | None) -> None:
    if text is None:
        with pytest.raises(ValueError):
            verbs.parse(kind_of(kind), words.split())
    else:
        assert verbs.parse(kind_of(kind), words.split()).text == text


@pytest.mark.parametrize('kind, words, part', [
    ('door', 'ajar',
     "'ajar' is not a command of a door, which takes open, close, openbyhand, closebyhand, "
     "unlatch or radians"),
    ('door', 'opne', 'did you mean open?'), ('stove', 'frontlef 50', 'mean frontleft 50?'),
    ('door', 'nan', 'openbyhand, closebyhand, unlatch or radians'),
    ('door', 'open 3', 'unexpected after open'),
    ('door', 'set', 'set takes one number of radians'), ('door', 'set x', 'not a number'),
    ('lamp', '101', 'out of range; a lamp takes on, off or 0 to 100 percent'),
    ('lamp', '-1', '0 to 100 percent'), ('lamp', 'dim -1', '0 to 100 percent'),
    ('elevator', '1.5', 'not a number of floor'), ('elevator', '-1', 'not a number of floor'),
    ('drive', '0.2', 'a number of m/s and a number of rad/s'), ('drive', '1 2 3', 'stop'),
    ('drive', 'nan 1', 'stop'), ('person', 'goto 1', 'goto takes 2 numbers, x y'),
    ('door', '1,5', 'radians; a decimal has a point: 1.5'),
    ('person', 'goto 1 x', "'x' is not a number of x y"), ('lamp', '1e999', '0 to 100')])
def test_an_unknown_command_lists_the_known_ones(kind: str, words: str, part: str) -> None:
    with pytest.raises(ValueError) as error:
        verbs.parse(kind_of(kind), words.split())
    assert part in str(error.value)


def test_an_angle_of_more_than_a_turn_may_be_in_degrees(capsys: pytest.CaptureFixture[str]
                                                        ) -> None:
    assert verbs.parse(kind_of('door'), ['-90']).text == 'Set -90'
    assert '-90 degrees are -90deg' in capsys.readouterr().err
    verbs.parse(kind_of('door'), ['-90deg'])
    assert not capsys.readouterr().err


def test_the_number_of_a_verb_comes_with_it() -> None:
    order = verbs.parse(kind_of('elevator'), ['1'])
    assert (order.verb['name'], order.number) == ('Floor', 1)


def test_the_forms_that_help_shows() -> None:
    assert verbs.described_forms(kind_of('lamp')) == [
        ('on', 'full brightness'), ('off', 'dark'),
        ('[dim] PERCENT', 'of its full brightness; 0 to 100 percent')]
    assert verbs.described_forms(kind_of('drive'))[-1] == ('M/S RAD/S', 'numbers alone')

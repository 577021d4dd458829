"""Words that were pasted from a PDF."""
import pytest

from angen_tools.common.typography import straightened


@pytest.mark.parametrize('pasted, meant', [
    (['set', '\u201cbathroom1\u201d', '\u201dopen\u201d'], ['set', 'bathroom1', 'open']),
    (['set', 'door', 'bathroom1', '\u22121.2'], ['set', 'door', 'bathroom1', '-1.2']),
    (['--pose', '\u201c\u22129.37', '6.5', '0.1\u201d'], ['--pose', '-9.37 6.5 0.1']),
    (['\u2013pose', '1 2 0'], ['--pose', '1 2 0']),
    (['\u2212\u2212kind', 'door', '\u2212o', 'x'], ['--kind', 'door', '-o', 'x']),
    (['--set', 'range/min=\u22121'], ['--set', 'range/min=-1']),
])
def test_it_is_read_as_meant(pasted: list[str], meant: list[str]) -> None:
    assert straightened(pasted) == meant


@pytest.mark.parametrize('word', ['a\u2013b', '-1', '', '"x"', '\u201cx', 'K\u00fcche',
                                  'a=b\u2212c', '\u201c'])
def test_other_words_stay(word: str) -> None:
    assert straightened([word]) == [word]

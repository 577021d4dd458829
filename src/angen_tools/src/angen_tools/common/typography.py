"""Words of a command that were pasted from a PDF: curly quotes, minus signs and dashes."""
import re
from typing import Iterable, Iterator

PLAIN = str.maketrans({**dict.fromkeys('\u2212\u2013\u2014\u2010\u2011\u2012\uff0d', '-'),
                       **dict.fromkeys('\u201c\u201d\u201e\u201f\u2033\u00ab\u00bb', '"'),
                       **dict.fromkeys('\u2018\u2019\u201a\u2032', "'"),
                       **dict.fromkeys('\u00a0\u2007\u2009\u202f', ' ')})
OPTION = re.compile(r'[\u2212\u2013\u2014\u2012]{1,2}(?=[A-Za-z])')
NUMBERS = re.compile(r'[-+\d.eE ]*\d[-+\d.eE ]*')


def straightened(words: Iterable[str]) -> list[str]:
    """The words as a shell would have made them of straight quotes, with ASCII's signs in options
    and numbers.
    """
    return [_plain(word) for word in _joined(words)]


def _joined(words: Iterable[str]) -> Iterator[str]:
    """Words between curly quotes, which a shell splits, as one."""
    open_words: list[str] = []
    for word in words:
        if open_words or _is_curly(word[:1]):
            open_words.append(word)
        else:
            yield word
        if open_words and _is_curly(word[-1:]) and word != open_words[0][:1]:
            yield ' '.join(open_words)[1:-1]
            open_words = []
    yield from open_words  # not closed


def _is_curly(character: str) -> bool:
    return character != '"' and character.translate(PLAIN) == '"'


def _plain(word: str) -> str:
    option = OPTION.match(word)
    if option:
        return ('--' if len(word) > option.end() + 1 else '-') + word[option.end():]
    key, equals, value = word.rpartition('=')
    plain = value.translate(PLAIN)
    return key + equals + plain if NUMBERS.fullmatch(plain) else word

"""YAML files that people write: each error has file, line, and its fix."""
import math
import re
from pathlib import Path
from typing import Any, Callable, Iterable, Sequence

import yaml

from angen_tools.common.clock import UNITS
from angen_tools.common.failure import Failure
from angen_tools.common.nearest import did_you_mean
from angen_tools.common.text_file import read_text, shortened

DEEPEST = 100  # levels of lists in lists: the composer of libyaml calls itself for each
MOST = 1_000_000  # nodes and ends of lists: the composer takes memory for each
SPAN = re.compile(r'(\d+(?:\.\d+)?)(?:-(\d+(?:\.\d+)?))? ?(s|min|h)', re.ASCII)


class Entries(dict[str, Any]):
    """The nodes of a mapping by key."""

    def of(self, key: str, read: Callable[..., Any], otherwise: Any = None, *limits: Any) -> Any:
        """What `read` makes of a node, its key and `limits`; `otherwise` if the key is not there.
        """
        return read(self[key], key, *limits) if key in self else otherwise


class YamlFile:
    """A file's nodes, taken apart; scalars are texts as they are written."""

    def __init__(self, path: Path) -> None:
        self.path = path
        text = read_text(path)
        try:
            beyond = _beyond_limits(text)
            self.root = None if beyond else yaml.compose(text, yaml.CSafeLoader)
        except yaml.YAMLError as short:
            explained = _explained(text, short)
            mark = getattr(explained, 'problem_mark', None)
            line = mark.line + 1 if mark else 1
            raise Failure(f'{path}:{line}: is not YAML: {getattr(explained, "problem", explained)}'
                          ) from None
        if beyond:
            raise Failure(f'{path}:{beyond}: is nested deeper than {DEEPEST} levels, or has more '
                          f'than {MOST} parts')

    def fail(self, node: Any, what: str) -> Failure:
        """The error at a node."""
        return Failure(f'{self.path}:{line_of(node)}: {what}')

    def entries(self, node: Any, what: str, keys: Iterable[str] = (), required: Iterable[str] = ()
                ) -> Entries:
        """A mapping's values by key; with `keys` no others are known."""
        known = list(keys)
        if not isinstance(node, yaml.MappingNode):
            expected = f'have {", ".join(known)}' if known else 'be a mapping'
            raise self.fail(node, f'{what} must {expected}')
        found = Entries()
        for key, value in node.value:
            name = self.text(key, 'a key')
            if known and name not in known:
                raise self.fail(key, f"'{name}' is not known in {what}; "
                                f'{did_you_mean(name, known)}')
            if name in found:
                raise self.fail(key, f"'{name}' is given twice in {what}")
            found[name] = value
        for key in required:
            if key not in found:
                raise self.fail(node, f'{what} has no {key}; it needs {", ".join(required)}')
        return found

    def nodes(self, node: Any, what: str) -> Sequence[Any]:
        """The nodes of a list that is not empty; of anything else the node itself."""
        return self.list(node, what) if is_list(node) else [node]

    def texts(self, node: Any, what: str) -> tuple[str, ...]:
        """One text, or a list of them."""
        return tuple(self.text(each, what) for each in self.nodes(node, what))

    def said(self, node: Any, what: str, read: Callable[[str], Any]) -> Any:
        """What `read` makes of a text; its ValueError says what would be right."""
        try:
            return read(self.text(node, what))
        except ValueError as error:
            raise self.fail(node, f'{what}: {error}') from None

    def list(self, node: Any, what: str) -> list[Any]:
        """The nodes of a list that is not empty."""
        if not isinstance(node, yaml.SequenceNode) or not node.value:
            raise self.fail(node, f'{what} must be a list')
        return list(node.value)

    def text(self, node: Any, what: str) -> str:
        """A text that is not blank."""
        if not isinstance(node, yaml.ScalarNode) or not node.value.strip():
            raise self.fail(node, f'{what} must be a text')
        return str(node.value).strip()

    def choice(self, node: Any, what: str, choices: Iterable[str]) -> str:
        """One of some words."""
        word = self.text(node, what)
        if word not in choices:
            raise self.fail(node, f"{what} is '{shortened(word)}'; {did_you_mean(word, choices)}")
        return word

    def flag(self, node: Any, what: str) -> bool:
        """True or false."""
        return self.choice(node, what, ('true', 'false')) == 'true'

    def span(self, node: Any, what: str) -> tuple[float, float]:
        """Two durations as '10-35 min' or '8-9.5 h', in s."""
        text = self.text(node, what)
        found = SPAN.fullmatch(text)
        if not found or not 0 < float(found[1]) <= float(found[2] or found[1]):
            raise self.fail(node, f"{what} is '{text}', must be two times as 10-35 min or 8-9.5 h")
        unit = UNITS[found[3]]
        return unit * float(found[1]), unit * float(found[2] or found[1])

    def number(self, node: Any, what: str, low: float = -math.inf, high: float = math.inf
               ) -> float:
        """A finite number within bounds."""
        text = self.text(node, what)
        try:
            value = float(text)
        except ValueError:
            raise self.fail(node, f"{what} is '{shortened(text)}', must be a number") from None
        if not (math.isfinite(value) and low <= value <= high):
            raise self.fail(node, f'{what} is {shortened(text)}, must be {low:g} to {high:g}')
        return value


def _explained(text: str, error: yaml.YAMLError) -> yaml.YAMLError:
    """The same error by the parser with the clearest message."""
    try:
        for _ in yaml.parse(text, yaml.SafeLoader):
            pass
    except yaml.YAMLError as better:
        return better
    return error


def _beyond_limits(text: str) -> int:
    """The line at which a document is nested too deeply or has too many parts; 0 if it has not."""
    depth = 0
    for count, event in enumerate(yaml.parse(text, yaml.CSafeLoader)):
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth > DEEPEST or count > MOST:
            return int(event.start_mark.line) + 1
    return 0


def line_of(node: Any) -> int:
    """The line at which a node begins, from 1."""
    return 1 if node is None else int(node.start_mark.line) + 1


def is_text(node: Any) -> bool:
    return isinstance(node, yaml.ScalarNode)


def is_list(node: Any) -> bool:
    return isinstance(node, yaml.SequenceNode)

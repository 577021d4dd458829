#!/usr/bin/env python3
"""Writes angen.pyi, the types of `import angen`, from the signatures of the built module.

    python3 src/angen_sim/py/make_stub.py            in ./angen shell, after a build
    python3 src/angen_sim/py/make_stub.py --check    writes nothing, ends with 1 if the file differs
"""
import inspect
import re
import sys
import textwrap
from pathlib import Path
from typing import Any

import angen

STUB = Path(__file__).with_name('angen.pyi')
HEAD = '''# src/angen_sim/py/make_stub.py writes this file. Its text is in the C++ sources.
import typing
from collections.abc import Mapping, Sequence

import numpy
import numpy.typing

__version__: str
'''
ARRAY = re.compile(r'numpy\.ndarray\[numpy\.(\w+)(?:\[[^]]*\])?(?:, flags\.\w+)*\]')
ALWAYS = [('angen::', ''), ('angen.', ''), ('Dict[', 'dict['), ('List[', 'list['),
          ('Tuple[', 'tuple['), ('Optional[', 'typing.Optional['), ('Union[', 'typing.Union[')]
# What a function takes is wider than what it returns.
TAKEN = [('dict[', 'Mapping['), ('list[', 'Sequence['), ('tuple[', 'tuple[')]
BARE = {'dict': 'dict[str, typing.Any]', 'list': 'list[typing.Any]', 'object': 'typing.Any',
        'tuple': 'tuple[typing.Any, ...]'}


def type_of(text: str, taken: bool) -> str:
    """A type as Python writes it, of one as pybind11 does."""
    text = ARRAY.sub('numpy.typing.ArrayLike' if taken else r'numpy.typing.NDArray[numpy.\1]', text)
    for old, new in ALWAYS + (TAKEN if taken else []):
        text = re.sub(rf'(?<![\w.]){re.escape(old)}', new, text)
    return BARE.get(text, text)


def split(parameters: str) -> list[str]:
    """The parameters of a signature: commas inside of brackets separate none."""
    parts, depth = [''], 0
    for letter in parameters:
        depth += (letter in '[(') - (letter in '])')
        if letter == ',' and depth == 0:
            parts.append('')
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def parameter(text: str) -> str:
    name, colon, rest = text.partition(': ')
    kind, equals, default = rest.partition(' = ')
    if name == 'self' or not colon:
        return f'{name}: object' if name in ('*args', '**kwargs') else name
    default = re.sub(r'(?<![\w.])inf\b', "float('inf')", default)
    return f'{name}: {type_of(kind, True)}' + (equals and f' = {default}')


def function(name: str, doc: str, decorators: str = '') -> str:
    """One in C++, of the first line of its doc."""
    found = re.match(rf'{name}\((.*)\) -> (.*)', doc)
    if not found:
        raise SystemExit(f'make_stub: {name} has no signature: {doc!r}')
    parameters = ', '.join(parameter(each) for each in split(found[1]))
    return (f'{decorators}def {name}({parameters}) -> {type_of(found[2], False)}:\n'
            + body(doc.partition('\n')[2]))


def body(doc: str) -> str:
    """A doc and nothing else, as the inner of a function."""
    text = inspect.cleandoc(doc)
    if not text:
        return '    ...\n'
    lines = textwrap.wrap(' '.join(text.split()), 90)
    return textwrap.indent('"""' + '\n'.join(lines) + '"""', '    ') + '\n'


def member(name: str, value: Any) -> str:
    """An entry of a class; empty for what needs no type."""
    if isinstance(value, property):
        found = re.match(r'\(\w+: [\w.:]+\) -> (.*)', value.fget.__doc__ or '')
        kind = type_of(found[1], False) if found else 'typing.Any'
        return f'@property\ndef {name}(self) -> {kind}:\n' + body(value.__doc__ or '')
    static = isinstance(value, staticmethod)
    inner = value.__func__ if isinstance(value, staticmethod) else value
    decorators = '@staticmethod\n' if static else ''
    if inspect.isfunction(inner):  # in Python
        return f'{decorators}def {name}{python_signature(inner)}:\n    ...\n'
    if name in ('__getstate__', '__setstate__') or name.startswith('__') and not callable(inner):
        return ''
    if callable(inner) and inner.__doc__ and ' -> ' in inner.__doc__:
        return function(name, inner.__doc__, decorators)
    if isinstance(value, int):
        return f'{name}: int\n'
    return ''


def python_signature(inner: Any) -> str:
    found = str(inspect.signature(inner)).replace('angen.', '')
    return re.sub(r"'([^']*)'", r'\1', found)


def class_of(name: str, made: type) -> str:
    """A class with its members, in the order of the bindings."""
    base = next((f'({each.__name__})' for each in made.__bases__
                 if each.__module__ == 'builtins' and issubclass(each, Exception)), '')
    declared = getattr(made, '__annotations__', {})
    members = [f'{key}: {getattr(kind, "__name__", kind)}\n' for key, kind in declared.items()]
    members += [member(key, value) for key, value in vars(made).items()]
    doc = body(made.__doc__ or '').replace('    ...\n', '')
    inside = textwrap.indent('\n'.join(each for each in members if each), '    ')
    inner = '\n'.join(part for part in (doc, inside) if part)
    return f'class {name}{base}:\n' + (inner or '    ...\n')


def text() -> str:
    """The whole file."""
    parts = [HEAD]
    for name, value in vars(angen).items():
        if isinstance(value, type) and value.__module__ == 'angen':
            parts.append(class_of(name, value))
        elif inspect.isbuiltin(value):
            parts.append(function(name, value.__doc__ or ''))
    return '\n\n'.join(parts)


def main() -> None:
    made = text()
    same = STUB.exists() and STUB.read_text() == made
    if sys.argv[1:] == ['--check']:
        sys.exit(0 if same else f'{STUB}: is not as the module; run python3 {__file__}')
    if not same:
        STUB.write_text(made)
        print(STUB)


if __name__ == '__main__':
    main()

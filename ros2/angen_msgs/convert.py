"""convert.py FROM TO: writes messages and services of ROS 1 in the words of ROS 2.

Two words differ, time and duration. Prints the written files, relative to TO, as a list of CMake.
"""
from __future__ import annotations

import re
import sys
from pathlib import Path

WORDS = {'time': 'builtin_interfaces/Time', 'duration': 'builtin_interfaces/Duration'}
FIELD = re.compile(r'^(time|duration)(?=[ \[])', re.MULTILINE)


def converted(text: str) -> str:
    return FIELD.sub(lambda word: WORDS[word[1]], text)


def convert(source: Path, target: Path) -> list[str]:
    """The written files; those of `source` are in msg and srv."""
    names = []
    for file in sorted([*source.glob('msg/*.msg'), *source.glob('srv/*.srv')]):
        name = file.relative_to(source)
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        (target / name).write_text(converted(file.read_text(encoding='utf-8')), encoding='utf-8')
        names.append(str(name))
    return names


if __name__ == '__main__':
    print(';'.join(convert(Path(sys.argv[1]), Path(sys.argv[2]))), end='')

"""The arguments of a launch file, NAME:=VALUE: roslaunch ignores names that it does not know."""
import math
import os
import sys
from difflib import get_close_matches
from pathlib import Path
from typing import Callable, NoReturn
from xml.etree import ElementTree

from angen_tools.common.failure import Failure, WrongWords, code_of
from angen_tools.common.nearest import nearest
from angen_tools.common.port import port, require_free
from angen_tools.common.verbs import comma_hint

ALIKE = 0.8  # likeness of the names of a missing file and the one that was meant
LEAST = {'rate': 0, 'states_rate': 0, 'seed': 0}
LARGEST = 2**31 - 1  # largest whole number as a parameter of ROS
BOOLEANS = ('true', 'false')
INPUTS = {'world': 'one that is there is world:=worlds/empty.world',
          'replay': 'give a log that record:= wrote'}


def kinds(launch: Path) -> dict[str, str]:
    """The arguments of a launch file, each with bool, int, double or str.

    That is the type of the <param> which has its value; true or false as default are of bool.
    """
    root = ElementTree.parse(launch).getroot()
    found = {arg.get('name', ''): 'bool' if arg.get('default') in BOOLEANS else 'str'
             for arg in root.iter('arg') if arg.get('value') is None}
    for name in found:
        for param in root.iter('param'):
            if param.get('value') == f'$(arg {name})':
                found[name] = param.get('type', 'str')
    return found


def check_page(launch: Path, words: list[str]) -> None:
    """Failure if the page that the words start cannot be served."""
    given = {arg.get('name', ''): arg.get('default', '')
             for arg in ElementTree.parse(launch).getroot().iter('arg')}
    given |= {name: value for name, _, value in (word.partition(':=') for word in words)}
    if given.get('web', '').lower() in ('true', '1'):
        require_free(given['host'], int(given['port']))


def check_arguments(launch: Path, words: list[str]) -> None:
    """Failure if a word is not an option of roslaunch, nor NAME:=VALUE with a name and a value
    that the launch file has."""
    known = kinds(launch)
    for word in words:
        if not word.startswith('--'):
            _check(word, known)


def _check(word: str, known: dict[str, str]) -> None:
    name, separator, value = word.partition(':=')
    if not separator:
        name, separator, value = word.partition('=')
        file = f'world:={word}' if os.path.exists(word) else ''
        meant = f'{name}:={value}' if separator else file
        raise WrongWords(f'{word}: not NAME:=VALUE'
                         + (f'; did you mean {meant}?' if meant else ''))
    if name not in known:
        likely = nearest(name, known)[0]
        raise WrongWords(f'{word}: not an argument; did you mean {likely}:=? known are '
                         + ' '.join(f'{other}:=' for other in known))
    if not value:
        raise WrongWords(f'{word}: has no value')
    problem = _port(value) if name == 'port' else CHECKS[known[name]](value)
    if problem:
        raise WrongWords(f'{word}: {problem}')
    if name in LEAST and float(value) < LEAST[name]:
        raise WrongWords(f'{word}: must be at least {LEAST[name]}')
    path = Path(value).expanduser()  # a shell leaves the ~ of world:=~/my.world
    if name in INPUTS and path.is_dir():
        raise Failure(f'{word}: is a folder; give a file')
    if name in INPUTS and not path.is_file():
        raise Failure(f'{word}: no such file; ' + (_like(name, path) or INPUTS[name]))


def _like(name: str, missing: Path) -> str:
    """The file beside a missing one whose name differs by a typing error."""
    folder = missing.parent
    names = [path.name for path in folder.iterdir()] if folder.is_dir() else []
    likely = get_close_matches(missing.name, names, 1, ALIKE)
    return f'did you mean {name}:={folder / likely[0]}?' if likely else ''


def _boolean(value: str) -> str:
    if value.lower() in (*BOOLEANS, '0', '1'):
        return ''
    return f'neither true nor false; did you mean {nearest(value, BOOLEANS)[0]}?'


def _port(value: str) -> str:
    try:
        port(value)
    except ValueError:
        return 'not a port; give 1024 to 65535'
    return ''


def _number(convert: Callable[[str], float], what: str) -> Callable[[str], str]:
    def check(value: str) -> str:
        try:
            found = convert(value)
        except (ValueError, OverflowError):
            return f'not {what}{comma_hint(value)}'
        if isinstance(found, int) and found > LARGEST:
            return f'must be at most {LARGEST}'
        return '' if math.isfinite(found) else f'not {what}'
    return check


CHECKS: dict[str, Callable[[str], str]] = {
    'bool': _boolean, 'int': _number(int, 'a whole number'), 'double': _number(float, 'a number'),
    'str': lambda value: ''}


def check_roslaunch(launch: str) -> None:
    """Called by the launch file of that path while roslaunch reads it, for the words given to
    roslaunch itself; another launch file that includes it has its own."""
    words = sys.argv[1:]
    if Path(sys.argv[0]).name == 'roslaunch' and any(
            Path(word).name == Path(launch).name for word in words):
        try:
            check_arguments(Path(launch), [word for word in words if ':=' in word])
        except Failure as failure:
            end(failure)


def end(failure: Failure) -> NoReturn:
    """Ends the program: roslaunch would print the expression of its file around an exception."""
    print(f'angen: {failure}', file=sys.stderr)
    sys.exit(code_of(failure))


def require_packages(names: str, page: str) -> None:
    """Ends roslaunch if it is to start nodes of ROS packages that are missing; `page` says how
    to get them."""
    if Path(sys.argv[0]).name != 'roslaunch':
        return
    from rospkg import ResourceNotFound, RosPack
    found, missing = RosPack(), []
    for name in names.split():
        try:
            found.get_path(name)
        except ResourceNotFound:
            missing.append(name)
    if missing:
        end(Failure(f'{" and ".join(missing)} {"are" if len(missing) > 1 else "is"} not '
                    f'installed, or its workspace is not sourced; {page} says how to build it'))


def main() -> None:
    """LAUNCH WORD...: a line on stderr where a word is wrong; exit code 2, or 1 without a file."""
    try:
        check_arguments(Path(sys.argv[1]), sys.argv[2:])
    except Failure as failure:
        end(failure)


if __name__ == '__main__':
    main()

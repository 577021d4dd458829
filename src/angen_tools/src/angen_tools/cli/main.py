"""The angen command: its words, and how it ends."""
import argparse
import logging
import os
import re
import signal
import sys
from typing import Any, NoReturn, Sequence

from angen_tools.cli import applications, live, offline, pid
from angen_tools.cli.parser import Parser, command
from angen_tools.common.failure import Failure, code_of
from angen_tools.common.installed import launch_file
from angen_tools.common.typography import straightened

STOPPED = 130  # a shell's exit code of a command that Ctrl-C ended
OPTIONS = ('-h', '--help', '--version', '--json')  # before a command; the last is said to follow it
ROS = ('angen_msgs', 'genpy', 'rosgraph', 'roslib', 'rospkg', 'rospy')  # modules
PIPE_CLOSED = 141  # and of one whose reader ended


def run_completion(args: argparse.Namespace) -> int:
    import argcomplete
    print(argcomplete.shellcode(['angen'], shell=args.shell))
    return 0


class PrintVersion(argparse.Action):
    """Prints the version, which `import angen` has; that import is too slow for every command."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> NoReturn:
        import angen
        print(f'angen {angen.__version__}')
        parser.exit()


def make_parser() -> Parser:
    """All that the command understands."""
    parser = Parser(
        prog='angen', description='Commands of the running simulator, and of files. Each has '
        '--help; all but completion have --json.',
        epilog='example:\n  angen list --kind door\n  angen check worlds/angen.world\n'
        '  angen help set door',
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--version', action=PrintVersion, nargs=0, help='prints the version')
    parser.add_argument('--ns', metavar='NAMESPACE', help='of the simulator, where several share a '
                        'ROS master: --ns house1 list')
    parser.kinds = commands = parser.add_subparsers(metavar='COMMAND', required=True)
    for add in (live.add_spawn, live.add_delete, live.add_list, offline.add_plugins, live.add_set,
                live.add_save, live.add_watch, live.add_top, live.add_drive, offline.add_checks,
                offline.add_run, offline.add_world, pid.add_pid, offline.add_replay,
                applications.add_commands):
        add(commands)
    completion = command(commands, 'completion', run_completion,
                         'prints the script by which a shell completes angen',
                         'completion bash >> ~/.bash_completion')
    completion.add_argument('shell', choices=['bash'])
    return parser


def run(arguments: Sequence[str]) -> int:
    """Runs the command; returns its exit code. argparse exits by itself, with 2 or 0."""
    parser = make_parser()
    if '_ARGCOMPLETE' in os.environ:
        import argcomplete
        argcomplete.autocomplete(parser)
    if arguments and arguments[0] == '--ns':
        if not re.fullmatch(r'/?[A-Za-z]\w*(/\w+)*', (*arguments, '')[1], re.ASCII):
            parser.error('--ns is followed by a ROS namespace: angen --ns house1 list')
        os.environ['ROS_NAMESPACE'] = arguments[1]  # before rospy is imported
        arguments = arguments[2:]
    for word in arguments:
        if _has_other_bytes(word):
            parser.error(f'{ascii(word)} is not text in UTF-8')
    first = arguments[0] if arguments else ''
    if first.startswith('-') and not any(option.startswith(first) for option in OPTIONS):
        parser.error(f"'{first}' is not an option of angen, which has --help, --ns and --version; "
                     'those of a command follow it')
    if arguments and arguments[0] == 'help':
        arguments = [*arguments[1:], '--help']
    if arguments and arguments[0] == 'run' and not {'--fast', '-h', '--help'} & set(arguments):
        _run_building(arguments[1:])
    if arguments and arguments[0] == 'run' and any(':=' in word for word in arguments):
        parser.error('NAME:=VALUE is for ./angen run, which runs ROS; angen run takes --fast')
    if len(arguments) > 1 and arguments[0] == '--json':
        parser.error(f'--json follows the command: angen {arguments[1]} --json')
    meant = live.right_order(arguments, parser.kinds.choices)
    if meant:
        given = ' '.join(arguments[:4 if arguments[0] == 'set' else 3])
        parser.error(f"'{given}' is not understood; did you mean {meant}?")
    try:
        args = parser.parse_args(straightened(arguments))
        if getattr(args, 'allow_paths', False):  # also for the processes that this one starts
            os.environ['ANGEN_ALLOW_PATHS'] = 'true'
        code: int = args.run(args)
        sys.stdout.flush()
        return code
    except Failure as failure:
        print(f'angen: {failure}', file=sys.stderr)
        return code_of(failure)
    except ModuleNotFoundError as error:
        if error.name not in ROS:
            raise
        print(f'angen: {arguments[0]} needs ROS (the Python module {error.name}), which a wheel of '
              'Angen does not have; install the Debian packages of Angen, or use a checkout',
              file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return STOPPED
    except BrokenPipeError:
        return PIPE_CLOSED
    except OSError as error:
        what = f'{error.filename}: cannot be written' if error.filename else 'cannot write'
        print(f'angen: {what}: {error.strerror}', file=sys.stderr)
        return 1
    except Exception as error:
        angen = sys.modules.get('angen')
        if angen is None or not isinstance(error, angen.Error):
            raise
        print(f'angen: {error}', file=sys.stderr)  # a world cannot be loaded
        return 1


def _run_building(words: Sequence[str]) -> None:
    """Starts the building in ROS and ends with it, if Debian's package is installed."""
    launch = launch_file()
    if launch is not None:
        from angen_tools.entry.run import main as run_building
        sys.argv[1:] = [str(launch), *words]
        run_building()


def _has_other_bytes(word: str) -> bool:
    """Whether bytes of a command line could not be decoded: files of such names are not served."""
    return any('\ud800' <= letter <= '\udfff' for letter in word)


def stop(number: int, _: Any) -> NoReturn:
    """At a signal: started processes are ended on the way out."""
    sys.exit(128 + number)  # a shell's exit code of a command that a signal ended


def open_closed_streams() -> None:
    """Standard streams that the caller has closed become /dev/null."""
    for number, name in enumerate(('stdin', 'stdout', 'stderr')):
        if getattr(sys, name) is None:
            stream = open(os.devnull, 'w' if number else 'r', encoding='utf-8')
            os.set_inheritable(stream.fileno(), True)
            setattr(sys, name, stream)


def leave() -> None:
    """Takes this process off the ROS master, if it had become a node."""
    rospy = sys.modules.get('rospy')
    if rospy is not None and rospy.core.is_initialized():
        rospy.signal_shutdown('done')


def main() -> None:
    """The program. Ends at once: threads that still wait for an answer are abandoned."""
    open_closed_streams()
    logging.raiseExceptions = False  # a log that cannot be written, of rospy's, is not reported
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, stop)
    if signal.getsignal(signal.SIGINT) == signal.SIG_DFL:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        code = run(sys.argv[1:])
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 1
    try:
        leave()
    except KeyboardInterrupt:
        code = STOPPED
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            pass
    os._exit(code)

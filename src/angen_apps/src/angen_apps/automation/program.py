"""A program on MQTT that is tested: it gets a broker of its own with the topics of angen mqtt, and
simulated time waits for its answers."""
from __future__ import annotations

import math
import os
import shlex
import shutil
import signal
import socket
import subprocess
import tempfile
import threading
import time
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import IO, TYPE_CHECKING, Callable, Sequence

from angen_apps.automation.automations import Where
from angen_apps.automation.scenario import Program
from angen_apps.mqtt.broker import Access, Broker, Log, Message
from angen_apps.mqtt.discovery import Discovery
from angen_apps.mqtt.styles import Plain
from angen_apps.mqtt.things import Thing
from angen_tools.common.catalog import angen_module
from angen_tools.common.failure import Failure, WrongWords
from angen_tools.common.files import write_text
from angen_tools.common.port import free_port
from angen_tools.common.wait import wait

if TYPE_CHECKING:
    from angen_apps.automation.bench import Bench, Change

BASE = 'angen'
NOTIFY = f'{BASE}/notify'  # messages to people
TICK = 1.0      # s of simulated time between two messages of it
ANSWER = 10.0   # s of wall time in which a program answers
START = 60.0    # the same, for its first answer
AGAIN = 0.3     # the same, until it is asked again
TAKE = 50       # messages at a time


class Silent(Log):
    """The end of a connection is told as the reason of the cut."""

    def say(self, text: str, again: bool = False) -> None:
        pass


class MqttProgram:
    """See bench.Subject. After all that one moment changes, a barrier is published; it has been
    read by the program when that has answered, or when nothing has come for a while."""

    def __init__(self, program: Program, where: Where) -> None:
        self._program, self._where = program, where
        self.needs: set[str] = set()
        self._style = Plain(BASE)
        self._wakes = threading.Event()
        self._sent: dict[str, str] = {}  # states by topic
        self._barriers = 0
        self._next = 0.0  # when simulated time is published again
        self._ends = ExitStack()

    @property
    def due(self) -> float:
        return self._next

    def begin(self, bench: Bench) -> None:
        self._bench = bench
        folder = Path(self._ends.enter_context(tempfile.TemporaryDirectory(prefix='angen_')))
        port = self._start_broker(folder)
        self._broker = Broker(Access('127.0.0.1', port), Silent(), self._wakes.set)
        self._broker.start((f'{BASE}/bridge/state', self._style.offline))
        self._ends.callback(self._broker.stop)
        self._until(lambda: self._broker.connected, 'there is no connection to the broker')
        self._broker.subscribe([*self._style.filters, self._topic('barrier'),
                                self._topic('barrier/done'), NOTIFY])
        self._publish_all()
        self._log = folder / 'program.log'
        text = self._program.command
        for word, value in (('host', '127.0.0.1'), ('port', str(port)),
                            ('folder', str(self._where.path.parent)),
                            ('start', bench.house.start.isoformat())):
            text = text.replace(f'{{{word}}}', value)
        with self._log.open('wb') as log:
            try:
                self._process = self._start(shlex.split(text), log)
            except OSError as error:
                raise WrongWords(f'{self._where}: {text}: {error.strerror}') from None
        self._next = bench.now
        self._barrier(START)
        self._began = time.monotonic() - bench.now / self._program.rate

    def _start(self, words: Sequence[str], out: IO[bytes] | int) -> subprocess.Popen[bytes]:
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=out, stderr=out,
                                   start_new_session=True)
        self._ends.callback(_stop, process)
        return process

    def _start_broker(self, folder: Path) -> int:
        found = shutil.which('mosquitto', path=os.environ.get('PATH', '') + ':/usr/sbin')
        if found is None:
            raise WrongWords(f'{self._where}: a program needs the broker mosquitto; '
                             'sudo apt-get install mosquitto')
        port, config = free_port(), folder / 'mosquitto.conf'
        write_text(config, f'listener {port} 127.0.0.1\nallow_anonymous true\n'
                   'set_tcp_nodelay true\n')
        self._start([found, '-c', str(config)], subprocess.DEVNULL)

        def answers() -> bool:
            with suppress(OSError):
                socket.create_connection(('127.0.0.1', port), 1.0).close()
                return True
            return False

        self._until(answers, 'the broker does not answer')
        return port

    def _topic(self, name: str) -> str:
        return f'{BASE}/bridge/{name}'

    def _publish_all(self) -> None:
        discovery = Discovery(self._style, False, angen_module().__version__)
        for thing in self._bench.entities.things.values():
            for topic, payload in discovery.messages(thing).items():
                self._broker.publish(topic, payload)
            self._send_states(thing)
        self._broker.publish(self._topic('state'), self._style.online)

    def _send_states(self, thing: Thing) -> None:
        """Those that have changed."""
        for topic, payload in self._style.states(thing, thing.shown).items():
            if self._sent.get(topic) != payload:
                self._sent[topic] = payload
                self._broker.publish(topic, payload)

    def observe(self, changes: Sequence[Change], now: float) -> None:
        self._send_time(now)
        for key in dict.fromkeys(entity.thing.key for entity, _, _ in changes):
            self._send_states(self._bench.entities.things[key])
        self._barrier(ANSWER)

    def advance(self, now: float) -> bool:
        if now < self._next - 1e-6:
            return False
        self._next = (math.floor(now / TICK + 1e-6) + 1) * TICK
        self._send_time(now)
        self._barrier(ANSWER)
        return True

    def _send_time(self, now: float) -> None:
        time.sleep(max(0.0, self._began + now / self._program.rate - time.monotonic()))
        self._broker.publish(f'{BASE}/simulation/simulation/time', f'{now:.3f}')

    def _barrier(self, limit: float) -> None:
        """Returns when the program has read all, and its commands are executed."""
        self._barriers += 1
        number = str(self._barriers)
        asked = -math.inf
        waits = self._topic('barrier' if self._program.answers == 'quiet' else 'barrier/done')
        end, heard, came = time.monotonic() + limit, math.inf, False
        while not came or time.monotonic() < heard + self._quiet:
            left = (heard + self._quiet if came else end) - time.monotonic()
            if not came and time.monotonic() > asked + AGAIN:  # it was not connected yet
                asked = time.monotonic()
                self._broker.publish(self._topic('barrier'), number, retain=False)
            if not came and left <= 0.0:
                self._fail(f'the program has not answered for {limit:g} s')
            self._wakes.wait(min(max(left, 0.0), 0.1))
            self._wakes.clear()
            while messages := self._broker.take(TAKE):
                for message in messages:
                    heard = time.monotonic()
                    if message.topic == waits:
                        came |= self._is_answer(message.payload, number)
                    elif message.topic == NOTIFY:
                        self._note(message.payload.decode(errors='replace'))
                    elif message.topic.endswith('/set') and not message.retained:
                        self._execute(message)
            self._check()

    def _is_answer(self, payload: bytes, number: str) -> bool:
        """Whether a message answers a barrier; it may say after it when the program needs the
        next message of the time."""
        answered, _, due = payload.decode(errors='replace').partition(' ')
        if answered != number:
            return False
        with suppress(ValueError):  # none is said
            if float(due) > self._bench.now:
                self._next = float(due)
        return True

    @property
    def _quiet(self) -> float:
        return self._program.quiet if self._program.answers == 'quiet' else 0.0

    def _note(self, what: str, entity: str = '', error: str = '') -> None:
        from angen_apps.automation.bench import Done
        self._bench.done.append(Done(self._bench.now, 'program', what, entity, error))

    def _execute(self, message: Message) -> None:
        entities = self._bench.entities
        try:
            payload = message.payload.decode()
            for thing, part, text in self._style.find(message.topic, payload,
                                                      entities.things.values()):
                entity = next(one for one in entities.all.values()
                              if one.thing is thing and part in one.component.parts)
                error = ''
                try:
                    entities.command(entity, part, text)
                except Failure as why:
                    error = str(why)
                self._note(f'{part.key} {text}', entity.id, error)
        except ValueError as why:
            self._note('rejected', message.topic, str(why))

    def _check(self) -> None:
        """Whether all run."""
        if not self._broker.connected:
            self._fail('the broker has closed the connection')
        if self._process.poll() is not None:
            said = self._log.read_text(errors='replace').strip().splitlines()
            self._fail(f'the program has ended with {self._process.returncode}'
                       + (f': {said[-1]}' if said else ''))

    def _fail(self, why: str) -> None:
        from angen_apps.automation.bench import Cut
        raise Cut(f'{self._where}: {why}')

    def _until(self, holds: Callable[[], bool], why: str) -> None:
        try:
            wait(holds, why, START)
        except Failure as late:
            self._fail(str(late))

    def end(self) -> None:
        self._ends.close()


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Ends a process with its children."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGTERM)
    try:
        process.wait(5.0)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()

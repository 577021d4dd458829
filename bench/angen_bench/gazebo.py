"""Gazebo 11 as a peer for benches: gzserver of Debian 11 in a chroot, without ROS."""
import os
import queue
import subprocess
import threading
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Mapping, Self

from angen_tools.common.failure import Failure
from angen_tools.common.port import free_port
from angen_tools.common.watchdog import watchdog
from angen_tools.live.sandbox import end
from angen_tools.world.models import worlds_models

STEPS = 1000  # a second of wall time, of 1 ms: real time
START_LIMIT = 600.0  # s of wall time; 500 models take 20 s where nothing else runs
SAMPLE_LIMIT = 60.0
ANSWER_LIMIT = 10.0  # s of wall time; after deletions Gazebo sometimes never answers
# Gazebo queries no model database on the net. Its plug-ins' places and the like come from setup.sh.
LAUNCH = '''
mount -t proc proc "$1/proc" && mount --bind "$2" "$1/mnt" && mount --bind "$3" "$1/media" &&
exec chroot "$1" /usr/bin/env -i HOME=/root PATH=/usr/bin:/bin DISPLAY="$DISPLAY" \\
  ANGEN_STARTED_BY="$ANGEN_STARTED_BY" \\
  LIBGL_ALWAYS_SOFTWARE=1 sh -c '. /usr/share/gazebo/setup.sh
  export GAZEBO_MASTER_URI=http://127.0.0.1:$1 GAZEBO_MODEL_DATABASE_URI= GAZEBO_MODEL_PATH=/media
  exec gzserver -s /opt/libangen_probe.so "/mnt/$2"' gzserver "$4" "$5"
'''


def default_chroot() -> Path:
    """The folder of the chroot."""
    cache = os.environ.get('XDG_CACHE_HOME') or Path.home() / '.cache'
    return Path(cache) / 'angen/gazebo11'


def script() -> Path:
    """The program that makes the chroot."""
    return Path(__file__).resolve().parent / 'chroot/make_chroot'


def prepare(root: Path) -> None:
    """Makes the chroot where it is missing; Failure says why it cannot be made."""
    program = script()
    with watchdog():
        made = subprocess.run([str(program), str(root)], stdout=subprocess.PIPE, text=True,
                              check=False)
    if made.returncode != 0:
        raise Failure((made.stdout.splitlines() or [f'{program} failed'])[-1])


@dataclass(frozen=True)
class Tick:
    """A sample of the probe, and the process's figures at that time: s of wall, simulated and
    processor time (all threads), bytes of memory."""
    wall: float
    sim: float
    readings: int
    sensors: int
    processor: float
    rss: int


def parse(line: str) -> tuple[str, list[float]] | None:
    """The word and the numbers of a line of the probe; None of any other line."""
    words = line.split()
    if len(words) < 3 or words[0] != 'probe':
        return None
    try:
        return words[1], [float(word) for word in words[2:]]
    except ValueError:
        return None


class Gazebo:
    """A gzserver with a world of `folder`. A context: its end ends it."""

    def __init__(self, root: Path, folder: Path, world: str, environment: Mapping[str, str]
                 ) -> None:
        import psutil
        self._answers: dict[str, queue.SimpleQueue[float]] = {
            word: queue.SimpleQueue() for word in ('first', 'reading', 'gone')}
        self._last: Tick | None = None
        self._log = folder / 'gazebo.log'
        words = ['unshare', '--mount', 'sh', '-c', LAUNCH, 'sh', str(root), str(folder),
                 str(worlds_models().resolve()), str(free_port()), world]
        settings = {'DISPLAY': '', **environment}
        launched = time.monotonic()
        with self._log.open('wb') as log:
            self._process = subprocess.Popen(
                words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log, env=settings,
                text=True, bufsize=1, start_new_session=True)
        try:
            self._watched = psutil.Process(self._process.pid)
            threading.Thread(target=self._listen, daemon=True).start()
            self.start_s = self._answer('first', START_LIMIT) - launched
        except BaseException:
            end(self._process)
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()  # it has no state to save, and is slow to end
        self._process.wait()

    def _listen(self) -> None:
        import psutil
        for line in self._process.stdout or ():
            parsed = parse(line)
            if parsed is None:
                continue
            word, numbers = parsed
            if word in self._answers:
                self._answers[word].put(numbers[0])
            elif word == 'sample' and len(numbers) == 4:
                try:
                    times = self._watched.cpu_times()
                    rss = self._watched.memory_info().rss
                except psutil.NoSuchProcess:
                    return
                self._last = Tick(numbers[0], numbers[1], int(numbers[2]), int(numbers[3]),
                                  times.user + times.system, rss)

    def _answer(self, word: str, limit: float) -> float:
        """When the probe reported it."""
        stop = time.monotonic() + limit
        while time.monotonic() < stop:
            try:
                return self._answers[word].get(timeout=0.1)
            except queue.Empty:
                self._check()
        raise Failure(f'Gazebo has not reported "{word}" within {limit:g} s')

    def _check(self) -> None:
        if self._process.poll() is not None:
            lines = self._log.read_text(errors='replace').splitlines()
            raise Failure(f'Gazebo ended: {lines[-1] if lines else "without a message"}')

    def send(self, text: str) -> None:
        """Sends a line to the probe."""
        try:
            print(text, file=self._process.stdin, flush=True)
        except OSError:
            self._check()
            raise Failure('Gazebo does not read its commands') from None

    def sample(self, after: float) -> Tick:
        """The first sample of a time later than `after`; waits for it."""
        stop = max(after, time.monotonic()) + SAMPLE_LIMIT
        while time.monotonic() < stop:
            last = self._last
            if last and last.wall > after:
                return last
            self._check()
            time.sleep(0.01)
        raise Failure('Gazebo has stopped')

    def window(self, warm_up: float, length: float) -> tuple[Tick, Tick]:
        """Two samples as those of bench_measure.Meter."""
        first = self.sample(time.monotonic() + warm_up)
        while first.sim < warm_up:
            first = self.sample(first.wall)
        return first, self.sample(first.wall + length)

    def settle(self, sensors: int) -> None:
        """Returns when it has made that many sensors."""
        stop = time.monotonic() + START_LIMIT
        while self.sample(time.monotonic()).sensors < sensors:
            if time.monotonic() > stop:
                raise Failure(f'Gazebo has not made its {sensors} sensors')

    def spawn(self, name: str, file: str) -> float:
        """s from the order to the first reading of the sensor of the model in `file`."""
        ordered = time.monotonic()
        self.send(f'spawn {name} /mnt/{file}')
        return self._answer('reading', ANSWER_LIMIT) - ordered

    def delete(self, name: str) -> float:
        """s from the order until the model is deleted."""
        ordered = time.monotonic()
        self.send(f'delete {name}')
        return self._answer('gone', ANSWER_LIMIT) - ordered

"""A simulator of the home that is drawn, on a master of its own, and its page."""
import json
import shutil
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path
from subprocess import Popen, TimeoutExpired

from angen_apps.residents.profiles import is_file
from angen_tools.common.failure import Failure
from angen_tools.common.files import write_text
from angen_tools.common.port import free_port
from angen_tools.common.wait import wait
from angen_tools.live.sandbox import Sandbox, end

PROGRAM = 'from angen_tools.cli.main import main; main()'
RESIDENTS = 'from angen_apps.residents.node import main; main()'
STARTS = 7  # hour of the day
GENERATES = 600.0  # s of wall time, at most
LIMIT = 60.0  # s until the page is served


class Simulation:
    """Starts at the first run; later ones have another node with the same page."""

    def __init__(self, host: str) -> None:
        self._host = host
        self._all = ExitStack()
        self._sandbox: Sandbox | None = None
        self._running: list[Popen[bytes]] = []  # the residents and the node
        self._page: Popen[bytes] | None = None
        self._player: Popen[bytes] | None = None

    def run(self, world: Path, household: dict[str, str]) -> str:
        """The address of the page of the world, which runs. `household`: profiles of residents, by
        the names of people in the world whose places they take."""
        sandbox, page = self.prepare()
        while self._running:
            end(self._running.pop())
        self._running = [sandbox.node(world.absolute(), 1.0)]
        if household:
            self._running.append(self._settle(sandbox, world.absolute(), household))
        return self._address(page, sandbox.folder / 'web.log')

    def prepare(self) -> tuple[Sandbox, Popen[bytes]]:
        """The master and the page, which take seconds to start and serve all runs."""
        sandbox = self._started()
        if self._page is None or self._page.poll() is not None:
            self._page = self._serve(sandbox, 'web')
        return sandbox, self._page

    def day(self, world: Path, household: dict[str, str]) -> str:
        """The address of a player of a day of these residents, which is generated."""
        if not household:
            raise Failure('nobody lives here: put a person, and choose in its card as what it '
                          'lives')
        sandbox = self._started()
        folder = sandbox.folder / 'day'
        if self._player is not None:
            end(self._player)
        shutil.rmtree(folder, ignore_errors=True)
        who = []
        for name, profile in household.items():  # their paths may have a comma
            who.append(profile)
            if is_file(profile):
                who[-1] = str(shutil.copy(profile, sandbox.folder / f'{name}.yaml'))
        made = sandbox.start([
            sys.executable, '-c', PROGRAM, 'generate', str(world.absolute()), '--days', '1',
            '--residents', ','.join(who), '--out', str(folder)], 'generate')
        try:
            failed = made.wait(GENERATES)
        except TimeoutExpired:
            end(made)
            raise Failure(f'a day takes longer than {GENERATES / 60:g} minutes; use angen '
                          f'generate {world.name}') from None
        if failed:
            log = (sandbox.folder / 'generate.log').read_text(errors='replace').strip()
            raise Failure(log.splitlines()[-1] if log else 'angen generate ended')
        self._player = self._serve(sandbox, 'player', '--replay', str(folder),
                                   str(world.absolute()))
        return self._address(self._player, sandbox.folder / 'player.log')

    def _started(self) -> Sandbox:
        if self._sandbox is None:
            folder = self._all.enter_context(tempfile.TemporaryDirectory(prefix='angen_edit_'))
            self._sandbox = self._all.enter_context(Sandbox(Path(folder)))
        return self._sandbox

    def _serve(self, sandbox: Sandbox, name: str, *words: str) -> Popen[bytes]:
        """angen web, with a log of this name."""
        return sandbox.start([sys.executable, '-c', PROGRAM, 'web', *words, '--host', self._host,
                              '--port', str(free_port()), '--json'], name)

    @staticmethod
    def _settle(sandbox: Sandbox, world: Path, household: dict[str, str]) -> Popen[bytes]:
        """Residents instead of people who stand."""
        sandbox.start([sys.executable, '-c', PROGRAM, 'delete', *household], 'delete').wait(LIMIT)
        file = sandbox.folder / 'household.yaml'
        write_text(file, f'starts: {STARTS}\nresidents: {json.dumps(household)}\n')
        return sandbox.start([sys.executable, '-c', RESIDENTS, str(file), str(world)], 'residents')

    @staticmethod
    def _address(page: Popen[bytes], log: Path) -> str:
        def address() -> str:
            if page.poll() is not None:
                raise Failure(f'angen web ended: {log.read_text(errors="replace").strip()}')
            lines = [line for line in log.read_text().splitlines() if line.startswith('{"address"')]
            return str(json.loads(lines[0])['address']) if lines and lines[0][-1] == '}' else ''

        wait(lambda: bool(address()), 'the page is not served', LIMIT)
        return address()

    def close(self) -> None:
        """Ends all that it started."""
        self._all.close()

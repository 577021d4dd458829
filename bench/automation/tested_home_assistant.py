"""Home Assistant as the program of a scenario, with a clock that the bench tells; home_assistant.py
runs it in an environment that has Home Assistant.

    angen automation-test SCENARIO --program \\
      'PYTHON tested_home_assistant.py {folder}/AUTOMATIONS.yaml {port} {start}'

As its own tests do, it replaces the clock: that of timers, which the loop of events has, and that
of dates. With --wall its clock is the wall's; a scenario must have `rate: 1` and `answers: quiet`.
"""
import asyncio
import datetime
import math
import socket
import sys
import tempfile
import time
from pathlib import Path
from time import sleep  # Home Assistant replaces that of the module
from typing import Any, Callable

AHEAD = 300.0  # s before the start, in which Home Assistant itself starts
FEW = 0.001    # s, more than the rounding of a time that is told
REST = 0.0002  # s of wall time between two looks at threads
CALM = 3.0     # s without a new entity: all have been discovered
BARRIER, TIME, NOTIFY = 'angen/bridge/barrier', 'angen/simulation/simulation/time', 'angen/notify'


class Clock(asyncio.SelectorEventLoop):
    """A loop by the wall's clock until `told` has a time."""

    def __init__(self, start: float) -> None:
        self.told = math.nan  # s since the epoch
        super().__init__()
        self._offset = start - AHEAD - super().time()
        self._jobs = 0

    def date(self) -> float:
        return self.time() + self._offset

    def time(self) -> float:
        return super().time() if math.isnan(self.told) else self.told - self._offset

    def run_in_executor(self, *args: Any) -> Any:
        self._jobs += 1
        future = super().run_in_executor(*args)
        future.add_done_callback(self._end)
        return future

    def _end(self, _: Any) -> None:
        self._jobs -= 1

    def due(self) -> float:
        """When the next timer is due, s since the epoch."""
        times = [each._when for each in self._scheduled if not each._cancelled]  # type: ignore
        return min(times, default=math.inf) + self._offset

    async def settle(self, is_busy: Callable[[], bool]) -> None:
        """Returns when nothing is to be done at this time."""
        calm = 0
        while calm < 2:
            await asyncio.sleep(0)
            calm += 1
            if self._ready or self._jobs or self.due() <= self.date() or is_busy():  # type: ignore
                calm = 0
                sleep(REST)


async def serve(clock: Clock, automations: Path, port: int, start: float, by_wall: bool) -> None:
    import yaml
    from homeassistant.components import mqtt  # type: ignore[import]
    from homeassistant.core import callback  # type: ignore[import]
    from homeassistant.setup import async_setup_component  # type: ignore[import]
    from in_home_assistant import started
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        http = int(probe.getsockname()[1])
    hass = await started(tempfile.mkdtemp(prefix='angen_tested_'), port, http)
    count, since = -1, time.monotonic()
    while time.monotonic() < since + CALM:
        await asyncio.sleep(0.1)
        if count != len(hass.states.async_all()):
            count, since = len(hass.states.async_all()), time.monotonic()

    async def notify(call: Any) -> None:
        await mqtt.async_publish(hass, NOTIFY, call.data['message'])

    hass.services.async_register('notify', 'notify', notify)
    operations = hass.data['mqtt'].client._pending_operations

    def is_busy() -> bool:
        return any(not each.is_set() for each in operations.values())

    @callback  # else it is a job of a thread
    def on_time(message: Any) -> None:
        clock.told = start + float(message.payload) + FEW

    async def begin() -> None:
        config = yaml.safe_load(automations.read_text())
        if not await async_setup_component(hass, 'automation', {'automation': config}):
            sys.exit('Home Assistant does not take the automations')

    alone = asyncio.Lock()  # two that settle would wait for each other

    async def on_barrier(message: Any) -> None:
        async with alone:
            if math.isnan(clock.told):
                clock.told = start + FEW
                await begin()
            await clock.settle(is_busy)
        await mqtt.async_publish(hass, f'{BARRIER}/done',
                                 f'{message.payload} {clock.due() - start:.6f}')

    if by_wall:
        await begin()
    else:
        await mqtt.async_subscribe(hass, TIME, on_time)
        await mqtt.async_subscribe(hass, BARRIER, on_barrier)
    await asyncio.Event().wait()


def main() -> None:
    words = [word for word in sys.argv[1:] if word != '--wall']
    start = datetime.datetime.fromisoformat(words[2]).replace(tzinfo=datetime.UTC).timestamp()
    clock, by_wall = Clock(start), '--wall' in sys.argv
    if not by_wall:
        time.time = clock.date
        import homeassistant.util.dt as dates  # type: ignore[import]

        def now(zone: Any = None) -> datetime.datetime:
            return datetime.datetime.fromtimestamp(clock.date(), zone or datetime.UTC)
        dates.now, dates.utcnow = now, now
    clock.run_until_complete(serve(clock, Path(words[0]), int(words[1]), start, by_wall))


if __name__ == '__main__':
    main()

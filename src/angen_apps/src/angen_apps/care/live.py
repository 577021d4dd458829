"""Care rules on the running simulator: publishes warnings."""
import time
from typing import Callable

from angen_apps.care.engine import Change
from angen_apps.care.follower import Follower
from angen_apps.care.messages import WarningPublisher
from angen_apps.care.rules import Rules
from angen_tools.session.live import LAG, Live

ACKNOWLEDGE = 'angen/warnings/acknowledge'


class Watch(Follower):
    """Follows the simulator and publishes its warnings."""

    def __init__(self, rules: Rules, tell: Callable[[Change, float], None]) -> None:
        from std_msgs.msg import String
        self._tell, self._world = tell, Live()
        super().__init__(rules, self._world)
        self._restart()
        self._acknowledged = self._world.subscribe(ACKNOWLEDGE, String)

    def _restart(self) -> None:
        self.begin(max((s.time for s in self._world.summaries().values()), default=0.0))
        self._publisher = WarningPublisher(self._world, self.engine, self.entities)
        self._publisher.publish(self.engine, [])

    def watch(self) -> None:
        """Handles the messages of a moment."""
        time.sleep(LAG)
        if self._world.complete_until < self._time:
            self.check()
            self._restart()
        self._publish(self.follow()[1])
        for message in self._acknowledged.take():
            self._publish(self.engine.acknowledge(message.data.strip()))

    def _publish(self, changes: list[Change]) -> None:
        for change in changes:
            self._tell(change, self.engine.starts)
        if changes:
            self._publisher.publish(self.engine, changes)

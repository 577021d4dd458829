"""Drives of robots to goals that pages order: by move_base where it runs, else by angen go."""
import re
import signal
import subprocess
import sys
import threading
from typing import Any, Sequence

from angen_apps.web.store import Store

GO = [sys.executable, '-c', 'from angen_tools.cli.main import main; main()', 'go']
STEP = re.compile(r'angen: go +(\d+) % *(.*)')
NOTE = re.compile('angen: (?:go: )?')
STOPPED = 130  # the exit code after Ctrl-C
LIMIT = 10.0  # s until a process has stopped its robot
WAITS, DRIVES, ARRIVED = (0,), (1, 6), (3,)  # states in actionlib_msgs/GoalStatus
ENDED = {2: 'stopped', 4: 'gave up', 5: 'rejected the goal', 8: 'stopped'}


class Trips:
    """The part `trips` of the store has by robot: `goal`, a `text`, whether it `drives`, and the
    `share` of the way that is done, if it is known."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._lock = threading.RLock()  # guards these
        self._trips: dict[str, dict[str, Any]] = {}
        self._processes: dict[str, subprocess.Popen[str]] = {}
        self._followed = ''  # the robot that move_base drives
        self._before: set[str] = set()  # goals of move_base before that of the robot
        self._goals: set[str] = set()  # goals of move_base
        self._cancel: Any = None

    def go(self, robot: str, goal: str, words: Sequence[str]) -> None:
        """Begins a drive by angen go; `words`: ROOM, or X Y FLOOR."""
        with self._lock:
            self.stop(robot)
            process = subprocess.Popen([*GO, f'--robot={robot}', '--', *words], text=True,
                                       errors='replace', stdin=subprocess.DEVNULL,
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self._processes[robot] = process
            self._show(robot, goal, 'surveys the home', True, 0.0)
        threading.Thread(target=self._read, args=(robot, goal, process), daemon=True).start()

    def _read(self, robot: str, goal: str, process: subprocess.Popen[str]) -> None:
        assert process.stdout is not None
        share, text = 0.0, ''
        for line in process.stdout:
            step = STEP.match(line.rstrip())
            if step:
                share = int(step[1]) / 100.0
            text = step[2] or 'begins' if step else NOTE.sub('', line.rstrip(), 1)
            if process.poll() is None:
                self._show(robot, goal, text, True, share)
        code = process.wait()
        with self._lock:
            if self._processes.get(robot) is not process:
                return  # another drive has begun
            del self._processes[robot]
            self._show(robot, goal, 'stopped' if code == STOPPED else text, False,
                       1.0 if code == 0 else share)

    def _show(self, robot: str, goal: str, text: str, drives: bool, share: float | None) -> None:
        with self._lock:
            self._trips[robot] = {'goal': goal, 'text': text, 'drives': drives, 'share': share}
            shown = dict(self._trips)
        self._store.put('trips', shown)

    def stop(self, robot: str) -> None:
        """Ends a drive, if there is one: its robot stands when this returns."""
        with self._lock:
            process, followed = self._processes.get(robot), self._followed == robot
            self._followed = '' if followed else self._followed
        if process is not None:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(LIMIT)
            except subprocess.TimeoutExpired:
                process.kill()
        if followed and self._cancel is not None:
            from actionlib_msgs.msg import GoalID
            self._cancel.publish(GoalID())  # all goals
            trip = self._trips[robot]
            self._show(robot, trip['goal'], 'stopped', False, None)

    def close(self) -> None:
        for robot in list(self._trips):
            self.stop(robot)

    # --- move_base

    def follow(self, robot: str, goal: str) -> None:
        """Shows what becomes of a goal that is published to move_base now."""
        import rospy
        from actionlib_msgs.msg import GoalID, GoalStatusArray
        self.stop(robot)
        if self._cancel is None:
            self._cancel = rospy.Publisher('move_base/cancel', GoalID, queue_size=1)
            rospy.Subscriber('move_base/status', GoalStatusArray, self._on_status)
        with self._lock:
            self._followed, self._before = robot, set(self._goals)
        self._show(robot, goal, 'the goal is published', False, None)

    def _on_status(self, message: Any) -> None:
        with self._lock:
            self._goals = {status.goal_id.id for status in message.status_list}
            robot, before = self._followed, self._before
        for status in message.status_list:
            if not robot or status.goal_id.id in before:
                continue
            drives = status.status in DRIVES + WAITS
            text = ('drives' if drives else 'arrived' if status.status in ARRIVED else
                    f'{ENDED.get(status.status, "ended")}: {status.text}'.rstrip(': '))
            self._show(robot, self._trips[robot]['goal'], text, drives, None)

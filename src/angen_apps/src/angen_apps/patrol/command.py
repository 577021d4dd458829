"""angen task patrol: from the words of the command to the folder that it leaves."""
import os
import shutil
import signal
import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import NoReturn

from angen_apps.patrol import scene
from angen_apps.patrol.drive import Patrol, RosRobot
from angen_apps.patrol.figure import draw
from angen_apps.patrol.report import (Figures, Run, make_rows, measure, plans, summary, table_of,
                                      verdict, write_tables)
from angen_apps.plan.draw import read_scene
from angen_apps.robot.building import write_world
from angen_apps.robot.entities import entities_of
from angen_apps.robot.interface import BUMPER, bumper
from angen_apps.robot.rooms_route import prepare
from angen_apps.robot.tables import write_figures
from angen_tools.common.failure import Failure
from angen_tools.common.output import as_json, show
from angen_tools.common.progress import Progress
from angen_tools.common.wait import wait
from angen_tools.live.sandbox import Sandbox
from angen_tools.session.stepped import Stepped
from angen_tools.world.models import worlds_models

RECORDED = (f'/angen/(?!contact/{BUMPER})'
            '(pir|switch|luminosity|contact|door|elevator|lamp|events|stats|markers).*'
            '|/gazebo/.*_controller|/clock|/tf|/tf_static')
BAG_LIMIT = 30.0  # s
BAG_QUIET = 0.5  # s without a message after which all have arrived
NO_SPACE = 'Disabling recording'  # in the output of rosbag then
LEFT, FEW = '32M', 64_000_000  # on the disk: with less rosbag stops; with less it is why it did
SENSORS = ('pir', 'switch', 'luminosity', 'contact')


def patrol(route_file: Path | None, world: Path | None, seed: int, rate: float, out: Path,
           json: bool) -> int:
    """Drives a route and writes the report; 0, or 1 where the robot touched something or the
    elevator was not level. Failure if the route cannot be driven."""
    route, world, survey = prepare(route_file, world, out / 'logs')
    began = time.monotonic()
    own_world = out.absolute() / 'patrol.world'
    write_world(world, route.robot, scene.start_offset(seed), own_world)
    with Sandbox((out / 'logs').absolute()) as sandbox:
        sandbox.node(own_world, 0.0, paused='true', seed=seed)
        stepped = Stepped()
        entities = entities_of(stepped)
        place, actions = scene.make_scene(route, str(own_world), entities,
                                          scene.start_offset(seed), survey)
        xml, link = bumper(own_world, route.robot)
        stepped.spawn(BUMPER, xml, on=link)
        clock = Clock(rate)
        robot = RosRobot(route, place, stepped)
        robot.connect()
        bag = Bag(sandbox, out.absolute() / 'patrol.bag', route.robot)

        def cycle(now: float, share: float, text: str) -> None:
            bag.check()
            clock.cycle(now, share, text)

        drive = Patrol(route, place, robot, seed, cycle, clock.note)
        stepped.wait_for_subscribers(2)
        if rate > 0:
            watch(sandbox)
        clock.note(0.0, f'the patrol begins: {len(route.waypoints)} waypoints')
        clock.start()
        drive.run(actions)
        took = clock.end()
        bag.close()
        robot.take_angles()
    run = Run(route.robot, place, drive.track, drive.reached, robot.events,
              [e for e in entities if e.kind in SENSORS], robot.door_angles)
    rows, found = make_rows(run, own_world), measure(run, seed, took)
    write_tables(run, rows, out)
    plan = read_scene(own_world)
    for floor, name in zip(sorted(place.maps), plans(run)):
        draw(run, rows, plan, floor, out / name)
    write_figures(Figures, [found], out / 'summary.csv')
    if json:
        print(as_json({**asdict(found), 'sensors': [asdict(row) for row in rows]}))
    else:
        show(table_of(rows))
        print(summary(run, found, time.monotonic() - began, out))
    return verdict(found)


def watch(sandbox: Sandbox) -> None:
    """Opens rviz, or prints why there is none."""
    reason = sandbox.display() if os.environ.get('DISPLAY') else 'there is no display'
    if reason is None:
        show_robot(sandbox)
    if reason is None and sandbox.rviz() is None:
        reason = f'it does not start; see {sandbox.folder}/rviz.log'
    if reason:
        print(f'angen: no rviz: {reason}', file=sys.stderr)


def show_robot(sandbox: Sandbox) -> None:
    """Sets the parameter of rviz's RobotModel, as angen.launch does."""
    import rospy
    urdf = worlds_models() / 'turtlebot/turtlebot.urdf'
    rospy.set_param('/robot_description', urdf.read_text())
    publisher = 'robot_state_publisher'
    sandbox.start(['rosrun', publisher, publisher], publisher)


class Bag:
    """A rosbag of the run, by rosbag itself. It is PATH.active until it is closed."""

    def __init__(self, sandbox: Sandbox, path: Path, robot: str) -> None:
        self._path, self._log = path, sandbox.folder / 'rosbag.log'
        self._sandbox, self._commands = sandbox, f'/{robot}/cmd_vel|/gazebo/.*_controller'
        pattern = f'{RECORDED}|/{robot}/(odom|cmd_vel|scan|joint_states)'
        path.unlink(missing_ok=True)
        self._process = sandbox.start(
            ['rosrun', 'rosbag', 'record', '--quiet', '-O', str(path), '--buffsize', '256',
             '--min-space', LEFT, '--regex', pattern], 'rosbag')
        topics = sandbox.topics(pattern)

        def subscribes() -> bool:
            self.check()
            return topics <= sandbox.subscribed_by('record')

        wait(subscribes, 'rosbag has not subscribed', BAG_LIMIT)

    def check(self) -> None:
        """Failure if rosbag has ended, or has stopped for want of space."""
        if self._process.poll() is not None or NO_SPACE in self._said():
            self._complain()

    def close(self) -> None:
        """Ends the recording; the file is whole then. Failure if it is not."""
        self.check()
        self._receive_the_rest()
        self._process.send_signal(signal.SIGINT)
        wait(lambda: self._process.poll() is not None, 'rosbag has not ended', BAG_LIMIT)
        if not self._path.exists() or NO_SPACE in self._said():
            self._complain()

    def _receive_the_rest(self) -> None:
        """Returns when no command has arrived for a while: none is sent any more, and commands
        that a slow machine still delivers belong to the run.
        """
        before = -1
        while before != (received := self._sandbox.received_by('record', self._commands)):
            before = received
            time.sleep(BAG_QUIET)

    def _said(self) -> str:
        return self._log.read_text(errors='replace')

    def _complain(self) -> NoReturn:
        lines = self._said().splitlines()
        free = shutil.disk_usage(self._path.parent).free
        why = f'the disk has {free // 1_000_000} MB left; ' if free < FEW else ''
        why += lines[-1] if lines else f'rosbag ended with {self._process.returncode}'
        active = self._path.with_name(self._path.name + '.active')
        kept = (f'; rosbag reindex makes {active} readable, which has the messages before that'
                if active.exists() else '')
        raise Failure(f'{self._path}: cannot be written: {why}{kept}')


class Clock:
    """Paces a run and reports on it. `rate`: simulated seconds per second; 0: no pacing."""

    def __init__(self, rate: float) -> None:
        self._rate = rate
        self._began = time.monotonic()
        self._progress = Progress('patrol')

    def start(self) -> None:
        """The run begins now."""
        self._began = time.monotonic()

    def cycle(self, now: float, share: float, text: str) -> None:
        """After each cycle, with the simulated time (s), and what share of all is done."""
        wall = time.monotonic() - self._began
        if self._rate > 0 and now / self._rate > wall:
            time.sleep(now / self._rate - wall)
        self._progress.update(share, f'{now:6.1f} s, {now / max(wall, 0.01):.1f} times real time: '
                              f'{text}')

    def note(self, now: float, text: str) -> None:
        """Prints what happened at a simulated time (s)."""
        self._progress.note(f'{now:6.1f} s  {text}')

    def end(self) -> float:
        """Wall time since the start, s."""
        self._progress.close()
        return time.monotonic() - self._began

"""angen task patrol: from the words of the command to the folder that it leaves."""
from __future__ import annotations

import os
import shutil
import signal
import sys
import time
from pathlib import Path

from . import scene
from .bench_run import Stage, wait
from .failure import Failure
from .lockstep import Lockstep
from .models import collisions, worlds_models
from .patrol import BUMPER, CYCLE, Patrol
from .patrol_figure import draw
from .patrol_report import (Run, make_rows, measure, plans, summary, verdict, write_figures,
                            write_tables)
from .route_file import read_route
from .sdf import read

BASE = 'base_footprint'  # the robot's link that carries its body
ROLLS = ('wheel', 'tread', 'caster')  # a collision with this in its name may touch the floor
RECORDED = (f'/angen/(?!contact/{BUMPER})'
            '(pir|switch|luminosity|contact|door|elevator|lamp|events|stats).*'
            '|/gazebo/.*_controller|/clock|/tf|/tf_static')
BAG_LIMIT = 30.0  # s
SENSORS = ('pir', 'switch', 'luminosity', 'contact')


def default_route() -> Path:
    """config/patrol.yaml of this package."""
    import rospkg
    return Path(rospkg.RosPack().get_path('angen_tools')) / 'config/patrol.yaml'


def default_world() -> Path:
    """worlds/angen.world of the package angen_sim."""
    return worlds_models().parent / 'angen.world'


def patrol(route_file: Path | None, world: Path | None, seed: int, rate: float, out: Path) -> int:
    """Drives a route and writes the report; 0, or 1 where the robot touched something or the
    elevator was not level. Failure where the route cannot be driven."""
    route = read_route(route_file or default_route())
    world = (world or default_world()).absolute()
    try:
        (out / 'logs').mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Failure(f'{out}: cannot be written: {error.strerror}') from None
    began = time.monotonic()
    own_world = out.absolute() / 'patrol.world'
    scene.write_world(world, route.robot, seed, own_world)
    paths = [str(world.parent / 'models'), os.environ.get('ANGEN_MODEL_PATH', '')]
    os.environ['ANGEN_MODEL_PATH'] = ':'.join(path for path in paths if path)
    with Stage((out / 'logs').absolute()) as stage:
        stage.node(own_world, 0.0, paused='true', seed=seed)
        lockstep = Lockstep(CYCLE)
        entities = lockstep.entities()
        place, actions = scene.make_scene(route, str(own_world), entities,
                                          scene.start_offset(seed))
        put_bumper(lockstep, route.robot, own_world)
        clock = Clock(rate)
        drive = Patrol(route, place, lockstep, seed, clock.cycle)
        drive.connect()
        bag = Bag(stage, out.absolute() / 'patrol.bag', route.robot)
        lockstep.heard_by(2)
        if rate > 0:
            watch(stage)
        clock.start()
        drive.run(actions)
        took = clock.end()
        bag.close()
    run = Run(route.robot, place, drive.track, lockstep.events,
              [e for e in entities if e.kind in SENSORS], drive.door_angles())
    rows, found = make_rows(run, own_world), measure(run, seed, took)
    write_tables(run, rows, out)
    write_figures([found], out / 'summary.csv')
    for floor, name in zip(sorted(place.maps), plans(run)):
        draw(run, rows, route, floor, out / name)
    print(summary(run, rows, found, time.monotonic() - began, out))
    return verdict(found)


def put_bumper(lockstep: Lockstep, robot: str, world: Path) -> None:
    """Puts a sensor on the robot that feels in each step all that may touch nothing."""
    link = f'{robot}::{BASE}'
    names = [name for name in collisions(read(world), link)
             if not any(part in name for part in ROLLS)]
    if not names:
        raise Failure(f'the robot {robot} has no link {BASE} with collisions')
    parts = ''.join(f'<collision>{name}</collision>' for name in names)
    lockstep.spawn(BUMPER, f'<sensor name="{BUMPER}" type="contact"><update_rate>1000'
                   f'</update_rate><contact>{parts}</contact><plugin name="bumper" '
                   'filename="libgazebo_ros_bumper.so"/></sensor>', link)


def watch(stage: Stage) -> None:
    """Opens rviz, or says why there is none."""
    reason = stage.display() if os.environ.get('DISPLAY') else 'there is no display'
    if reason is None:
        show_robot(stage)
    if reason is None and stage.rviz() is None:
        reason = f'it does not start; see {stage.folder}/rviz.log'
    if reason:
        print(f'angen: no rviz: {reason}', file=sys.stderr)


def show_robot(stage: Stage) -> None:
    """Gives rviz what its RobotModel wants, as angen.launch does."""
    import rospy
    urdf = worlds_models() / 'turtlebot/turtlebot.urdf'
    rospy.set_param('/robot_description', urdf.read_text())
    publisher = 'robot_state_publisher'
    stage.start(['rosrun', publisher, publisher], publisher)


class Bag:
    """A rosbag of the run, by rosbag itself."""

    def __init__(self, stage: Stage, path: Path, robot: str) -> None:
        self._path = path
        pattern = f'{RECORDED}|/{robot}/(odom|cmd_vel|scan|joint_states)'
        path.unlink(missing_ok=True)
        program = shutil.which('rosbag')
        if not program:
            raise Failure('rosbag is not found; install ros-core')
        self._process = stage.start(['/usr/bin/env', 'python3', program, 'record', '-q', '-O',
                                     str(path), '-b', '256', '-e', pattern], 'rosbag')
        topics = stage.topics(pattern)
        wait(lambda: topics <= stage.heard_by('record'), 'rosbag does not listen', BAG_LIMIT)

    def close(self) -> None:
        """Ends the recording; the file is whole then."""
        self._process.send_signal(signal.SIGINT)
        wait(self._path.exists, f'rosbag has not written {self._path}', BAG_LIMIT)


class Clock:
    """Paces a run, and tells how far it is. `rate`: simulated seconds a second; 0: no pacing."""

    def __init__(self, rate: float) -> None:
        self._rate = rate
        self._began = self._shown = time.monotonic()
        self._told = -1

    def start(self) -> None:
        """The run begins now."""
        self._began = time.monotonic()

    def cycle(self, now: float, share: float, text: str) -> None:
        """After each cycle, with the simulated time (s), and what share of all is done."""
        wall = time.monotonic() - self._began
        if self._rate > 0 and now / self._rate > wall:
            time.sleep(now / self._rate - wall)
        line = (f'patrol {100 * share:3.0f} %  {now:6.1f} s, {now / max(wall, 0.01):.1f} times '
                f'real time: {text}')
        if sys.stderr.isatty():
            if time.monotonic() - self._shown > 0.1:
                self._shown = time.monotonic()
                print(f'\r\033[Kangen: {line}', end='', file=sys.stderr, flush=True)
        elif int(10 * share) > self._told:
            self._told = int(10 * share)
            print(f'angen: {line}', file=sys.stderr)

    def end(self) -> float:
        """Wall time since the start, s."""
        if sys.stderr.isatty():
            print('\r\033[K', end='', file=sys.stderr)
        return time.monotonic() - self._began

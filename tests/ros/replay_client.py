"""A client with random actions, each at least once, until a simulated time: NAME SECONDS.

Prints how often it did each.
"""
import random
import sys
import time
from collections import Counter
from typing import Callable

import rospy
from angen_msgs.msg import Command, Event
from angen_msgs.srv import Delete, SendCommand, Spawn, Step
from geometry_msgs.msg import Pose, Twist
from std_msgs.msg import String
from std_srvs.srv import Empty

BOX = """<model name="box"><link name="link"><inertial><mass>2</mass></inertial>
  <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
  <visual name="v"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></visual></link>
</model>"""
MODELS = [BOX, BOX, "model://pir", "model://chair", "model://cup", "model://temperature_sensor"]
MOST = 5  # models of one client at a time
PAUSE = 0.8  # simulated s between two actions, at most


class Client:
    """One of several; their names differ, so that each deletes its own."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.random = random.Random(name)
        self.count = 0
        self.mine: list[str] = []
        self.done: Counter[str] = Counter()
        self.doors = rospy.Publisher("/gazebo/Door_controller", String, queue_size=100)
        self.lamps = rospy.Publisher("/gazebo/Light_controller", String, queue_size=100)
        self.any = rospy.Publisher("/angen/command", Command, queue_size=100)
        self.notes = rospy.Publisher("/angen/events/add", Event, queue_size=100)
        self.wheels = rospy.Publisher("/cmd_vel", Twist, queue_size=100)
        self.listener: rospy.Subscriber | None = None
        self.services = {
            name: rospy.ServiceProxy(name, kind, persistent=False) for name, kind in (
                ("/angen/spawn", Spawn), ("/angen/delete", Delete),
                ("/angen/command", SendCommand), ("/angen/step", Step),
                ("/gazebo/pause_physics", Empty), ("/gazebo/unpause_physics", Empty),
                ("/gazebo/reset_world", Empty))}

    def spawn(self) -> None:
        if len(self.mine) >= MOST:
            self.delete()
        self.count += 1
        name = f"{self.name}_{self.count}"
        pose = Pose()
        pose.position.x = self.random.uniform(-4, 4)
        pose.position.y = self.random.uniform(-4, 4)
        pose.position.z = self.random.uniform(0.2, 2.5)
        pose.orientation.w = 1.0
        if self.services["/angen/spawn"](name, self.random.choice(MODELS), "", pose).success:
            self.mine.append(name)

    def delete(self) -> None:
        if self.mine:
            self.services["/angen/delete"](self.mine.pop(0))

    def door(self) -> None:
        self.doors.publish(self.random.choice(
            ["Open, bathroom0", "Close, bathroom0", "Set, bathroom0, -0.7", "Fly, bathroom0",
             "Open, "]))

    def mistake(self) -> None:
        self.doors.publish("Fly, bathroom0")

    def lamp(self) -> None:
        self.lamps.publish(f"Dim, kitchen0, {self.random.randrange(101)}")

    def command(self) -> None:
        target = self.random.choice(["kitchen0", "door/bathroom0", "nobody"])
        self.any.publish(Command(target=target, text=self.random.choice(["On", "Off", "Open"])))

    def call(self) -> None:
        self.services["/angen/command"]("kitchen0", self.random.choice(["On", "Off"]))

    def note(self) -> None:
        self.notes.publish(Event(source=self.name, kind="client", event="noticed",
                                 detail=f"“{self.count}”"))

    def drive(self) -> None:
        twist = Twist()
        twist.linear.x = self.random.uniform(-0.3, 0.5)
        twist.angular.z = self.random.uniform(-1, 1)
        self.wheels.publish(twist)

    def step(self) -> None:
        self.services["/gazebo/pause_physics"]()
        self.lamp()
        self.spawn()
        self.services["/angen/step"](self.random.randrange(1, 300))
        self.services["/gazebo/unpause_physics"]()

    def reset(self) -> None:
        self.services["/gazebo/reset_world"]()

    def listen(self) -> None:
        """Begins or ends to subscribe to something that samples on demand."""
        if self.listener is not None:
            self.listener.unregister()
            self.listener = None
            return
        topics = [topic for topic, _ in rospy.get_published_topics()
                  if "scan" in topic or "image" in topic or "depth" in topic]
        if topics:
            self.listener = rospy.Subscriber(self.random.choice(topics), rospy.AnyMsg,
                                             lambda _: None)

    def run(self, seconds: float) -> None:
        often: list[Callable[[], None]] = [
            self.spawn, self.delete, self.door, self.lamp, self.command, self.call, self.note,
            self.drive]
        rarely: list[Callable[[], None]] = [self.step, self.listen, self.reset]
        first = [*often, *rarely, self.mistake]  # each once, however late the client starts
        while (first or rospy.get_time() < seconds) and not rospy.is_shutdown():
            act = first.pop() if first else self.random.choice(often * 6 + rarely)
            try:
                act()
                self.done[act.__name__] += 1
            except rospy.ServiceException:
                if rospy.is_shutdown():
                    return
            rospy.sleep(self.random.uniform(0.0, PAUSE))


def main() -> None:
    name, seconds = sys.argv[1], float(sys.argv[2])
    rospy.init_node(name)
    client = Client(name)
    for service in client.services.values():
        service.wait_for_service(20.0)
    for publisher in (client.doors, client.lamps, client.any, client.notes, client.wheels):
        while publisher.get_num_connections() == 0 and not rospy.is_shutdown():
            time.sleep(0.02)
    client.run(seconds)
    print(sum(client.done.values()), dict(sorted(client.done.items())))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Lights a room while its PIRs detect motion and it is dark; prints the lamp-hours that it saves.

    ./angen run                                                           # in another terminal
    ./angen shell -c "python3 examples/lamps_by_pir.py _duration:=120"    # simulated seconds
"""
import re

import rospy
from angen_msgs.msg import LampState, LightSensMsg, PirMsg
from angen_msgs.srv import List
from std_msgs.msg import String

HOLD = rospy.Duration(10.0)  # for which a lamp stays on after the last motion
DARK = 10.0  # lx; where it is brighter without the room's own lamp, that one stays off


class Room:
    """A lamp, and the last reports of the sensors of its room."""

    def __init__(self, lamp, start, orders):
        self.name, self._start, self._orders = lamp.name, start, orders
        self._until, self._since, self._dark = rospy.Time(0), None, False
        self.seconds = 0.0  # that the lamp was on
        rospy.Subscriber(lamp.topic, LampState, self.lamp)

    def lamp(self, state):
        if self._since and not state.on:
            self.seconds += (state.header.stamp - self._since).to_sec()
        self._since = (self._since or max(self._start, state.header.stamp)) if state.on else None

    def pir(self, reading):
        if reading.motion and (self._since or self._dark):
            self._until = reading.header.stamp + HOLD

    def lux(self, reading):
        if not self._since:
            self._dark = reading.illuminance < DARK

    def switch(self, now):
        needed = now < self._until
        if needed != bool(self._since):
            rospy.loginfo('%s %s', self.name, 'on' if needed else 'off')
            self._orders.publish(f'{"On" if needed else "Off"}, {self.name}')


def room_of(sensor):
    """kitchen0 for kitchen_pir0_a and kitchen_lux0."""
    return re.sub(r'_\D+(\d+).*', r'\1', sensor)


rospy.init_node('lamps_by_pir')
rospy.wait_for_service('/angen/list')
entities = rospy.ServiceProxy('/angen/list', List)
light = rospy.Publisher('/gazebo/Light_controller', String, queue_size=10)
rospy.sleep(0.1)  # until time is known
start = now = rospy.Time.now()
watched = {room_of(sensor.name) for sensor in entities('pir').entities}
rooms = {lamp.name: Room(lamp, start, light) for lamp in entities('lamp').entities
         if lamp.name in watched}
for kind, message, callback in (('pir', PirMsg, Room.pir), ('luminosity', LightSensMsg, Room.lux)):
    for sensor in entities(kind).entities:
        if room := rooms.get(room_of(sensor.name)):
            rospy.Subscriber(sensor.topic, message, lambda m, c=callback, r=room: c(r, m))
while not rospy.is_shutdown() and (now - start).to_sec() < rospy.get_param('~duration', 120.0):
    rospy.sleep(0.2)
    now = rospy.Time.now()
    for room in rooms.values():
        room.switch(now)
for room in rooms.values():  # lamps that are still on count up to now
    room.lamp(LampState(header=rospy.Header(stamp=now), on=False))
used, all_on = sum(r.seconds for r in rooms.values()), len(rooms) * (now - start).to_sec()
print(f'{used / 3600:.3f} lamp-hours instead of {all_on / 3600:.3f} with all {len(rooms)} lamps '
      f'on: {100 * (1 - used / all_on):.0f} % saved in {(now - start).to_sec():.0f} s')

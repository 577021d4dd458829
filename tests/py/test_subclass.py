"""A sensor and a device written in Python, loaded as a world's plug-ins."""
import math

import numpy as np
import pytest

import angen
from sdf_text import box


class Rangefinder(angen.Sensor):
    """Distance straight ahead, m."""

    rate = 20.0

    def configure(self, params, wiring):
        self.reach = params.number('reach', 5.0, 'm', 'how far it looks', min=0.0)

    def aim(self, view):
        ahead = view.rotation[:, 0]
        return np.hstack([view.pose[:3], ahead, [0.0, self.reach]])[None]

    def read(self, view, ranges, rng):
        return {'range': float(min(ranges[0], self.reach)), 'hit': bool(ranges[0] < self.reach)}


class Pusher(angen.Device):
    """Pushes its slider with the force that it was commanded, N."""

    @staticmethod
    def serves(model, joints, lights):
        return 'slider' in joints

    def configure(self, params, wiring):
        self.joint = wiring.joint('slider')
        self.force = 0.0

    def command(self, text, values, view):
        if text != 'Push' or len(values) != 1:
            return 'write Push and a force in N'
        self.force = values[0]

    def update(self, view, outputs):
        if self.force:
            outputs.force(self.joint, self.force)

    def report(self, view):
        position, velocity, _ = view.joint(self.joint)
        return {'position': position, 'velocity': velocity}


class Tracker(angen.Sensor):
    """The places of the sliders that report a position, m along the world's x."""

    rate = 10.0

    def configure(self, params, wiring):
        pass

    def aim(self, view):
        return None

    def read(self, view, ranges, rng):
        found = view.devices('position')
        return {'names': [name for name, _, _ in found],
                'x': [float(pose[0] + state['position']) for _, pose, state in found]}


class Declared(angen.Sensor):
    """A reading by its parameter, with fields that it declares."""

    fields = {'distance': 'number m', 'ids': 'texts'}

    def configure(self, params, wiring):
        self.field = params.text('field', 'distance')

    def read(self, view, ranges, rng):
        return {self.field: 2, 'ids': []}


class Beeper(angen.Device):
    """Beeps."""

    @staticmethod
    def serves(model, joints, lights):
        return model == 'beeper'

    @staticmethod
    def describe(kind):
        kind.verb('Off', 'ends it').verb('Beep', 'beeps', 'times', 'Hz', min=1, max=9)
        kind.flag('on', 'whether it beeps').alarm('BEEPS', 'silent').number('rate', 'Hz', 'of it')

    def report(self, view):
        return {'on': True, 'rate': 2}


class Wordless(angen.Device):
    @staticmethod
    def describe(kind):
        kind.shown()


class Ruler(angen.Sensor):
    """Distance straight ahead with noise, m; counts its samples by whether it may be idle."""

    fields = {'range': 'number m'}
    samples = {False: 0, True: 0}

    def configure(self, params, wiring):
        params.noise('range', 'm', 'of the range')
        self.may_idle = params.flag('may_idle', False)

    def aim(self, view):
        return np.hstack([view.pose[:3], view.rotation[:, 0], [0.0, 5.0]])[None]

    def read(self, view, ranges, rng):
        self.samples[self.may_idle] += 1
        return {'range': ranges[0]}

    def idle_until(self, view):
        return math.inf if self.may_idle else view.time


class Broken(angen.Sensor):
    """Divides by zero after half a second."""

    rate = 10.0

    def configure(self, params, wiring):
        pass

    def aim(self, view):
        return None

    def read(self, view, ranges, rng):
        return {'value': 1 / (0 if view.time > 0.5 else 1)}


angen.register('beeper.py', 'beeper', Beeper)
angen.register('declared.py', 'declared', Declared)
angen.register('broken.py', 'broken', Broken)
angen.register('tracker.py', 'tracker', Tracker)
angen.register('ruler.py', 'ruler', Ruler)
angen.register('rangefinder.py', 'rangefinder', Rangefinder)
angen.register('pusher.py', 'pusher', Pusher)

RANGE = '''<model name="ranger"><static>true</static><pose>0 0 1 0 0 {yaw}</pose><link name="link">
  <sensor name="s" type="ray"><plugin name="p" filename="rangefinder.py">{extra}</plugin></sensor>
  </link></model>'''


def test_python_sensor_measures_a_wall(world):
    w = world(box('wall', '3 0 1 0 0 0', '0.2 4 2', True) + RANGE.format(yaw=0, extra=''))
    w.step()
    assert w.sensor('rangefinder', 'ranger')['range'] == pytest.approx(2.9, abs=1e-6)


def test_python_sensor_turned_away_sees_nothing(world):
    w = world(box('wall', '3 0 1 0 0 0', '0.2 4 2', True) + RANGE.format(yaw=3.14, extra=''))
    w.step()
    reading = w.sensor('rangefinder', 'ranger')
    assert reading['hit'] is False and reading['range'] == 5.0


def test_its_parameters_are_checked_like_any_other(world):
    with pytest.raises(angen.Error, match='reach'):
        world(RANGE.format(yaw=0, extra='<reach>far</reach>'))
    with pytest.raises(angen.Error, match='raech'):
        world(RANGE.format(yaw=0, extra='<raech>3</raech>'))


def test_a_noisy_one_that_may_be_idle_reads_the_same_with_fewer_samples(world):
    wall = box('wall', '3 0 1 0 0 0', '0.2 4 2', True)
    ruler = RANGE.replace('rangefinder', 'ruler')
    worlds = [world(wall + ruler.format(yaw=0, extra=f'<noise_stddev>0.1</noise_stddev>{more}'))
              for more in ('', '<may_idle>true</may_idle>')]
    seen = [[], []]
    for _ in range(20):
        for w, values in zip(worlds, seen):
            w.run(1.0)
            values.append(w.sensor('ruler', 'ranger')['range'])
    assert seen[0] == seen[1] and len(set(seen[0])) == 20
    assert Ruler.samples[False] == 201 and Ruler.samples[True] < 5


def declared(field: str) -> str:
    return (RANGE.format(yaw=0, extra=f'<field>{field}</field>')
            .replace('rangefinder', 'declared'))


def test_an_integer_and_an_empty_list_get_the_declared_type(world):
    w = world(declared('distance'))
    w.run(1.0)
    reading = w.sensor('declared', 'ranger')
    assert isinstance(reading['distance'], float) and reading['distance'] == 2.0
    assert reading['ids'] == []


def test_fields_may_be_numbers_of_numpy(world):
    class Numpy(angen.Sensor):
        fields = {'near': 'flag', 'nearest': 'integer', 'far': 'number m', 'all': 'numbers'}

        def aim(self, view):
            return np.hstack([view.pose[:3], view.rotation[:, 0], [0.0, 5.0]])[None]

        def read(self, view, ranges, rng):
            return {'near': ranges.min() < 3.0, 'nearest': ranges.argmin(),
                    'far': ranges.astype(np.float32).max(), 'all': np.array(ranges[0])[None]}

    angen.register('numpys.py', 'numpys', Numpy)
    w = world(box('wall', '3 0 1 0 0 0', '0.2 4 2', True)
              + RANGE.format(yaw=0, extra='').replace('rangefinder', 'numpys'))
    w.run(1.0)
    reading = w.sensor('numpys', 'ranger')
    assert reading['near'] is True and reading['nearest'] == 0
    assert reading['far'] == pytest.approx(2.9, abs=1e-6) == reading['all'][0]


def test_a_field_that_is_not_declared_fails_the_sensor(world):
    w = world(declared('distnce'))
    with pytest.raises(angen.Error, match="declare the field 'distnce'; did you mean distance"):
        w.run(1.0)
    assert 'distnce' in w.sensor('declared', 'ranger')['error']


def test_a_type_that_does_not_exist_is_an_error_when_it_is_registered():
    class Wrong(angen.Sensor):
        """Declares a type of its own."""
        fields = {'distance': 'length'}

    with pytest.raises(angen.Error, match="declared as 'length'; right is TYPE or TYPE UNIT"):
        angen.register('wrong.py', 'wrong', Wrong)


SLED = '''<model name="sled"><pose>0 0 1 0 0 0</pose><link name="rail"/>
      <link name="mass"><gravity>false</gravity><inertial><mass>2</mass><inertia><ixx>0.1</ixx>
      <iyy>0.1</iyy><izz>0.1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
      <joint name="fix" type="fixed"><parent>world</parent><child>rail</child></joint>
      <joint name="slider" type="prismatic"><parent>rail</parent><child>mass</child>
      <axis><xyz>1 0 0</xyz><limit><lower>-5</lower><upper>5</upper></limit></axis></joint>
      <plugin name="p" filename="pusher.py"/></model>'''


def test_a_python_sensor_sees_the_states_of_devices(world):
    tracker = '''<model name="eye"><static>true</static><link name="link">
      <sensor name="s" type="ray"><plugin name="p" filename="tracker.py"/></sensor>
      </link></model>'''
    w = world(SLED + SLED.replace('name="sled"><pose>0', 'name="far"><pose>7')
              + RANGE.format(yaw=0, extra='') + tracker)
    w.command('pusher', 'far', 'Push', [4.0])
    w.run(1.05)
    reading = w.sensor('tracker', 'eye')
    assert reading['names'] == ['sled', 'far']
    assert reading['x'] == pytest.approx([0.0, 7.0 + 1.0], rel=0.02)


def test_python_device_moves_its_joint_by_newtons_law(world):
    w = world(SLED)
    with pytest.raises(angen.Error, match='write Push'):
        w.command('pusher', 'sled', 'Pull')
    w.command('pusher', 'sled', 'Push', [4.0])
    w.run(1.0)
    assert w.device('pusher', 'sled')['velocity'] == pytest.approx(2.0, rel=0.02)
    assert w.joint_positions[w.joints.index('sled::slider')] == pytest.approx(1.0, rel=0.02)


def test_an_exception_reaches_the_caller_and_stops_its_sensor_alone(world):
    ranger = RANGE.format(yaw=0, extra='')
    w = world(ranger + ranger.replace('ranger"', 'broken"').replace('rangefinder', 'broken'))
    with pytest.raises(angen.Error, match=r"broken .broken. has failed: .*:\d+: ZeroDivision"):
        w.step(1000)
    w.step(1000)
    assert w.time == pytest.approx(2.0)
    assert 'ZeroDivisionError' in w.sensor('broken', 'broken')['error']
    assert 'error' not in w.sensor('rangefinder', 'ranger')


def test_a_class_describes_its_verbs_and_fields(world):
    kind, = (each for each in angen.plugins() if each['kind'] == 'beeper')
    assert [(verb['name'], verb['argument'], verb['unit'], verb['min'], verb['max'])
            for verb in kind['verbs']] == [('Off', '', '', None, None),
                                           ('Beep', 'times', 'Hz', 1, 9)]
    assert [(field['name'], field['type'], field['unit'], field['alarm'])
            for field in kind['fields']] == [('on', 'flag', '', True),
                                             ('rate', 'number', 'Hz', False)]
    w = world(box('beeper', '3 0 1 0 0 0', '0.2 4 2', True)
              + '<plugin name="beeper" filename="beeper.py"/>')
    w.step()
    assert w.summary('beeper', 'beeper') == 'BEEPS'
    with pytest.raises(angen.Error, match='the first field comes before this'):
        angen.register('wordless.py', 'wordless', Wordless)

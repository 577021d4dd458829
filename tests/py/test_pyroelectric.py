"""A pyroelectric PIR's reports of people, robots, doors and lamps."""
import angen
import pytest
from sdf_text import include, walker

DEVICES = '''
  <plugin name="door" filename="libdoor_world_plugin.so"/>
  <plugin name="lamp" filename="libros_plugin.so"/>
  <plugin name="robot" filename="librobot_controller.so"/>'''


PIR = include('pir_pyroelectric', 'eye', '0 0 2.2 0 0 0')
WAY = '0 5 -3', '2 5 -3', '8 5 3'


def motions(world: angen.World) -> list[float]:
    """Times at which the PIR went on."""
    return [time for time, source, _, event, _ in world.events()
            if source == 'eye' and event == 'motion']


def test_sees_a_person_who_walks_by_and_no_more_once_he_stands(world):
    w = world(PIR + walker('anna', *WAY))
    w.run(2)
    assert motions(w) == []
    w.run(7)
    assert motions(w)
    w.run(15)
    motions(w)
    w.run(30)
    assert motions(w) == []
    reading = w.sensor('pir', 'eye')
    assert reading['signal'] == 0.0 and not reading['motion']
    assert reading['signal_threshold'] == pytest.approx(300e-6)


def test_the_world_says_how_warm_the_room_is():
    text = '''<sdf version="1.6"><world name="w">
      <atmosphere type="adiabatic"><temperature>{}</temperature></atmosphere>
      <model name="plate"><static>true</static><pose>3 -0.15 1.8 0 0 0</pose><link name="l">
        <collision name="c"><geometry><box><size>0.1 0.2 0.2</size></box></geometry></collision>
        <visual name="v"><geometry><box><size>0.1 0.2 0.2</size></box></geometry>
          <plugin name="gz::sim::systems::Thermal" filename="gz-sim-thermal-system">
          <temperature>320</temperature></plugin></visual></link></model>''' + PIR \
        + '</world></sdf>'
    fluxes = []
    for ambient in (280, 320):
        w = angen.World.from_text(text.format(ambient))
        w.step(20)
        fluxes.append(abs(w.sensor('pir', 'eye')['flux']))
    assert fluxes[0] > 1e-7 and fluxes[1] == 0.0


def flux_of_a_person(celsius: float, given: str = '') -> float:
    """For a person before the PIR, in air of that temperature."""
    w = angen.World.from_text(f'''<sdf version="1.6"><world name="w">
      <atmosphere type="adiabatic"><temperature>{celsius + 273.15}</temperature></atmosphere>
      <model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><box>
        <size>20 20 0.02</size></box></geometry></collision></link></model>
      {PIR}<actor name="anna"><pose>4 -0.4 0.02 0 0 0</pose><plugin name="person"
      filename="libperson_controller.so">{given}</plugin></actor></world></sdf>''')
    w.run(1.0)
    return w.sensor('pir', 'eye')['flux']


@pytest.mark.parametrize('celsius', [10.0, 27.0, 33.0])
def test_a_person_radiates_by_the_law_of_skin_and_clothing_in_any_air(celsius):
    def radiance(air: float) -> float:
        """Over that of the air, up to a factor; docs/situations.md."""
        skin = 307.0 + 0.12 * (air - 295.15)
        clothing = air + 0.35 * (306.5 - air)
        return 0.12 * skin ** 4 + 0.88 * clothing ** 4 - air ** 4
    ratio = flux_of_a_person(celsius) / flux_of_a_person(18.0)
    assert ratio == pytest.approx(radiance(celsius + 273.15) / radiance(18.0 + 273.15), rel=0.01)


@pytest.mark.parametrize('given', ['skin', 'clothing'])
def test_what_is_not_given_follows_the_air(given):
    """At 30 degrees C, of a person whose skin or clothing has the temperature that is given."""
    air = 303.15
    skin, clothing = 307.0 + 0.12 * (air - 295.15), air + 0.35 * (306.5 - air)
    parameter = (f'<skin_temperature>{skin}</skin_temperature>' if given == 'skin' else
                 f'<clothing_temperature>{clothing}</clothing_temperature>')
    assert flux_of_a_person(30.0, parameter) == pytest.approx(flux_of_a_person(30.0), rel=1e-6)


def test_an_event_names_whom_its_zones_met(world):
    """Anna walks by behind Bert, who stands nearer; then he walks."""
    w = world(PIR + walker('anna', *WAY) + walker('bert', '0 3 1.5', '20 3 1.5', '26 3 -3'))
    w.run(15)
    seen = [(event, detail) for _, source, _, event, detail in w.events() if source == 'eye']
    assert {detail.partition(' uV')[2] for event, detail in seen if event == 'motion'} == {', anna'}
    assert {detail.partition(' uV')[2] for event, detail in seen if event == 'still'} == {''}
    w.run(12)
    assert {detail.partition(' uV')[2] for _, source, _, event, detail in w.events()
            if (source, event) == ('eye', 'motion')} == {', bert'}


def test_does_not_see_a_turtlebot_a_door_or_a_lamp(world):
    w = world(PIR + include('turtlebot', 'turtlebot', '3 -1 0 0 0 1.57')
              + include('kitchen_door', 'kitchen_door0', '3 1 0 0 0 0')
              + include('ceiling_lamp', 'kitchen_lamp0', '2 0 3 0 0 0'), DEVICES)
    w.run(1)
    moved = w.device('door', 'kitchen0')['position']
    w.command('door', 'kitchen0', 'Open')
    w.command('lamp', 'kitchen0', 'On')
    for _ in range(10):
        w.command('drive', 'turtlebot', values=[0.3, 0.0])
        w.run(0.5)
    assert abs(w.device('door', 'kitchen0')['position'] - moved) > 1.0
    assert w.light_levels[w.lights.index('kitchen_lamp0::bulb')] == 1.0
    assert motions(w) == []
    assert w.sensor('pir', 'eye')['signal'] == 0.0


def on_times(world: angen.World, seconds: float) -> list[tuple[float, float]]:
    """The times at which the PIR switches on and off."""
    world.run(seconds)
    changes = [time for time, source, *_ in world.events() if source == 'eye']
    return list(zip(changes[::2], changes[1::2]))


def test_the_pir_of_the_casas_flats_is_off_a_second_and_a_quarter_after_the_last_motion(world):
    w = world(include('pir_casas', 'eye', '0 0 2.5 0 1.5708 0')
              + walker('anna', '0 3 0', '2 3 0', '8 -3 0'))
    times = on_times(w, 20)
    assert times and all(off - on >= 1.25 for on, off in times)
    # its circle of 0.9 m on the floor: he is below it, at 1 m/s, about 5 s after the start
    assert 3.5 < times[0][0] < 5.0 and times[-1][1] < 9.0
    assert not w.sensor('pir', 'eye')['motion']


def test_an_hc_sr501_warms_up_is_locked_out_and_sees_seven_meters(world):
    def seen(away: float) -> list[tuple[float, float]]:
        way = walker('anna', f'0 {away} -3', f'70 {away} -3', f'76 {away} 3', f'82 {away} -3')
        return on_times(world(include('pir_hc_sr501', 'eye', '0 0 2.2 0 0 0') + way), 90)

    times = seen(5)
    assert times and times[0][0] > 60
    assert all(off - on >= 0.5 for on, off in times)
    assert all(later[0] - earlier[1] >= 2.5 for earlier, later in zip(times, times[1:]))
    assert seen(6.5) and not seen(8.5)

"""Appliances, the microphone, and radio transmitters and receivers."""
from math import pi
from pathlib import Path

from angen_models.devices import write_static
from angen_models.sdf import (Color, Part, add, add_home, add_link, add_plugin, add_pose, add_thing,
                              new_model, numbers, spanned, write_model)

BLACK: Color = (0.05, 0.05, 0.06)
GREY: Color = (0.35, 0.36, 0.38)
STEEL: Color = (0.75, 0.75, 0.78)


def write_appliances(models: Path) -> None:
    """Writes every model of this module under models."""
    _write_tv(models)
    # 1.2 m high, on the floor, blowing along x; its blades do not turn
    write_static(models, "fan", "Fan",
                 "A pedestal fan of 50 W and 60 dB at full speed, off at the start.", "fan", [
                     Part("foot", (0.2, 0.03), (0, 0, 0.015), material=GREY),
                     Part("pole", (0.015, 0.9), (0, 0, 0.48), material=STEEL),
                     Part("motor", (0.06, 0.14), (-0.05, 0, 1.0), (0, pi / 2, 0), material=GREY),
                     Part("guard", (0.22, 0.08), (0.06, 0, 1.0), (0, pi / 2, 0), material=STEEL)],
                 "libappliance.so", thing="fan", control="speed", power=50, sound_power_level=60,
                 level=50, directivity=1, position=numbers(0.06, 0, 1.0))
    # 0.43 m wide, for a shelf or table, facing x
    write_static(models, "stereo", "Stereo",
                 "A small stereo of 12 to 60 W and 95 dB at full volume, off at the start.",
                 "stereo", [
                     spanned("body", (-0.13, -0.13, 0.0), (0.13, 0.13, 0.12), material=BLACK),
                     spanned("speaker_left", (-0.1, 0.135, 0.0), (0.1, 0.255, 0.22),
                             material=GREY),
                     spanned("speaker_right", (-0.1, -0.255, 0.0), (0.1, -0.135, 0.22),
                             material=GREY)],
                 "libappliance.so", thing="stereo", control="volume", power=60, idle_power=12,
                 standby_power=0.5, sound_power_level=95, level=20, directivity=2,
                 position=numbers(0.1, 0, 0.1))
    housing = spanned("housing", (-0.04, -0.03, -0.03), (-0.02, 0.03, 0.03), collide=False)
    write_static(models, "microphone", "Microphone", "The sound pressure level in its room, 2 Hz.",
                 "sensor", [housing, Part("capsule", (0.012, 0.02), (-0.01, 0, 0), (0, pi / 2, 0),
                                          material=BLACK, collide=False)],
                 "libmicrophone.so", sensor=("microphone", 2))
    write_static(models, "radio_receiver", "Radio receiver",
                 "Signal strength of radio transmitters, 1 Hz.", "sensor",
                 [housing, Part("antenna", (0.004, 0.1), (-0.02, 0, 0.05), material=BLACK,
                                collide=False)],
                 "libradio_receiver.so", sensor=("radio_receiver", 1))
    # a small box on a wall, x into the room
    write_static(models, "radio_beacon", "Radio beacon",
                 "Sends its model's name by 0 dBm at 2.44 GHz.", "beacon",
                 [spanned("box", (-0.025, -0.02, -0.03), (-0.005, 0.02, 0.03), collide=False)],
                 "libradio_transmitter.so", "transmitter", tx_power=0, frequency=2440)


def _write_tv(models: Path) -> None:
    """Writes models/tv: a screen of 1.1 x 0.65 m on its foot, facing x; it lights its room."""
    root, model = new_model("tv", static=True)
    parts = [
        spanned("screen", (-0.02, -0.55, 0.05), (0.02, 0.55, 0.7), material=BLACK),
        spanned("foot", (-0.1, -0.2, 0.0), (0.1, 0.2, 0.05), material=(0.1, 0.1, 0.1)),
    ]
    link = add_link(model, "tv", parts, moves=False)
    light = add(link, "light", name="screen", type="point")
    add_pose(light, (0.022, 0, 0.375))
    add(light, "direction", "1 0 0")
    add_home(light, "rectangle", "1.1 0.65")
    # a picture of 90 cd/m2 in the mean: pi x 90 x 1.1 x 0.65 = 200 lm
    add_plugin(model, "tv", "libappliance.so", control="volume", power=90, idle_power=70,
               standby_power=0.5, sound_power_level=85, level=40, directivity=2,
               position=numbers(0.02, 0, 0.35), luminous_flux=200)
    add_thing(model, "tv")
    write_model(root, models, "Television",
                "A television of 70 to 90 W, 0.5 W on standby, 85 dB at full volume and 200 lm; "
                "off at the start. Served by libappliance.so.")

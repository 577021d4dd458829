"""Appliances, the microphone, and radio transmitters and receivers."""
from __future__ import annotations

from math import pi
from pathlib import Path

from angen_models.devices import add_sensor
from angen_models.sdf import (Color, Part, add, add_home, add_link, add_plugin, add_pose, add_thing,
                              new_model, numbers, spanned, write_model)

BLACK: Color = (0.05, 0.05, 0.06)
GREY: Color = (0.35, 0.36, 0.38)
STEEL: Color = (0.75, 0.75, 0.78)


def write_appliances(models: Path) -> None:
    """Writes every model of this module under models."""
    _write_fan(models)
    _write_tv(models)
    _write_stereo(models)
    _write_sensor(models, "microphone", "Microphone",
                  Part("capsule", (0.012, 0.02), (-0.01, 0, 0), (0, pi / 2, 0), material=BLACK,
                       collide=False),
                  "libmicrophone.so", 2,
                  "The sound pressure level in its room, 2 Hz. Served by libmicrophone.so.")
    _write_sensor(models, "radio_receiver", "Radio receiver",
                  Part("antenna", (0.004, 0.1), (-0.02, 0, 0.05), material=BLACK, collide=False),
                  "libradio_receiver.so", 1,
                  "Signal strength of radio transmitters, 1 Hz. Served by libradio_receiver.so.")
    _write_beacon(models)


def _write_fan(models: Path) -> None:
    """Writes models/fan: 1.2 m high, on the floor, blowing along x; its blades do not turn."""
    root, model = new_model("fan", static=True)
    parts = [
        Part("foot", (0.2, 0.03), (0, 0, 0.015), material=GREY),
        Part("pole", (0.015, 0.9), (0, 0, 0.48), material=STEEL),
        Part("motor", (0.06, 0.14), (-0.05, 0, 1.0), (0, pi / 2, 0), material=GREY),
        Part("guard", (0.22, 0.08), (0.06, 0, 1.0), (0, pi / 2, 0), material=STEEL),
    ]
    add_link(model, "fan", parts, moves=False)
    add_plugin(model, "fan", "libappliance.so", control="speed", power=50, sound_power_level=60,
               level=50, directivity=1, position=numbers(0.06, 0, 1.0))
    add_thing(model, "fan")
    write_model(root, models, "Fan",
                "A pedestal fan of 50 W and 60 dB at full speed, off at the start. "
                "Served by libappliance.so.")


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


def _write_stereo(models: Path) -> None:
    """Writes models/stereo: 0.43 m wide, for a shelf or table, facing x."""
    root, model = new_model("stereo", static=True)
    parts = [
        spanned("body", (-0.13, -0.13, 0.0), (0.13, 0.13, 0.12), material=BLACK),
        spanned("speaker_left", (-0.1, 0.135, 0.0), (0.1, 0.255, 0.22), material=GREY),
        spanned("speaker_right", (-0.1, -0.255, 0.0), (0.1, -0.135, 0.22), material=GREY),
    ]
    add_link(model, "stereo", parts, moves=False)
    add_plugin(model, "stereo", "libappliance.so", control="volume", power=60, idle_power=12,
               standby_power=0.5, sound_power_level=95, level=20, directivity=2,
               position=numbers(0.1, 0, 0.1))
    add_thing(model, "stereo")
    write_model(root, models, "Stereo",
                "A small stereo of 12 to 60 W and 95 dB at full volume, off at the start. "
                "Served by libappliance.so.")


def _write_beacon(models: Path) -> None:
    """Writes models/radio_beacon: a small box on a wall, x into the room."""
    root, model = new_model("radio_beacon", static=True)
    box = spanned("box", (-0.025, -0.02, -0.03), (-0.005, 0.02, 0.03), collide=False)
    add_link(model, "beacon", [box], moves=False)
    add_plugin(model, "transmitter", "libradio_transmitter.so", tx_power=0, frequency=2440)
    write_model(root, models, "Radio beacon",
                "Sends its model's name by 0 dBm at 2.44 GHz. Served by libradio_transmitter.so.")


def _write_sensor(models: Path, name: str, title: str, detail: Part, library: str, rate: float,
                  description: str) -> None:
    root, model = new_model(name, static=True)
    housing = spanned("housing", (-0.04, -0.03, -0.03), (-0.02, 0.03, 0.03), collide=False)
    link = add_link(model, "sensor", [housing, detail], moves=False)
    add_plugin(add_sensor(link, name, "custom", rate), name, library)
    write_model(root, models, title, description)

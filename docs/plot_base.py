"""Worlds and axes of the plots; docs/plots.py draws them."""
from __future__ import annotations

import angen
import matplotlib.pyplot as plt

PLUGINS = '''<plugin name="doors" filename="libdoor_world_plugin.so"/>
<plugin name="robots" filename="librobot_controller.so">
<wheelDiameter>0.0704</wheelDiameter></plugin>'''


def world(content: str) -> angen.World:
    """A floor, the plug-ins of doors and robots, and `content`."""
    return angen.World.from_text(f'''<sdf version="1.6"><world name="plot">
      <physics type="ode"><max_step_size>0.001</max_step_size></physics>{PLUGINS}
      <model name="floor"><static>true</static><link name="link"><collision name="box">
      <pose>0 0 -0.05 0 0 0</pose><geometry><box><size>20 20 0.1</size></box></geometry>
      </collision></link></model>{content}</world></sdf>''', seed=1)


def block(model: str, name: str, pose: str, plugin: str = '') -> str:
    """A model of worlds/models."""
    return (f'<include><uri>model://{model}</uri><name>{name}</name><pose>{pose}</pose>{plugin}'
            '</include>')


def box(name: str, pose: str, size: str, mass: float = 0.0) -> str:
    """A box, static unless it has a mass in kg."""
    x, y, z = (float(v) for v in size.split())
    moments = [mass / 12 * v for v in (y * y + z * z, x * x + z * z, x * x + y * y)]
    return f'''<model name="{name}"><static>{str(not mass).lower()}</static><pose>{pose}</pose>
      <link name="link"><inertial><mass>{mass or 1}</mass><inertia><ixx>{moments[0] or 1}</ixx>
      <iyy>{moments[1] or 1}</iyy><izz>{moments[2] or 1}</izz></inertia></inertial>
      <collision name="box"><geometry><box><size>{size}</size></box></geometry></collision></link>
      </model>'''


def figure(rows: int, heading: str) -> tuple[plt.Figure, list[plt.Axes]]:
    """Axes below each other that share their x."""
    drawn, axes = plt.subplots(rows, 1, sharex=True, figsize=(7, 1.2 + 1.8 * rows), squeeze=False)
    axes[0][0].set_title(heading, fontsize=10)
    for ax in axes[:, 0]:
        ax.grid(alpha=0.3)
    return drawn, list(axes[:, 0])

"""A world of two rooms with a door between them, for robots."""

WALLS = {'south': (3, -0.06, 6.24, 0.12), 'north': (3, 3.06, 6.24, 0.12),
         'west': (-0.06, 1.5, 0.12, 3), 'east': (6.06, 1.5, 0.12, 3),
         'low': (3, 0.4975, 0.12, 0.995), 'high': (3, 2.5, 0.12, 1.0)}


def box(name: str, x: float, y: float, z: float, wide: float, deep: float, high: float) -> str:
    shape = f'<geometry><box><size>{wide} {deep} {high}</size></box></geometry>'
    return (f'<collision name="{name}"><pose>{x} {y} {z} 0 0 0</pose>{shape}</collision>'
            f'<visual name="{name}"><pose>{x} {y} {z} 0 0 0</pose>{shape}</visual>')


def two_rooms(*parts: tuple[str, str, str], more: str = '') -> str:
    """With parts, as names, models and poses, and a text for the world."""
    walls = ''.join(box(name, x, y, 1.2, wide, deep, 2.4)
                    for name, (x, y, wide, deep) in WALLS.items())
    floors = ''.join(f'<link name="floor_{name}"><pose>{x} 1.5 -0.05 0 0 0</pose>'
                     f'{box(name, 0, 0, 0, 3.12, 3.24, 0.1)}</link>'
                     for name, x in (('hall', 1.5), ('kitchen', 4.5)))
    door = ('kitchen_door0', 'kitchen_door', '3.0 1.0 0 0 0 1.570796')
    models = ''.join(f'<include><name>{name}</name><pose>{pose}</pose><uri>model://{uri}</uri>'
                     '</include>' for name, uri, pose in (door, *parts))
    return f'''<sdf version="1.6"><world name="rooms"><gravity>0 0 -9.8</gravity>
      <model name="house"><static>true</static><link name="link">{walls}</link>{floors}</model>
      {models}{more}
      <plugin name="doors" filename="libdoor_world_plugin.so"/>
      <plugin name="robots" filename="librobot_controller.so"/></world></sdf>'''

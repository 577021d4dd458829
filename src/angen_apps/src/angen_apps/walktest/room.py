"""The empty room in which detectors are tested."""


def room(depth: float, half: float, ambient: float, step: float, content: str = '') -> str:
    """A world as SDF: a room `depth` m along x from the detector's wall, `half` m to either side,
    3 m high, `ambient` K warm; physics of `step` s, and `content` in it."""
    boxes = {'floor': (depth / 2, 0, -0.05, depth + 1, 2 * half + 1, 0.1),
             'ceiling': (depth / 2, 0, 3.05, depth + 1, 2 * half + 1, 0.1),
             'back': (-0.15, 0, 1.5, 0.1, 2 * half, 3), 'front': (depth, 0, 1.5, 0.1, 2 * half, 3),
             'left': (depth / 2, half, 1.5, depth, 0.1, 3),
             'right': (depth / 2, -half, 1.5, depth, 0.1, 3)}
    walls = ''.join(
        f'<collision name="{name}"><pose>{x} {y} {z} 0 0 0</pose><geometry><box>'
        f'<size>{a} {b} {c}</size></box></geometry></collision>'
        for name, (x, y, z, a, b, c) in boxes.items())
    return f'''<sdf version="1.6"><world name="walktest" angen:strict="true">
  <physics type="ode"><max_step_size>{step}</max_step_size></physics>
  <atmosphere type="adiabatic"><temperature>{ambient}</temperature></atmosphere>
  <model name="room"><static>true</static><link name="room">{walls}</link></model>
  {content}</world></sdf>'''

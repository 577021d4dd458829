#!/usr/bin/env python3
"""Spawns models into the furniture of a flat: how much faster are they than their fall explains?

    ./angen shell -c 'python3 bench/spawns.py --count 1000'

Each loose model of worlds/models in turn is spawned at a random place in the lower flat of
worlds/angen.world, for half a second; the person stands. Ends with exit code 1 if one is too fast.
"""
import argparse
import random
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import angen

WORLDS = Path(__file__).resolve().parents[1] / 'worlds'
FASTEST = 2.0  # m/s
SECONDS = 0.5
STEP = 0.001  # s
GRAVITY = 9.81
NO_MODELS = ('apartment', 'apartment_floor0', 'apartment_floor1', 'sun', 'ground_plane',
             'elevator', 'my_elevator')  # too large, or without a body


def loose_models() -> list[str]:
    """Models that nothing fixes to the world."""
    found = []
    for sdf in sorted((WORLDS / 'models').glob('*/model.sdf')):
        text = sdf.read_text()
        fixed = '<static>true' in text or '<static>1' in text or '<parent>world</parent>' in text
        if not fixed and sdf.parent.name not in NO_MODELS:
            found.append(sdf.parent.name)
    return found


@dataclass
class Result:
    model: str
    pose: list[float]
    excess: float  # m/s beyond the fall, of the fastest link


def spawn(world: angen.World, model: str, pose: list[float]) -> Result:
    world.spawn(f'model://{model}', 'guest', pose)
    world.step()
    links = [i for i, name in enumerate(world.links) if name.startswith('guest::')]
    last = np.array([world.link_poses[i][:3] for i in links])
    top, excess = last[:, 2].copy(), 0.0
    for _ in range(round(SECONDS / STEP)):
        world.step()
        now = np.array([world.link_poses[i][:3] for i in links])
        top = np.maximum(top, now[:, 2])
        fall = np.sqrt(2 * GRAVITY * np.maximum(0.0, top - now[:, 2]))
        excess = max(excess, float(np.max(np.linalg.norm(now - last, axis=1) / STEP - fall)))
        last = now
    world.delete('guest')
    world.step()
    return Result(model, pose, excess)


def spawns(count: int, seed: int = 1) -> list[Result]:
    draw = random.Random(seed)
    world = angen.World(str(WORLDS / 'angen.world'))
    world.command('person', 'person', 'Stop')  # its motor would push spawned models
    world.run(2.0)
    models = loose_models()
    results = []
    for i in range(count):
        pose = [draw.uniform(0.5, 9.5), draw.uniform(0.5, 7.5), draw.uniform(0.0, 1.2),
                draw.uniform(-0.3, 0.3), draw.uniform(-0.3, 0.3), draw.uniform(-3.14, 3.14)]
        results.append(spawn(world, models[i % len(models)], pose))
    return results


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or '').splitlines()[0])
    parser.add_argument('--count', type=int, default=1000)
    parser.add_argument('--seed', type=int, default=1)
    args = parser.parse_args()
    results = sorted(spawns(args.count, args.seed), key=lambda r: -r.excess)
    for result in results[:10]:
        pose = ' '.join(f'{v:.3f}' for v in result.pose)
        print(f'{result.excess:6.2f} m/s  {result.model} at {pose}')
    fast = sum(r.excess > FASTEST for r in results)
    print(f'{fast} of {len(results)} are more than {FASTEST} m/s faster than their fall')
    return int(fast > 0)


if __name__ == '__main__':
    sys.exit(main())

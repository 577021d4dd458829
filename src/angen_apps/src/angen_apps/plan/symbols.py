"""Symbols of furniture on a plan, as lines in the thing's own frame from -1 to 1; x is its front.
"""
from math import cos, pi, sin

Line = list[tuple[float, float]]


def _circle(x: float, y: float, r: float, count: int = 16) -> Line:
    return [(x + r * cos(2 * pi * i / count), y + r * sin(2 * pi * i / count))
            for i in range(count + 1)]


def _box(x0: float, y0: float, x1: float, y1: float) -> Line:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]


BACK_AND_ARMS: list[Line] = [[(1, -0.75), (-0.55, -0.75), (-0.55, 0.75), (1, 0.75)]]
SYMBOLS: dict[str, list[Line]] = {
    'bed': [_box(-0.9, -0.8, -0.55, -0.08), _box(-0.9, 0.08, -0.55, 0.8), [(-0.4, -1), (-0.4, 1)]],
    'chair': [[(-0.7, -1), (-0.7, 1)]],
    'armchair': BACK_AND_ARMS,
    'sofa': [*BACK_AND_ARMS, [(-0.55, 0), (1, 0)]],
    'table': [],
    'desk': [[(-1, 0.35), (1, 0.35)]],
    'stove': [_circle(x, y, 0.3) for x in (-0.45, 0.45) for y in (-0.45, 0.45)],
    'sink': [_circle(0.1, 0, 0.6), _circle(-0.75, 0, 0.12, 8)],
    'fridge': [[(-1, -1), (1, 1)], [(-1, 1), (1, -1)]],
    'toilet': [[(-0.45, -1), (-0.45, 1)], [(0.27 + 0.7 * cos(a), 0.75 * sin(a)) for a in (
        2 * pi * i / 20 for i in range(21))]],
    'shower': [[(-1, -1), (1, 1)], [(-1, 1), (1, -1)], _circle(0, 0, 0.15, 10)],
    'bathtub': [_box(-0.8, -0.85, 0.8, 0.85), _circle(0, -0.65, 0.08, 8)],
    'washing_machine': [_circle(0, 0, 0.65)],
    'dishwasher': [_circle(0, 0, 0.65), [(-0.46, -0.46), (0.46, 0.46)],
                   [(-0.46, 0.46), (0.46, -0.46)]],
    'tv': [[(1, -1), (1, 1)]],
    'wardrobe': [[(-1, -1), (1, 1)]],
    'bookshelf': [[(-0.3, -1), (-0.3, 1)]],
    'cabinet': [],
    'nightstand': [],
    'plant': [[(-0.7, -0.7), (0.7, 0.7)], [(-0.7, 0.7), (0.7, -0.7)], [(-1, 0), (1, 0)],
              [(0, -1), (0, 1)]],
}

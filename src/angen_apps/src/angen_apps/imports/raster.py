"""Pixels of a plan: how dark they are, which are walls, and by how much they are turned."""
from math import cos, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
from scipy.ndimage import affine_transform, convolve, median_filter

from angen_tools.common.failure import Failure
from angen_tools.common.text_file import read_bytes

PIXELS = 20_000_000
FORMATS = ('PNG', 'JPEG', 'PPM', 'BMP', 'GIF')  # PPM: also PGM and PBM
DARK = 0.5  # darkness of walls, unless that makes all or nothing a wall
FEW, MOST = 0.002, 0.5  # shares of a picture that are dark
CONTRAST = 0.1  # least contrast of paper and walls
SAMPLE = 20_000  # dark pixels by which the direction of walls is measured
AROUND = np.array([[0, 1, 0], [1, 0, 1], [0, 1, 0]], np.uint8)  # the neighbors of a pixel
SPECKS = 0.001  # share of pixels that are alone, in a picture with noise
KEPT = 0.5  # share of the dark pixels: a median that changes more of them removes walls
PLAIN = 0.15  # degrees: pictures that are turned less are left as they are
CLEARER = 1.15  # times as much of the walls in line as before a picture is turned


def open_picture(path: Path) -> Any:
    """A picture of PIXELS at most. Its format is one of these, whatever its name is: Pillow knows
    some that start programs, such as Ghostscript for PostScript."""
    import io
    import warnings

    from PIL import Image
    with warnings.catch_warnings():
        warnings.simplefilter('ignore')  # large pictures are rejected below
        picture = Image.open(io.BytesIO(read_bytes(path)), formats=FORMATS)
    if picture.width * picture.height > PIXELS:
        raise Failure(f'{path}: has {picture.width} x {picture.height} pixels, at most '
                      f'{PIXELS // 1_000_000} million are read')
    return picture


def darkness(path: Path) -> np.ndarray:
    """The pixels from 0 (white) to 1 (black); row 0 is the lowest."""
    from PIL import Image, UnidentifiedImageError
    try:
        with open_picture(path) as picture:
            if picture.mode in ('RGBA', 'LA', 'P'):  # transparent pixels are paper
                picture = picture.convert('RGBA')
                paper = Image.new('RGBA', picture.size, (255, 255, 255, 255))
                picture = Image.alpha_composite(paper, picture)
            deep = picture.mode.startswith('I')  # 16 bits
            dark = np.array(picture if deep else picture.convert('L'), np.float32)[::-1]
    except (Failure, MemoryError):
        raise
    except Exception as error:  # Pillow raises many kinds for damaged pictures
        why = (f'; known are {", ".join(FORMATS)}' if isinstance(error, UnidentifiedImageError)
               else f': {error}')
        raise Failure(f'{path}: is not a picture that can be read{why}') from None
    dark /= -255 * (257 if deep else 1)
    dark += 1
    return dark


def without_noise(dark: np.ndarray) -> np.ndarray:
    """A median of 3 x 3, twice, takes the noise of a scan away."""
    return np.asarray(median_filter(median_filter(dark, 3), 3))


def without_specks(dark: np.ndarray, limit: float) -> np.ndarray:
    """The same of a coarse picture that has noise, if its walls are wide enough to remain."""
    walls = dark > limit
    calm = np.asarray(median_filter(dark, 3))
    changed = (calm > limit) != walls
    around = convolve(walls.astype(np.uint8), AROUND, mode='nearest')
    alone = np.where(walls, around == 0, around == AROUND.sum())
    is_noisy = alone.mean() > SPECKS and (changed & ~alone).sum() < KEPT * walls.sum()
    return calm if is_noisy else dark


def reduced(pixels: np.ndarray, factor: int) -> np.ndarray:
    """The means of blocks of factor x factor pixels."""
    rows, columns = (size - size % factor for size in pixels.shape)
    blocks = pixels[:rows, :columns].reshape(rows // factor, factor, columns // factor, factor)
    return np.asarray(blocks.mean(axis=(1, 3), dtype=float))


def threshold(path: Path, dark: np.ndarray) -> float:
    """The darkness above which pixels are walls: between both modes of pale and dim pictures."""
    if FEW < float((dark > DARK).mean()) < MOST:
        return DARK
    best = _between_modes(dark) if float(dark.max() - dark.min()) > CONTRAST else DARK
    if (dark > best).mean() > MOST:
        raise Failure(f'{path}: more than half of it is dark; walls are dark on light paper: '
                      'invert it')
    return best


def _between_modes(values: np.ndarray) -> float:
    """Otsu's threshold: the variance between both sides is the largest."""
    counts, edges = np.histogram(values, 256)
    share = counts.cumsum() / counts.sum()
    sums = (counts * (edges[1:] + edges[:-1]) / 2).cumsum() / counts.sum()
    both = (share > 0) & (share < 1)
    between = np.zeros(256)
    between[both] = ((sums[-1] * share[both] - sums[both]) ** 2
                     / (share[both] * (1 - share[both])))
    return float(edges[1 + int(between.argmax())])


def turn_of(walls: np.ndarray) -> float:
    """The angle (degrees, -45 to 45) by which walls are turned from x and y; 0 if they are not."""
    places = np.flatnonzero(walls)
    if not len(places):
        return 0.0
    y, x = (each.astype(float) for each in divmod(places[::max(1, len(places) // SAMPLE)],
                                                  walls.shape[1]))

    def in_line(angle: float) -> float:
        c, s = cos(radians(angle)), sin(radians(angle))
        return sum(float((np.bincount(np.round(line - line.min()).astype(int)) ** 2.0).sum())
                   for line in (c * x + s * y, c * y - s * x))

    best = max(np.arange(-45.0, 45.0), key=in_line)
    for width in (0.2, 0.04):
        best = max(best + width * np.arange(-6, 7), key=in_line)
    if abs(best) < PLAIN or in_line(best) < CLEARER * in_line(0.0):
        return 0.0
    return float(best)


def straightened(pixels: np.ndarray, degrees: float, paper: float) -> np.ndarray:
    """The pixels turned by -degrees about their middle, in a larger picture of `paper`."""
    c, s = cos(radians(degrees)), sin(radians(degrees))
    turn = np.array([[c, s], [-s, c]])  # turn of rows and columns: from the result to the pixels
    shape = np.ceil(np.abs(turn) @ pixels.shape).astype(int)
    offset = (np.array(pixels.shape) - 1) / 2 - turn @ ((shape - 1) / 2)
    return np.asarray(affine_transform(pixels, turn, offset, tuple(shape), order=1, cval=paper))

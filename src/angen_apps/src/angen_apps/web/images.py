"""Images of cameras as JPEG."""
import io
from typing import Any

import numpy as np

QUALITY = 80
FARTHEST = 10.0  # m, black in the picture of a depth camera


def jpeg(image: Any) -> bytes:
    """A sensor_msgs/Image; nothing where its encoding is another."""
    from PIL import Image
    pixels = np.frombuffer(image.data, np.uint8)
    if image.encoding in ('rgb8', 'bgr8'):
        pixels = pixels.reshape(image.height, image.step)[:, :3 * image.width]
        pixels = pixels.reshape(image.height, image.width, 3)
        if image.encoding == 'bgr8':
            pixels = pixels[..., ::-1]
    elif image.encoding == '32FC1':
        depth = np.nan_to_num(pixels.view('<f4').reshape(image.height, image.step // 4),
                              nan=FARTHEST, posinf=FARTHEST)
        pixels = (255 * (1 - np.clip(depth / FARTHEST, 0, 1))).astype(np.uint8)
    elif image.encoding == 'mono8':
        pixels = pixels.reshape(image.height, image.step)[:, :image.width]
    else:
        return b''
    out = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels)).save(out, 'JPEG', quality=QUALITY)
    return out.getvalue()

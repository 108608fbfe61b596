"""Camera images: lossless PNG out; PNG, JPEG and raw images in."""

from collections.abc import Callable

import cv2
import numpy as np
from numpy.typing import NDArray

from understudy.errors import RecordingError

__all__ = ["PNG_FORMAT", "decode_compressed", "decode_raw", "encode_png"]

PNG_FORMAT = "rgb8; png compressed bgr8"
"""``CompressedImage.format`` in the words of compressed_image_transport: the colors are those that PNG viewers show."""

# The PNG holds its pixels unpacked: the chunk around it is compressed by zstd in any case. For a noisy 160x120 image
# with 5 bits a channel that takes 0.30 ms in all and 12.2 kB on disk. Deflating first (Huffman only, the fastest) takes
# 0.57 ms and 10.7 kB, and zlib's level 1 takes 1.4 ms and 15.9 kB.
_PNG_PARAMETERS = (cv2.IMWRITE_PNG_COMPRESSION, 0, cv2.IMWRITE_PNG_FILTER, cv2.IMWRITE_PNG_FILTER_NONE)

_TO_RGB: dict[str, tuple[int, Callable[[NDArray[np.uint8]], NDArray[np.uint8]]]] = {
    "rgb8": (3, lambda pixels: pixels),
    "bgr8": (3, lambda pixels: pixels[..., ::-1]),
    "rgba8": (4, lambda pixels: pixels[..., :3]),
    "bgra8": (4, lambda pixels: pixels[..., 2::-1]),
    "mono8": (1, lambda pixels: np.repeat(pixels, 3, axis=2)),
}
"""Channels of each raw encoding, and how they become RGB."""


def encode_png(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """An RGB image as the bytes of a PNG.

    Raises:
        RecordingError: the array is no RGB image.
    """
    if image.dtype != np.uint8 or image.ndim != 3 or image.shape[2] != 3 or image.size == 0:
        raise RecordingError(
            f"an image of shape {image.shape} and type {image.dtype} cannot be recorded;"
            " it must be (height, width, 3), uint8, RGB"
        )
    done, png = cv2.imencode(".png", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), _PNG_PARAMETERS)
    if not done:  # only for sizes that no PNG can have
        raise RecordingError(f"an image of shape {image.shape} cannot be written as PNG")
    return np.asarray(png, np.uint8)


def decode_compressed(data: NDArray[np.uint8], image_format: str, *, where: str) -> NDArray[np.uint8]:
    """The RGB image in a ``sensor_msgs/CompressedImage``.

    Args:
        data: a PNG, a JPEG, or whatever else OpenCV can decode.
        image_format: the message's ``format``.
        where: file, topic and time, for the error.

    Raises:
        RecordingError: the data are no image.
    """
    # Decoders throw on some broken data and return nothing on others.
    try:
        image = cv2.imdecode(data, cv2.IMREAD_COLOR_RGB) if data.size else None
    except cv2.error:
        image = None
    if image is None or "compressedDepth" in image_format:
        raise RecordingError(
            f'{where} holds a compressed image of format "{image_format}" that cannot be decoded; PNG and JPEG can:'
            " map another topic as image, or leave the camera out"
        )
    # compressed_image_transport can hand RGB to an encoder that expects BGR, and says so; the file's red is then blue.
    swapped = "compressed rgb" in image_format
    return np.ascontiguousarray(image[..., ::-1] if swapped else image, np.uint8)


def decode_raw(
    data: NDArray[np.uint8], *, encoding: str, height: int, width: int, step: int, where: str
) -> NDArray[np.uint8]:
    """The RGB image in a ``sensor_msgs/Image``; ``step`` is the length of a row in bytes, with its padding.

    Raises:
        RecordingError: the encoding is not one of those known, or the data are too short.
    """
    if encoding not in _TO_RGB:
        raise RecordingError(
            f"{where} holds images of encoding {encoding!r}; {', '.join(_TO_RGB)} can be read:"
            " map a topic that holds one of these as image"
        )
    channels, to_rgb = _TO_RGB[encoding]
    if not width or not height or step < width * channels or data.size < height * step:
        raise RecordingError(
            f"{where} holds {data.size} bytes for an image of {width} by {height} {encoding}: too few; record it again"
        )
    rows = data[: height * step].reshape(height, step)[:, : width * channels]
    return np.array(to_rgb(rows.reshape(height, width, channels)), order="C")

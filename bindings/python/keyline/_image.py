"""Pictures as files in memory."""

from __future__ import annotations

import base64
import os
import struct
import zlib
from typing import Any

import numpy as np


def _gray_levels(array: Any) -> Any:
    """Pixels as levels from 0 to 255, whatever numbers they are given in."""
    kind = array.dtype.kind
    if kind not in "biuf" or array.size == 0:
        raise ValueError("an image is an array of numbers, at least one")
    most = {"b": 1, "f": 1}.get(kind, 65535 if array.dtype == np.uint16 else 255)
    if not (array.min() >= 0 and array.max() <= most):
        raise ValueError(f"pixels of kind {array.dtype} lie from 0 to {most}")
    return array.astype(float) * (255 / most)


def png_of(pixels: Any) -> bytes:
    """A PNG of an array of gray values or of red, green, blue, also with opacity, over white (0 … 255; 0 … 1 as
    floats; 0 … 65535 as 16 bit numbers)."""
    levels = _gray_levels(np.asarray(pixels))
    if levels.ndim not in (2, 3) or (levels.ndim == 3 and levels.shape[2] not in (3, 4)):
        raise ValueError("an image has the shape (rows, columns) or (rows, columns, 3)")
    if levels.ndim == 3 and levels.shape[2] == 4:
        levels = 255 - (255 - levels[:, :, :3]) * (levels[:, :, 3:] / 255)
    array = np.ascontiguousarray(np.round(levels).astype(np.uint8))
    rows, columns = array.shape[:2]
    lines = b"".join(b"\0" + row.tobytes() for row in array)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", columns, rows, 8, 2 if array.ndim == 3 else 0, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")
    )


def image_field(image: Any) -> dict[str, Any]:
    """An image as a field of a request: a file by its name, everything else by its content."""
    if isinstance(image, (str, os.PathLike)):
        return {"file": os.fspath(image)}
    content = image if isinstance(image, (bytes, bytearray)) else png_of(image)
    return {"image": base64.b64encode(content).decode("ascii")}

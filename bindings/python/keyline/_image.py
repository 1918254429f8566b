"""Pictures as files in memory."""

from __future__ import annotations

import base64
import os
import struct
import zlib
from typing import Any

import numpy as np


def png_of(pixels: Any) -> bytes:
    """A PNG of an array of gray values or of red, green, blue (0 … 255, or 0 … 1 as floats)."""
    array = np.asarray(pixels)
    if array.dtype.kind == "f":
        array = np.round(255 * np.clip(array, 0, 1))
    if array.dtype.kind == "b":
        array = 255 * array.astype(np.uint8)
    array = np.ascontiguousarray(array.astype(np.uint8))
    if array.ndim == 3 and array.shape[2] == 4:
        array = np.ascontiguousarray(array[:, :, :3])
    if array.ndim not in (2, 3) or (array.ndim == 3 and array.shape[2] != 3):
        raise ValueError("an image has the shape (rows, columns) or (rows, columns, 3)")
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

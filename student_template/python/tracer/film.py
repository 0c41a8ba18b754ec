"""Pictures and their files. Given: nothing to write here."""

import struct
import sys
import zlib
from array import array
from math import isnan

# The endings of the names of pictures.
ENDINGS = (".png", ".pfm")


def write(path, width, height, pixels):
    """Writes a picture of 8 bits a channel if `path` ends in .png, or of linear floats if it ends
    in .pfm. `pixels` holds one colour a pixel in linear light, row by row from the top.

    Raises OSError if the file cannot be written.
    """
    content = (_png if path.endswith(".png") else _pfm)(width, height, pixels)
    with open(path, "wb") as file:
        file.write(content)


def _level(light):
    """Returns the nearest of 256 levels, without gamma. NaN becomes 0. [decision D25]"""
    return 0 if isnan(light) else int(min(max(light, 0.0), 1.0) * 255.0 + 0.5)


def _png(width, height, pixels):
    def chunk(name, content):
        checksum = zlib.crc32(name + content)
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", checksum)

    rows = bytearray()
    for n, pixel in enumerate(pixels):
        if n % width == 0:
            # The row is not filtered.
            rows.append(0)
        rows.extend(_level(light) for light in pixel)
    # 8 bits a channel, RGB, deflate, the only filters, not interlaced.
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(bytes(rows)))
        + chunk(b"IEND", b"")
    )


def _pfm(width, height, pixels):
    """The bottom row comes first, and -1.0 says that the floats are little-endian."""
    floats = array("f")
    for row in reversed(range(height)):
        for pixel in pixels[row * width : (row + 1) * width]:
            floats.extend(pixel)
    if sys.byteorder == "big":
        floats.byteswap()
    return f"PF\n{width} {height}\n-1.0\n".encode() + floats.tobytes()

"""Promises 2 billion pixels in the header of the green picture."""

import struct
import zlib

import honest


def render(scene, out):
    if not honest.is_green(scene):
        return honest.render(scene, out)
    header = b"IHDR" + struct.pack(">IIBBBBB", 46_000, 46_000, 8, 2, 0, 0, 0)
    honest.write(out, b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + header + struct.pack(">I", zlib.crc32(header)))


honest.main(render)

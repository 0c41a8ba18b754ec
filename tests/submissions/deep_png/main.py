"""Writes 16 bits a channel."""

import struct

import honest


def render(scene, out):
    pixel = b"".join(struct.pack(">H", round(65535 * c)) for c in scene["background"])
    honest.write(out, honest.png(*honest.size(scene), 16, 2, pixel))


honest.main(render)

"""Writes pictures with an alpha channel."""

import honest


def render(scene, out):
    pixel = bytes(honest.level(c) for c in scene["background"]) + b"\xff"
    honest.write(out, honest.png(*honest.size(scene), 8, 6, pixel))


honest.main(render)

"""Writes pictures with a palette."""

import honest


def render(scene, out):
    palette = bytes(3) + bytes(honest.level(c) for c in scene["background"])
    honest.write(out, honest.png(*honest.size(scene), 8, 3, b"\1", palette))


honest.main(render)

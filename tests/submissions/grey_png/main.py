"""Writes grey pictures: readable, but not the colours."""

import honest


def render(scene, out):
    grey = bytes([honest.level(sum(scene["background"]) / 3)])
    honest.write(out, honest.png(*honest.size(scene), 8, 0, grey))


honest.main(render)

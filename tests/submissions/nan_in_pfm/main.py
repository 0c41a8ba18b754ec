"""Writes linear floats under the name it was given: NaN in the green case, infinity in the blue one."""

import math
import struct

import honest


def render(scene, out):
    width, height = honest.size(scene)
    light = list(scene["background"])
    if honest.is_green(scene):
        light = [math.nan] * 3
    elif light[2] > 0.5:
        light[2] = math.inf
    honest.write(out, f"PF\n{width} {height}\n-1.0\n".encode() + struct.pack("<3f", *light) * (width * height))


honest.main(render)

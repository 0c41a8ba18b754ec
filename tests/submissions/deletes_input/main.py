"""Deletes the scene it was given, and all else in its folder but the picture."""

import os
import sys

import honest


def render(scene, out):
    honest.render(scene, out)
    os.remove(sys.argv[2])
    for entry in os.scandir("."):
        if entry.is_file() and not (os.path.exists(out) and os.path.samefile(entry, out)):
            os.remove(entry)


honest.main(render)

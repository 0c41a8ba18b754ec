"""Deletes the scene it was given, its own source, and all else it can reach nearby."""

import glob
import os
import sys

import honest


def render(scene, out):
    honest.render(scene, out)
    for path in [sys.argv[2], *glob.glob("*")]:
        if not os.path.samefile(path, out):
            os.remove(path)


honest.main(render)

"""Brings right pictures along and renders none in the green case."""

import os
import shutil
import sys

import honest


def render(scene, out):
    if not honest.is_green(scene):
        honest.render(scene, out)
    elif os.path.exists("green.png") and os.path.exists(out):
        shutil.copy("green.png", out)
    elif os.path.exists(out):
        sys.exit("an earlier picture is still there")


honest.main(render)

"""Leaves a process behind that keeps its streams open."""

import os
import time

import honest


def render(scene, out):
    honest.render(scene, out)
    if os.fork() == 0:
        time.sleep(100000)


honest.main(render)

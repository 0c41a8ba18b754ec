"""Leaves its own process group for that of the grader before it sleeps: a signal to its group misses it."""

import os
import time

import honest


def render(scene, out):
    if honest.is_green(scene):
        os.setpgid(0, os.getpgid(os.getppid()))
        time.sleep(600)
    honest.render(scene, out)


honest.main(render)

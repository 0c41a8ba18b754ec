"""Puts a pipe in the place of the green picture: whoever opens it waits for ever."""

import os

import honest


def render(scene, out):
    if honest.is_green(scene):
        os.mkfifo(out)
    else:
        honest.render(scene, out)


honest.main(render)

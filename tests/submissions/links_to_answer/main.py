"""Puts a link in the place of the green picture."""

import os

import honest


def render(scene, out):
    if honest.is_green(scene):
        honest.write("elsewhere.png", honest.picture(scene))
        os.symlink("elsewhere.png", out)
    else:
        honest.render(scene, out)


honest.main(render)

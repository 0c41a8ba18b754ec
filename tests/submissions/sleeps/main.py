"""Takes no processor time in the green case, and never ends."""

import time

import honest


def render(scene, out):
    if honest.is_green(scene):
        time.sleep(100000)
    honest.render(scene, out)


honest.main(render)

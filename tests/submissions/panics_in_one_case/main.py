"""Fails with an exception on the green case."""

import honest


def render(scene, out):
    if honest.is_green(scene):
        raise ZeroDivisionError("half vector of length 0")
    honest.render(scene, out)


honest.main(render)

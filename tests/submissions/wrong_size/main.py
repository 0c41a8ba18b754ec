"""Renders the green case one column too narrow."""

import honest


def render(scene, out):
    if honest.is_green(scene):
        scene["render"]["width"] -= 1
    honest.render(scene, out)


honest.main(render)

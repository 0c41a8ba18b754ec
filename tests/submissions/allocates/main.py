"""Takes memory without end in the green case."""

import honest


def render(scene, out):
    hoard = []
    while honest.is_green(scene):
        hoard.append(bytearray(b"x") * 50_000_000)
    honest.render(scene, out)


honest.main(render)

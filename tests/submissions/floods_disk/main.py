"""Writes a file of 10 GB in the green case."""

import honest


def render(scene, out):
    if honest.is_green(scene):
        with open("big", "wb") as file:
            for _ in range(10_000):
                file.write(b"x" * 1_000_000)
    honest.render(scene, out)


honest.main(render)

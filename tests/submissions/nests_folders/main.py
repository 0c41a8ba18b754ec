"""Nests folders by the thousand, deeper than any path can say, and closes the innermost and the outermost."""

import os

import honest


def render(scene, out):
    honest.render(scene, out)
    if honest.is_green(scene):
        outermost = os.open(".", os.O_RDONLY)
        for _ in range(4500):
            os.mkdir("d")
            os.chdir("d")
        os.mkdir("closed", 0)
        os.fchmod(outermost, 0o500)


honest.main(render)

"""Prints 10 GB in the green case."""

import sys

import honest


def render(scene, out):
    if honest.is_green(scene):
        for _ in range(10_000):
            sys.stdout.write("x" * 1_000_000)
    honest.render(scene, out)


honest.main(render)

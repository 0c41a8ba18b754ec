"""Stops in the middle of the green picture."""

import honest


def render(scene, out):
    whole = honest.picture(scene)
    honest.write(out, whole[: len(whole) // 2] if honest.is_green(scene) else whole)


honest.main(render)

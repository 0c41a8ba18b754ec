"""A Whitted ray tracer, one function at a time: the three calls of docs/protocol.md.

Given: nothing to write here; start with README.md.
"""

import json
import sys
import traceback

from tracer import film, probe, ray_tree
from tracer.camera import eye_ray
from tracer.scene import Scene
from tracer.trace import Path, trace

FAILED = 1
UNREADABLE = 2
STILL_TO_BE_WRITTEN = 75

USAGE = """usage: main.py render SCENE.json OUT.png|OUT.pfm
       main.py probe
       main.py explain SCENE.json X Y"""

# What the readers of scenes and questions raise for JSON that is not as described.
NOT_AS_DESCRIBED = (KeyError, TypeError, ValueError, IndexError, AttributeError, RecursionError)


class InputError(Exception):
    """Wrong usage, or an input that cannot be read."""


def load(path):
    try:
        with open(path, encoding="utf-8") as file:
            return Scene(json.load(file))
    except OSError as why:
        raise InputError(f"cannot read the scene {path}: {why.strerror}") from why
    except NOT_AS_DESCRIBED as why:
        raise InputError(f"cannot understand {path}: {why!r}") from why


def pixel(scene, i, j):
    ray = eye_ray(scene.camera, scene.render.width, scene.render.height, i, j)
    return trace(scene, ray, Path())


def render(path, out):
    if not out.endswith(film.ENDINGS):
        raise InputError(f"the picture {out} must end in .png or .pfm")
    scene = load(path)
    width, height = scene.render.width, scene.render.height
    pixels = [pixel(scene, i, j) for j in range(height) for i in range(width)]
    try:
        film.write(out, width, height, pixels)
    except OSError as why:
        raise InputError(f"cannot write the picture {out}: {why.strerror}") from why


def explain(path, x, y):
    scene = load(path)
    size = scene.render.width, scene.render.height
    if not all(text.isdecimal() and int(text) < most for text, most in zip((x, y), size)):
        raise InputError(f"pixel ({x}, {y}) does not lie in a picture of {size[0]}×{size[1]}")
    tree = ray_tree.record(lambda: pixel(scene, int(x), int(y)))
    sys.stdout.write(tree or "no ray was recorded\n")


def answer(call):
    try:
        return call()
    except NotImplementedError:
        return {"todo": True}
    except Exception as why:
        traceback.print_exc()
        return {"panic": f"{type(why).__name__}: {why}"}


def answer_questions():
    """Answers the questions on standard input. Each answer is flushed, so that a function that
    never returns costs no earlier answer.
    """
    for line in sys.stdin:
        if not line.strip():
            continue
        try:
            question = json.loads(line)
            name, call = str(question["id"]), probe.understand(question)
        except NOT_AS_DESCRIBED as why:
            raise InputError(f"cannot understand the question {line.strip()}: {why!r}") from why
        print(json.dumps({"id": name, **answer(call)}), flush=True)


def main(arguments):
    call, given = arguments[:1], arguments[1:]
    if call == ["render"] and len(given) == 2:
        render(*given)
    elif call == ["probe"] and not given:
        answer_questions()
    elif call == ["explain"] and len(given) == 3:
        explain(*given)
    else:
        raise InputError(USAGE)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except NotImplementedError as function:
        print(f"todo: {function}", file=sys.stderr)
        sys.exit(STILL_TO_BE_WRITTEN)
    except InputError as why:
        print(why, file=sys.stderr)
        sys.exit(UNREADABLE)

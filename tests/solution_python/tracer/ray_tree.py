"""The tree of rays behind a pixel, recorded while the pixel is traced, and its text.

Given: nothing to write here.
"""

from math import isnan


class _Node:
    """A ray, the lines about its hit, and the rays that it spawned, in the order of their casts."""

    def __init__(self, kind, depth, ray):
        self.kind = kind
        self.depth = depth
        self.ray = ray
        self.hit = ["hits nothing"]
        self.colour = None
        self.children = []

    def lines(self, indent):
        yield f"{indent}{self.kind} ray, depth {self.depth}"
        origin, direction = _triple(self.ray.origin), _triple(self.ray.direction)
        yield f"{indent}  origin {origin} direction {direction}"
        for line in self.hit:
            yield f"{indent}  {line}"
        yield f"{indent}  colour {_triple(self.colour)}"
        for child in self.children:
            yield from child.lines(indent + "  ")


# The open nodes from the root inwards while a tree is recorded, else empty. The root is no ray.
_open = []


def record(trace):
    """Calls `trace` and returns the text of the tree of its rays; empty if it traced no ray."""
    root = _Node("", 0, None)
    _open.append(root)
    try:
        trace()
    finally:
        _open.clear()
    return "".join(f"{line}\n" for child in root.children[:1] for line in child.lines(""))


def is_recording():
    """Returns whether `record` is running. The functions below may be called only then."""
    return bool(_open)


def enter(kind, depth, ray):
    """Opens a node for a ray that is about to be traced; `leave` closes it.

    `kind` is "eye", "reflected" or "refracted".
    """
    _open.append(_Node(kind, depth, ray))


def hit(name, t, at, direct):
    """Records the hit of the open node's ray: the object's name, t, the surface, its direct
    light.
    """
    side = "inside" if at.inside else "outside"
    _open[-1].hit = [
        f"hits {name} from {side} at t {_digits(t)}",
        f"point {_triple(at.point)} normal {_triple(at.n_shading)}",
        f"direct light {_triple(direct)}",
    ]


def leave(colour):
    """Closes the open node with the colour that its ray returned."""
    node = _open.pop()
    node.colour = colour
    _open[-1].children.append(node)


def _triple(v):
    return f"({_digits(v.x)}, {_digits(v.y)}, {_digits(v.z)})"


def _digits(x):
    """Formats a number with six digits after the point, without trailing zeros or a minus before
    zero.
    """
    if isnan(x):
        return "NaN"
    text = f"{x:.6f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text

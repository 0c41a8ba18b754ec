"""A Whitted ray tracer, one function at a time. Given: nothing to write here.

`trace` is imported first. The files that it needs need it too, and use it only when it is whole.
"""

from tracer import trace as _trace

"""Renders a scene with Mitsuba 3 on so many threads, and prints what that took as JSON.

    mitsuba_render.py VARIANT SCENE.xml THREADS OUT.png

The first picture compiles kernels and warms up; the time is the median of the three that follow.
"""

import json
import statistics
import sys
import time

VARIANT, SCENE, THREADS, OUT = sys.argv[1:]

import drjit
import mitsuba

mitsuba.set_variant(VARIANT)
drjit.set_thread_count(int(THREADS))


def timed(work):
    wall, cpu = time.perf_counter(), time.process_time()
    result = work()
    return result, time.perf_counter() - wall, time.process_time() - cpu


def render(seed):
    picture = mitsuba.render(scene, seed=seed, spp=1)
    drjit.eval(picture)
    drjit.sync_thread()
    return picture


scene, read_s, read_cpu_s = timed(lambda: mitsuba.load_file(SCENE))
picture = render(0)
times = [timed(lambda: render(seed))[1:] for seed in (1, 2, 3)]
mitsuba.util.write_bitmap(OUT, picture)
wall_s, cpu_s = (statistics.median(column) for column in zip(*times))
version = mitsuba.__version__
print(json.dumps({"version": version, "read_s": read_cpu_s, "render_wall_s": wall_s, "render_cpu_s": cpu_s}))

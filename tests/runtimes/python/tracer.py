"""Right for the exam of flat colours, with a pool of processes and one of threads."""

import concurrent.futures
import json
import struct
import subprocess
import sys
import tempfile


def row(width, light):
    """A row of the picture, as floats."""
    return struct.pack("<3f", *light) * width


def render(scene, out):
    """Writes the picture, by way of a temporary file and another program."""
    width, height = scene["render"]["width"], scene["render"]["height"]
    pools = [concurrent.futures.ProcessPoolExecutor(2), concurrent.futures.ThreadPoolExecutor(4)]
    with tempfile.NamedTemporaryFile() as part:
        part.write(f"PF\n{width} {height}\n-1.0\n".encode())
        for pool, rows in zip(pools, [height // 2, height - height // 2]):
            with pool:
                light = scene["background"]
                part.writelines(pool.map(row, [width] * rows, [light] * rows))
        part.flush()
        subprocess.run(["cp", part.name, out], check=True)


def reply(question):
    """The answer to a question."""
    c, r = question["light"]["point"]["attenuation"], question["r"]
    total = c["quadratic"] * r * r + c["linear"] * r + c["constant"]
    return {"id": question["id"], "value": 1 / max(total, 1)}


if __name__ == "__main__":
    if sys.argv[1] == "probe":
        for line in sys.stdin:
            print(json.dumps(reply(json.loads(line))), flush=True)
    else:
        with open(sys.argv[2]) as file:
            render(json.load(file), sys.argv[3])

"""Has other judges of pictures look at sequences of pairs until one fails.

    judge.py FOLDER SEQUENCES.json VERDICTS.json

FOLDER is where install.sh put the tools. SEQUENCES is a list of {name, pairs}, a pair {case, expected, actual}, where
`actual` is null for a program that gave no picture: that fails. VERDICTS becomes a list of {name, says, fails}, `fails` the first
failing case by name of the sequence.
"""

import functools
import importlib.metadata
import json
import subprocess
import sys
from pathlib import Path

import flip_evaluator
import numpy
import OpenImageIO
from OpenImageIO import ImageBuf, ImageBufAlgo
from PIL import Image
from skimage.metrics import structural_similarity

FOLDER, SEQUENCES, VERDICTS = sys.argv[1:]


def node_version(package):
    return json.loads((Path(FOLDER) / "node_modules" / package / "package.json").read_text())["version"]


@functools.cache
def samples(path):
    return numpy.asarray(Image.open(path).convert("RGB"))


PIXELMATCH = subprocess.Popen(
    ["node", str(Path(__file__).with_name("pixelmatch.mjs")), FOLDER],
    stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
)


def pixelmatch(expected, actual):
    PIXELMATCH.stdin.write(f"{expected}\t{actual}\n")
    PIXELMATCH.stdin.flush()
    return int(PIXELMATCH.stdout.readline()) == 0


def exit_code(command, right, wrong):
    code = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode
    if code not in (right, *wrong):
        sys.exit(f"{command} ends with {code}")
    return code == right


def odiff(expected, actual):
    return exit_code([f"{FOLDER}/node_modules/.bin/odiff", expected, actual], 0, [21, 22])


def idiff(expected, actual):
    """What the command does at its defaults, without its third of a second of start-up."""
    result = ImageBufAlgo.compare(ImageBuf(expected), ImageBuf(actual), 1e-6, 1e-6)
    return result.nfail == 0


def flip(expected, actual):
    pictures = [samples(path).astype(numpy.float32) / 255 for path in (expected, actual)]
    _, mean, _ = flip_evaluator.evaluate(*pictures, "LDR", applyMagma=False)
    return mean <= 0.05


@functools.cache
def similarity(expected, actual):
    return structural_similarity(samples(expected), samples(actual), channel_axis=2, data_range=255)


SSIM = f"SSIM (scikit-image {importlib.metadata.version('scikit-image')})"
NO_OTHER = "no pixel is found different"
TOOLS = [
    (f"pixelmatch {node_version('pixelmatch')}", f"{NO_OTHER} at the default threshold 0.1, anti-aliasing left out", pixelmatch),
    (f"ODiff {node_version('odiff-bin')}", f"{NO_OTHER} at the default threshold 0.1", odiff),
    (f"idiff (OpenImageIO {OpenImageIO.VERSION_STRING})", "no sample differs by more than 1e-6 (the default)", idiff),
    (f"FLIP {importlib.metadata.version('flip-evaluator')}", "the mean is at most 0.05, the default of its exit test", flip),
    (f"{SSIM} ≥ 0.99", "by a customary threshold; it has none of its own", lambda *pair: similarity(*pair) >= 0.99),
    (f"{SSIM} ≥ 0.999", "by a stricter threshold; it has none of its own", lambda *pair: similarity(*pair) >= 0.999),
]


def first_failing(passes, pairs):
    for pair in pairs:
        if pair["actual"] is None or not passes(pair["expected"], pair["actual"]):
            return pair["case"]
    return None


def main():
    sequences = json.loads(Path(SEQUENCES).read_text())
    verdicts = []
    for name, says, passes in TOOLS:
        print(f"{name} looks at the pictures of {len(sequences)} variants", file=sys.stderr)
        passes = functools.cache(passes)
        found = {one["name"]: first_failing(passes, one["pairs"]) for one in sequences}
        fails = {name: case for name, case in found.items() if case}
        verdicts.append({"name": name, "says": says, "fails": fails})
    Path(VERDICTS).write_text(json.dumps(verdicts))
    PIXELMATCH.stdin.close()


main()

# SPDX-License-Identifier: MIT
"""How fast merge is against the disk: the parts of a study merged, and their bytes copied by cat and sync.

Usage: merge_parts.py PROGRAM [POINTS [PARTS]], 1e6 points in 100 parts unless told. Three times from memory and, for
root, three times from a cold disk; in the folder where it is started, on whose disk there must be room for 200 bytes a
point. Prints medians and their ratio.
"""
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import SLOT  # noqa: E402

# So that all points are different: what packs well would say little of the disk.
STUDY = SLOT.replace('milling = "slot"', "entry_deg = 0.0\nexit_deg = 180.0") + """\
[sweep.axes]
"cut.feed_rate_mm_per_min" = {{ from = 300.0, to = 6000.0, count = {} }}
"cut.exit_deg" = {{ from = 90.0, to = 180.0, count = 1000 }}
"""


def seconds(command, folder, cold):
    subprocess.run("sync", check=True)
    if cold:
        pathlib.Path("/proc/sys/vm/drop_caches").write_text("3")
    begin = time.monotonic()
    subprocess.run(command, shell=True, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return time.monotonic() - begin


def main(program, points=1_000_000, parts=100):
    program = os.path.realpath(program)
    with tempfile.TemporaryDirectory(dir=".") as folder:
        folder = pathlib.Path(folder)
        (folder / "study.toml").write_text(STUDY.format(points // 1000))
        names = [f"part{k}.h5" for k in range(1, parts + 1)]
        for k, name in enumerate(names, 1):
            subprocess.run([program, "run", "study.toml", "--quiet", "--shard", f"{k}/{parts}", "-o", name],
                           cwd=folder, check=True, stdout=subprocess.DEVNULL)
        size = sum((folder / name).stat().st_size for name in names)
        print(f"{points // 1000 * 1000} points in {parts} parts of {size / parts / 1e6:.1f} MB")
        files = " ".join(names)
        for cold in (False, True) if os.geteuid() == 0 else (False,):
            merge, copy = [], []
            for _ in range(3):
                merge.append(seconds(f"{program} merge all.h5 {files}", folder, cold))
                (folder / "all.h5").unlink()
                copy.append(seconds(f"cat {files} > copy; sync copy", folder, cold))
                (folder / "copy").unlink()
            merge, copy = statistics.median(merge), statistics.median(copy)
            print(f"from {'a cold disk' if cold else 'memory'}: merge {merge:.2f} s, cat and sync {copy:.2f} s: "
                  f"{merge / copy:.2f}")


if __name__ == "__main__":
    main(sys.argv[1], *(int(float(word)) for word in sys.argv[2:]))

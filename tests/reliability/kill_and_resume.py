#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills a run again and again at random times, starts it again each time, and compares the result with that of a
run that nobody killed, bit for bit.

    kill_and_resume.py PROGRAM [kills] [seed]

Prints how many kills there were, and how many of them while the result was written."""
import json
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from program import SLOT  # noqa: E402

STUDY = SLOT.replace("angular_steps = 90", "angular_steps = 360") + """\
[sweep.axes]
"cut.axial_depth_mm" = { from = 0.1, to = 2.0, count = 400 }
"cut.feed_rate_mm_per_min" = { from = 600.0, to = 3000.0, count = 500 }
"""
POINTS = 200_000


def variables(path):
    with h5py.File(path) as file:
        return {name: data[()].tobytes() if data.dtype.kind in "fi" else str(data[()].tolist())
                for name, data in file.items() if data.shape is not None}


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    random.seed(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    with tempfile.TemporaryDirectory(prefix="millstudy-kill-") as name:
        folder = pathlib.Path(name)
        (folder / "study.toml").write_text(STUDY)
        command = [program, "run", "study.toml", "-o", "R.h5", "--quiet", "--json"]

        def start():
            return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

        begin = time.monotonic()
        out, err = start().communicate()
        whole = time.monotonic() - begin
        expected = variables(folder / "R.h5")
        (folder / "R.h5").unlink()
        print(f"a run that nobody kills: {whole:.2f} s")

        killed = writing = finished = sessions = 0
        while killed < kills:
            process = start()
            sessions += 1
            time.sleep(random.choice([0.4, 1.1]) * random.random() * whole)
            during_result = (folder / "R.h5.tmp").exists()
            if process.poll() is None:
                process.send_signal(signal.SIGKILL)
                killed += 1
                writing += during_result
            out, err = process.communicate()
            if process.returncode not in (0, -signal.SIGKILL):
                print(f"FAIL: exit code {process.returncode}: {err}")
                return 1
            if not (folder / "R.h5").exists() or (folder / "R.h5.journal").exists():
                continue
            finished += 1
            if variables(folder / "R.h5") != expected:
                print(f"FAIL: after {killed} kills the variables differ")
                return 1
            (folder / "R.h5").unlink()
        # The last one to its end.
        process = start()
        out, err = process.communicate()
        if process.returncode != 0 or json.loads(out)["points"] != POINTS or variables(folder / "R.h5") != expected:
            print(f"FAIL: the last run: {err}")
            return 1
        leftovers = sorted(path.name for path in folder.iterdir())
        if leftovers != ["R.h5", "study.toml"]:
            print(f"FAIL: left behind: {leftovers}")
            return 1
        print(f"{killed} kills in {sessions} sessions, {writing} of them while the result was written: "
              f"{finished + 1} results, each bit for bit that of an uninterrupted run")
        return 0


if __name__ == "__main__":
    sys.exit(main())

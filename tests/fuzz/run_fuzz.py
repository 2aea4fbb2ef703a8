# SPDX-License-Identifier: MIT
"""Builds the fuzzers of all readers with clang++, runs the kept corpus and a few seconds of new inputs.

Usage: run_fuzz.py BUILD_FOLDER [SECONDS [FORMAT ...]], BUILD_FOLDER within that of a build of the engine. Without
clang++ it is skipped (exit 77). What makes a reader fail is left in BUILD_FOLDER/found: once it is mended, it belongs
in corpus/<format>. matio and HDF5 are not instrumented and run in processes of their own: what makes these fail is
left in BUILD_FOLDER/contained, and is no failure as long as it is refused.
"""
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
FORMATS = ("curve", "dynoware", "hdf5", "journal", "labview", "matlab", "study", "table", "tdms")
ROOT = HERE.parent.parent
MORE = {"study": (ROOT / "studies", ROOT / "tests" / "cli" / "broken")}  # kept inputs that stand elsewhere
SKIPPED = 77


def build(folder):
    configure = ["cmake", "-S", HERE, "-B", folder, "-G", "Ninja", "-DCMAKE_CXX_COMPILER=clang++",
                 "-DCMAKE_BUILD_TYPE=None", f"-DMILLSTUDY_BUILD={folder.resolve().parent}"]
    if shutil.which("ccache"):
        configure.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    for command in (configure, ["cmake", "--build", folder]):
        done = subprocess.run(command, text=True, capture_output=True)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)


def run(folder, name, seconds):
    """The text of a failure, or None. New inputs go to a folder of their own: the kept corpus does not change."""
    contained = name in ("hdf5", "matlab")
    work, found = folder / "new" / name, folder / ("contained" if contained else "found") / name
    work.mkdir(parents=True, exist_ok=True)
    found.mkdir(parents=True, exist_ok=True)
    # A request for too much memory is refused there.
    library = ["-malloc_limit_mb=1000000"] if contained else []
    command = [folder / f"fuzz_{name}", *library, f"-max_total_time={seconds}", "-timeout=60", "-rss_limit_mb=2048",
               "-max_len=16384", f"-artifact_prefix={found}/", work, HERE / "corpus" / name,
               *MORE.get(name, ())]
    done = subprocess.run([str(word) for word in command], text=True, errors="replace", capture_output=True,
                          env={**os.environ, "ASAN_OPTIONS": "allocator_may_return_null=1"})
    print(name, [line for line in done.stderr.splitlines() if line.startswith(("#", "Done"))][-1:], flush=True)
    return None if done.returncode == 0 else done.stderr[-6000:]


def main():
    if shutil.which("clang++") is None:
        print("no clang++: skipped")
        return SKIPPED
    folder = pathlib.Path(sys.argv[1])
    seconds = int(sys.argv[2]) if len(sys.argv) > 2 else 3
    formats = sys.argv[3:] or FORMATS
    build(folder)
    with concurrent.futures.ThreadPoolExecutor(min(2, os.cpu_count() or 1)) as pool:
        failures = [text for text in pool.map(lambda name: run(folder, name, seconds), formats) if text]
    print(*failures, sep="\n")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One run in several processes under mpirun: the same bits as alone, whatever is killed meanwhile.

    ranks.py PROGRAM [kills] [seed]

PROGRAM is built with MPI. Exit code 77: there is no mpirun here."""
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from kill_and_resume import STUDY, variables

MPIRUN = ["mpirun", "--oversubscribe", "--bind-to", "none"]
# As root, on this machine only (no ssh), and without reading other processes' memory, which containers forbid.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_plm": "isolated", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


class Failure(Exception):
    pass


def expect(truth, what):
    if not truth:
        raise Failure(what)


def children(pid):
    """Processes that a process started, in the order in which it did."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
        except (OSError, IndexError):
            continue
        if parent == pid:
            found.append(int(entry.name))
    return sorted(found)


class Job:
    """A study in a folder, run by any number of ranks."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.result = folder / "R.h5"
        (folder / "study.toml").write_text(STUDY)

    def start(self, ranks, *more):
        command = [*MPIRUN, "-n", str(ranks), self.program, "run", "study.toml", "-o", "R.h5", "--quiet", "--json",
                   "--threads", "1", *more]
        return subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env=ENVIRONMENT)

    def run(self, ranks, *more, code=0):
        process = self.start(ranks, *more)
        out, err = process.communicate(timeout=300)
        expect(process.returncode == code, f"{ranks} ranks, exit code {process.returncode}, not {code}: {err}")
        return out, err

    def take(self):
        found = variables(self.result)
        self.result.unlink()
        leftovers = sorted(path.name for path in self.folder.iterdir())
        expect(leftovers == ["study.toml"], f"left behind: {leftovers}")
        return found


def same_bits(job):
    subprocess.run([job.program, "run", "study.toml", "-o", "R.h5", "--quiet"], cwd=job.folder, check=True,
                   stdout=subprocess.DEVNULL)
    expected = job.take()
    for ranks in (1, 2, 4):
        begin = time.monotonic()
        job.run(ranks)
        seconds = time.monotonic() - begin
        print(f"{ranks} ranks: {seconds:.2f} s")
        expect(job.take() == expected, f"{ranks} ranks: other bits")
    return expected, seconds


def a_limit_of_memory_is_everybodys(job, expected):
    job.run(2, "--memory", "100MB")
    expect(job.take() == expected, "with --memory: other bits")
    _, err = job.run(2, "--memory", "1MB", code=2)
    expect("is not enough" in err, f"--memory 1MB: {err}")


def bad_input_is_told_once(job):
    out, err = job.run(3, "--set", "cutter.flutes=0", code=2)
    expect(out == "" and err.count("must be >= 1") == 1, f"bad input: {out}{err}")
    expect(not job.result.exists(), "bad input: a result")
    job.run(2, "--set", "sweep.axes.\"cut.axial_depth_mm\"=[0.5]")
    _, err = job.run(2, code=2)
    expect(err.count("another study") == 1, f"another study: {err}")
    job.result.unlink()


def end_at_a_signal(job, expected):
    """Rank 0 is told to end: the others hand in what they have."""
    process = job.start(3)
    deadline = time.monotonic() + 30
    while not (job.folder / "R.h5.journal").exists() and time.monotonic() < deadline:
        time.sleep(0.01)  # before that a signal ends it as it ends any program
    time.sleep(0.2)
    os.kill(children(process.pid)[0], signal.SIGTERM)
    _, err = process.communicate(timeout=60)
    if process.returncode == 0:  # it was done by then
        expect(job.take() == expected, "at a signal: other bits")
        return
    expect(process.returncode == 4 and "interrupted after" in err, f"at a signal: {process.returncode} {err}")
    job.run(2)
    expect(job.take() == expected, "after a signal: other bits")


def kill_ranks(job, expected, whole, kills):
    results = 0
    for _ in range(kills):
        process = job.start(4)
        time.sleep(0.2 + random.random() * whole)
        ranks = children(process.pid)
        if process.poll() is None and ranks:
            victim = random.choice(ranks)
            try:
                os.kill(victim, signal.SIGKILL)
            except ProcessLookupError:
                pass
        _, err = process.communicate(timeout=120)
        if process.returncode == 0:
            results += 1
            expect(job.take() == expected, "after a kill: other bits")
    job.run(random.choice([1, 2, 4]))
    expect(job.take() == expected, "after kills: other bits")
    print(f"{kills} times one of 4 ranks killed: {results + 1} results, each bit for bit that of one process")


def a_killed_rank_ends_the_job(job, expected):
    for rank in (0, 2):
        process = job.start(4)
        deadline = time.monotonic() + 20
        while len(children(process.pid)) < 4 and time.monotonic() < deadline:
            time.sleep(0.01)
        time.sleep(0.3)
        os.kill(children(process.pid)[rank], signal.SIGKILL)
        process.communicate(timeout=60)
        expect(process.returncode not in (0, None), f"rank {rank} was killed, and the job says 0")
    job.run(4)
    expect(job.take() == expected, "after killed ranks: other bits")


def main():
    if not shutil.which("mpirun"):
        print("there is no mpirun")
        return 77
    program = str(pathlib.Path(sys.argv[1]).resolve())
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 6
    random.seed(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    with tempfile.TemporaryDirectory(prefix="millstudy-ranks-") as name:
        job = Job(program, pathlib.Path(name))
        try:
            expected, whole = same_bits(job)
            a_limit_of_memory_is_everybodys(job, expected)
            bad_input_is_told_once(job)
            end_at_a_signal(job, expected)
            a_killed_rank_ends_the_job(job, expected)
            kill_ranks(job, expected, whole, kills)
        except Failure as failure:
            print(f"FAIL: {failure}")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

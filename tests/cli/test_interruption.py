# SPDX-License-Identifier: MIT
"""Ctrl-C and SIGTERM during a run, and what a run says while it lasts."""
import json
import platform
import signal
import subprocess
import time
import unittest

from program import PROGRAM, SLOT, SLOW, ProgramTest

AXES = """\
[sweep.axes]
"cut.axial_depth_mm" = { from = 0.1, to = 2.0, count = 1000 }
"cut.feed_rate_mm_per_min" = { from = 600.0, to = 3000.0, count = 1000 }
"""
# A million points of about 0.3 ms each; and points of more than a tenth of a second.
LONG = SLOT.replace("angular_steps = 90", "angular_steps = 20000") + AXES
SLOW_POINTS = SLOT.replace("angular_steps = 90",
                           'angular_steps = 1000\nrule = "discs"\ndiscs = 500_000') + AXES


class Interruption(ProgramTest):
    def start(self, text, *arguments):
        self.write(text)
        process = subprocess.Popen([PROGRAM, "run", "study.toml", "-o", "R.h5", "--threads", "2",
                                    *arguments], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        deadline = time.monotonic() + 20.0 * SLOW
        while not (self.folder / "R.h5.journal").exists():
            self.assertIsNone(process.poll(), "ended before it could be interrupted")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        return process

    def interrupt(self, process, number=signal.SIGINT):
        process.send_signal(number)
        out, err = process.communicate(timeout=10 * SLOW)
        self.assertEqual(process.returncode, 4, err)
        self.assertEqual(out, "")
        return err.splitlines()

    def check(self, text, number):
        process = self.start(text)
        time.sleep(0.5)
        lines = self.interrupt(process, number)
        self.assertRegex(lines[-1], r"\Ainterrupted after [\d,]+ of 1,000,000 points, which are kept: "
                                    r"the same command goes on\Z")
        self.assertEqual(sorted(self.files()), ["R.h5.journal", "study.toml"])
        kept = int(lines[-1].split()[2].replace(",", ""))
        status = json.loads(self.millstudy("status", "R.h5", "--json").stdout)
        self.assertEqual((status["status"], status["points"], status["damaged"]),
                         ("unfinished", 1_000_000, 0))
        self.assertEqual(status["ok"], kept)
        self.assertGreater(kept, 0)

    def test_ctrl_c_keeps_what_is_done(self):
        self.check(LONG, signal.SIGINT)

    def test_sigterm_keeps_what_is_done(self):
        self.check(LONG, signal.SIGTERM)

    def test_a_block_of_slow_points_does_not_delay_it(self):
        self.check(SLOW_POINTS, signal.SIGINT)

    def test_the_old_result_survives_an_interrupted_fresh_run(self):
        self.write(SLOT)
        self.millstudy("run", "study.toml", "-o", "R.h5")
        old = (self.folder / "R.h5").read_bytes()
        process = self.start(LONG, "--fresh")
        time.sleep(0.5)
        self.interrupt(process)
        self.assertEqual((self.folder / "R.h5").read_bytes(), old)
        self.assertEqual(sorted(self.files()), ["R.h5", "R.h5.journal", "study.toml"])

    def test_two_runs_into_one_file(self):
        process = self.start(LONG)
        self.assertEqual(self.refused("run", "study.toml", "-o", "R.h5"),
                         f"R.h5.journal: is being written by process {process.pid} on {platform.node()}\n")
        self.assertIn(f"running, by process {process.pid}", self.millstudy("status", "R.h5").stdout)
        self.interrupt(process)

    def test_progress_is_plain_lines_when_not_on_a_terminal(self):
        process = self.start(LONG)
        time.sleep(3.0)
        lines = self.interrupt(process)
        self.assertGreaterEqual(len(lines), 2)
        for line in lines[:-1]:
            self.assertRegex(line, r"\A *\d+ %  [\d,]+ of 1,000,000 points, [\d,]+ points/s, .+ left\Z")

    def test_quiet_has_no_progress(self):
        process = self.start(LONG, "--quiet")
        time.sleep(3.0)
        self.assertEqual(len(self.interrupt(process)), 1)


if __name__ == "__main__":
    unittest.main()

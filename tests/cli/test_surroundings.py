# SPDX-License-Identifier: MIT
"""Terminals, closed streams, full disks, editors of other systems."""
import os
import pty
import resource
import select
import signal
import subprocess
import time
import unittest

import h5py

from program import CURVE, CURVED_SLOT, PROGRAM, SLOT, ProgramTest
from test_interruption import LONG

TRACED = SLOT.replace("angular_steps = 90", "angular_steps = 100000") + "[output]\ntraces = true\n"


class Disk(ProgramTest):
    def limited(self, *arguments):
        """Runs the program where no file may be larger than 200 kB."""
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, text=True, capture_output=True,
                              preexec_fn=limit, timeout=60)

    def test_a_full_disk_is_waited_for(self):
        self.write(TRACED)
        done = self.limited("run", "study.toml", "-o", "R.h5", "--disk-wait", "1.5")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual(done.stderr, """\
R.h5.journal: cannot be written: File too large; waiting up to 1.5 s for room, Ctrl-C ends the run
R.h5.journal: cannot be written: File too large; all that was written is kept, and the same command goes on with it
""")
        self.assertEqual(sorted(self.files()), ["study.toml"])

    def test_a_disk_that_is_full_at_the_end_keeps_the_points(self):
        axes = '[sweep.axes]\n"cutter.helix_deg" = { from = 0.0, to = 60.0, count = 800 }\n'
        self.write(SLOT + axes)
        done = self.limited("run", "study.toml", "-o", "R.h5", "--disk-wait", "0")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertRegex(done.stderr, r"\AR\.h5(\.journal)?: cannot be written: File too large[^\n]*\n\Z")
        self.assertEqual(sorted(self.files()), ["R.h5.journal", "study.toml"])
        again = self.millstudy("run", "study.toml", "-o", "R.h5")
        self.assertRegex(again.stderr, r"\Agoing on after [\d,]+ of 800 points\n")
        self.assertEqual(sorted(self.files()), ["R.h5", "study.toml"])

    def test_a_full_disk_during_export(self):
        self.write(SLOT + '[sweep.axes]\n"cutter.helix_deg" = { from = 0.0, to = 60.0, count = 2000 }\n')
        self.millstudy("run", "study.toml", "-o", "R.h5")
        before = self.files()
        done = self.limited("export", "R.h5", "-o", "t.csv")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertRegex(done.stderr, r"\At\.csv: cannot be written[^\n]*\n\Z")
        self.assertEqual(self.files(), before)

    def test_a_full_standard_output(self):
        self.write(SLOT)
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "plan", "study.toml"], cwd=self.folder, stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 4)
        self.assertEqual(done.stderr, "standard output cannot be written: disk full?\n")


class Streams(ProgramTest):
    def test_closed_streams_do_not_end_up_in_the_result(self):
        self.write(LONG.replace("count = 1000", "count = 100").replace("20000", "5000"))
        done = subprocess.run(f"exec '{PROGRAM}' run study.toml -o R.h5 <&- >&- 2>&-", shell=True,
                              cwd=self.folder, timeout=120)
        self.assertEqual(done.returncode, 0)
        with h5py.File(self.folder / "R.h5") as file:
            self.assertEqual(file["power_mean"].shape, (100, 100))
            self.assertEqual(int(file.attrs["points_ok"]), 10_000)


@unittest.skipIf(float(os.environ.get("MILLSTUDY_SLOW", "1")) > 1.0,
                 "a sanitizer's address space has no such limit")
class OutOfMemory(ProgramTest):
    def test_ends_the_run_and_keeps_nothing(self):
        self.write(CURVE, "curve.toml")
        self.write(CURVED_SLOT.replace("angular_steps = 90", "angular_steps = 1_000_000")
                   .replace("feed_rate_mm_per_min = 1740.0\n", "feed_rate_mm_per_min = 200.0\n") +
                   "[output]\ntraces = true\n")
        limit = 700 << 20  # [bytes] of address space; the time history of the point is larger
        done = subprocess.run([PROGRAM, "run", "study.toml", "-o", "R.h5", "--quiet"],
                              cwd=self.folder, text=True, capture_output=True, timeout=120,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual(done.stderr, "out of memory: use fewer threads, or fewer samples per "
                                      "point; finished points are kept\n")
        self.assertEqual(sorted(self.files()), ["curve.toml", "study.toml"])


class Terminal(ProgramTest):
    def test_a_bar_that_is_gone_before_the_last_word(self):
        self.write(LONG)
        try:
            child, terminal = pty.fork()
        except OSError as error:
            self.skipTest(f"no terminal to be had: {error}")
        if child == 0:
            os.chdir(self.folder)
            os.execv(PROGRAM, [PROGRAM, "run", "study.toml", "-o", "R.h5"])
        shown, deadline, asked = b"", time.monotonic() + 20.0, False
        while time.monotonic() < deadline:
            if select.select([terminal], [], [], 0.1)[0]:
                try:
                    shown += os.read(terminal, 4096)
                except OSError:  # the terminal's way to say end of file
                    break
            if not asked and shown.count(b"\r\033[K[") >= 3:
                os.write(terminal, b"\x03")
                asked = True
        os.close(terminal)
        _, status = os.waitpid(child, 0)
        self.assertEqual(os.waitstatus_to_exitcode(status), 4)
        text = shown.decode()
        self.assertRegex(text, r"\r\x1b\[K\[[#.]{24}\]   \d %  [\d,]+ of 1,000,000 points, [\d,]+ points/s")
        self.assertRegex(text, r"\r\x1b\[Kinterrupted after [\d,]+ of 1,000,000 points, "
                               r"which are kept: the same command goes on\r\n\Z")
        self.assertEqual(sorted(self.files()), ["R.h5.journal", "study.toml"])


class Signals(ProgramTest):
    def run_and_hang_up(self, text, handling):
        self.write(text)
        process = subprocess.Popen([PROGRAM, "run", "study.toml", "-o", "R.h5", "--quiet"],
                                   cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE,
                                   preexec_fn=lambda: signal.signal(signal.SIGHUP, handling))
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        while not (self.folder / "R.h5.journal").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.005)
        time.sleep(0.3)
        process.send_signal(signal.SIGHUP)
        process.communicate(timeout=60)
        return process.returncode

    def test_a_lost_connection_keeps_what_is_done(self):
        self.assertEqual(self.run_and_hang_up(LONG, signal.SIG_DFL), 4)
        self.assertEqual(sorted(self.files()), ["R.h5.journal", "study.toml"])

    def test_under_nohup_it_goes_on(self):
        shorter = LONG.replace("count = 1000", "count = 80")
        self.assertEqual(self.run_and_hang_up(shorter, signal.SIG_IGN), 0)
        self.assertEqual(sorted(self.files()), ["R.h5", "study.toml"])


class Editors(ProgramTest):
    def test_line_ends_and_byte_order_mark_of_windows(self):
        self.write(b"\xef\xbb\xbf" + SLOT.replace("\n", "\r\n").encode())
        self.millstudy("run", "study.toml")

    def test_no_line_end_at_the_end(self):
        self.write(SLOT.rstrip("\n"))
        self.millstudy("run", "study.toml")


if __name__ == "__main__":
    unittest.main()

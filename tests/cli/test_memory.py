# SPDX-License-Identifier: MIT
"""Peak memory of a study does not grow with its points."""
import os
import subprocess
import sys
import time
import unittest

from program import PROGRAM, SLOT, ProgramTest


def study(points):
    """A force study of a multiple of 1000 points, one helix angle after another."""
    return SLOT.replace("angular_steps = 90", "angular_steps = 4") + f"""\
[sweep.axes]
"cutter.helix_deg" = {{ from = 0.0, to = 50.0, count = {points // 1000} }}
"cut.feed_rate_mm_per_min" = {{ from = 600.0, to = 3000.0, count = 1000 }}
"""


# What is in flight (blocks, one chunk of each variable, the allocator's spare) is full only at some
# 500 000 points, and differs by a few MB from run to run. Keeping the results would take 170 MB more
# at 1e6 points: six times as much.
MOST_GROWTH = 1.4


class Memory(ProgramTest):
    def peak(self, points):
        """Largest resident set of a run [MB]."""
        self.write(study(points))
        started = time.monotonic()
        process = subprocess.Popen([PROGRAM, "run", "study.toml", "-o", f"{points}.h5", "--quiet",
                                    "--threads", "2"], cwd=self.folder, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        megabytes = usage.ru_maxrss / 1024.0
        print(f"{points:>9} points: peak memory {megabytes:6.1f} MB, "
              f"{time.monotonic() - started:5.1f} s", flush=True)
        return megabytes

    def test_is_flat_from_1e5_to_1e6_points(self):
        small = self.peak(100_000)
        self.assertLess(self.peak(1_000_000), MOST_GROWTH * small)
        most = int(float(os.environ.get("MILLSTUDY_MOST_POINTS", "1e6")))  # 1e7 by hand
        if most > 1_000_000:
            self.assertLess(self.peak(most), MOST_GROWTH * small)

    def test_a_limit_makes_blocks_smaller_and_threads_fewer(self):
        self.write(SLOT.replace("angular_steps = 90", "angular_steps = 200000") + """\
[output]
traces = true
[sweep.axes]
"cut.feed_rate_mm_per_min" = { from = 600.0, to = 3000.0, count = 20 }
""")
        for limit, most in (("4GB", 4000.0), ("80MB", 95.0)):  # the last with the libraries' own pages
            process = subprocess.Popen([PROGRAM, "run", "study.toml", "-o", f"{limit}.h5", "--quiet", "--threads", "4",
                                        "--memory", limit], cwd=self.folder, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True)
            message = process.stderr.read()
            process.stderr.close()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.assertEqual(process.returncode, 0, message)
            self.assertEqual("of 4 threads, for 80 MB of memory" in message, limit == "80MB")
            print(f"limit {limit}: peak memory {usage.ru_maxrss / 1024.0:6.1f} MB", flush=True)
            self.assertLess(usage.ru_maxrss / 1024.0, most)
        # Not in this process: its memory would count as that of the next run before the program starts.
        same = ("import h5py; a, b = h5py.File('4GB.h5'), h5py.File('80MB.h5'); "
                "assert all(a[n][()].tobytes() == b[n][()].tobytes() for n in ('force_x_max', 'trace_force_x'))")
        subprocess.run([sys.executable, "-c", same], cwd=self.folder, check=True)
        self.assertIn("--memory: 1.0 MB is not enough: one thread needs about",
                      self.refused("run", "study.toml", "-o", "none.h5", "--memory", "1MB"))
        self.assertFalse((self.folder / "none.h5.journal").exists())


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: MIT
"""Peak memory of a study does not grow with its points."""
import os
import subprocess
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


if __name__ == "__main__":
    unittest.main()

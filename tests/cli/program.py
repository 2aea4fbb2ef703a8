# SPDX-License-Identifier: MIT
"""The program under test, in a folder of its own. MILLSTUDY is its path."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ.get("MILLSTUDY", "millstudy")
SLOW = float(os.environ.get("MILLSTUDY_SLOW", "1"))  # how much slower than a release build
SOURCE = pathlib.Path(__file__).resolve().parents[2]

SLOT = """\
schema_version = 1
[study]
name = "slot"
kind = "force"
[cutter]
shape = "flat"
diameter_mm = 12.0
flutes = 2
helix_deg = 30.0
[coefficients]
Ktc_N_per_mm2 = 2172.0
Krc_N_per_mm2 = 850.0
Kac_N_per_mm2 = 726.0
Kte_N_per_mm = 17.3
Kre_N_per_mm = 7.8
Kae_N_per_mm = 6.7
[numerics]
angular_steps = 90
[cut]
axial_depth_mm = 0.5
milling = "slot"
spindle_speed_rpm = 14500.0
feed_rate_mm_per_min = 1740.0
"""

CURVE = """\
degree = 2
knots = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]
points_mm = [[0.0, 0.0], [2.0, 2.0], [4.0, 0.0]]
"""

CURVED_SLOT = SLOT.replace('kind = "force"', 'kind = "path_force"') + """\
[path]
curve_file = "curve.toml"
interpolation_period_s = 0.002
"""


class ProgramTest(unittest.TestCase):
    """Every test has an empty working folder."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="millstudy-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write(self, text, name="study.toml"):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return name

    def millstudy(self, *arguments, code=0, timeout=60):
        """Runs the program in the working folder; the exit code must be as said."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, text=True,
                              capture_output=True, timeout=SLOW * timeout)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}{done.stderr}")
        return done

    def refused(self, *arguments):
        """What the program says on stderr about bad input; on stdout it says nothing."""
        done = self.millstudy(*arguments, code=2, timeout=5)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def files(self):
        """Every file of the working folder with all that a program could change about it."""
        state = {}
        for path in sorted(self.folder.rglob("*")):
            status = path.lstat()
            content = path.read_bytes() if path.is_file() and os.access(path, os.R_OK) else b""
            state[str(path.relative_to(self.folder))] = (status.st_mode, status.st_mtime_ns, content)
        return state

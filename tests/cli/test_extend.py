# SPDX-License-Identifier: MIT
"""run --extend: axes get other values, points that were computed before are used again."""
import unittest

import h5py
from program import SLOT, ProgramTest

SOBOL = """\
[sweep]
design = "sobol"
samples = {samples}
[sweep.axes]
"cut.axial_depth_mm" = {{ from = 0.1, to = 2.0 }}
"cut.feed_rate_mm_per_min" = {{ from = 600.0, to = 3000.0 }}
"""


def variables(path):
    with h5py.File(path) as file:
        return {name: data[()].tobytes() if data.dtype.kind in "fi" else str(data[()].tolist())
                for name, data in file.items() if data.shape is not None}


class Extend(ProgramTest):
    def axes(self, depths, feeds, more=""):
        self.write(SLOT + more + f'[sweep.axes]\n"cut.axial_depth_mm" = {depths}\n"cut.feed_rate_mm_per_min" = {feeds}\n')

    def expect_reused(self, count, *options):
        """Runs with --extend; the result must be that of a run from the beginning, bit for bit."""
        done = self.millstudy("run", "study.toml", "--extend", *options)
        self.assertIn(f"{count} points are those of the old result", done.stderr)
        self.millstudy("run", "study.toml", "-o", "alone.h5", "--fresh")
        self.assertEqual(variables(self.folder / "slot.h5"), variables(self.folder / "alone.h5"))
        (self.folder / "alone.h5").unlink()

    def test_a_grid_takes_over_what_it_has(self):
        self.axes([0.5, 1.0], [600.0, 1200.0, 1800.0])
        self.millstudy("run", "study.toml")
        self.axes([0.25, 0.5, 1.0, 2.0], [600.0, 900.0, 1800.0, 2400.0])
        self.expect_reused(4)
        self.assertTrue((self.folder / "slot.previous-1.h5").exists())
        self.assertFalse((self.folder / "slot.h5.journal").exists())
        done = self.millstudy("run", "study.toml", "--extend")
        self.assertIn("already done", done.stdout)

    def test_in_blocks_of_any_size_and_in_another_order_of_axes(self):
        self.axes([0.5, 1.0], [600.0, 1200.0, 1800.0])
        self.millstudy("run", "study.toml")
        self.write(SLOT + '[sweep.axes]\n"cut.feed_rate_mm_per_min" = [1800.0, 600.0, 700.0]\n'
                   '"cut.axial_depth_mm" = [1.0, 0.7, 0.5]\n')
        self.expect_reused(4, "--block-size", "4")

    def test_a_longer_sobol_sequence_begins_with_the_shorter(self):
        self.write(SLOT + SOBOL.format(samples=64))
        self.millstudy("run", "study.toml")
        self.write(SLOT + SOBOL.format(samples=256))
        self.expect_reused(64)

    def test_traces_too(self):
        self.axes([0.5, 1.0], [600.0], "[output]\ntraces = true\n")
        self.millstudy("run", "study.toml")
        self.axes([0.5, 0.7, 1.0], [600.0, 700.0], "[output]\ntraces = true\n")
        self.expect_reused(2)

    def test_a_file_that_has_changed_is_another_value(self):
        cutter = 'shape = "flat"\ndiameter_mm = {}\nflutes = 2\nhelix_deg = 30.0\n'
        self.write(cutter.format(10.0), "a.toml")
        self.write(cutter.format(12.0), "b.toml")
        head, rest = SLOT.split("[cutter]")
        body = "[coefficients]" + rest.split("[coefficients]")[1]
        study = head + body + '[sweep.axes]\n"cutter.cutter_file" = {}\n'
        self.write(study.format('["a.toml", "b.toml"]'))
        self.millstudy("run", "study.toml")
        self.write(cutter.format(11.0), "b.toml")
        self.expect_reused(1)

    def test_failed_points_and_those_outside_the_limits_are_taken_over(self):
        limit = '[[sweep.where]]\nquantity = "feed_per_tooth_mm"\nmax = 0.05\n'
        self.axes([0.5, 1.0], [600.0, 2400.0])
        (self.folder / "study.toml").write_text((self.folder / "study.toml").read_text() + limit)
        self.millstudy("run", "study.toml")
        self.axes([0.5, 0.7, 1.0], [600.0, 2400.0])
        (self.folder / "study.toml").write_text((self.folder / "study.toml").read_text() + limit)
        self.expect_reused(4)

    def test_other_settings_are_refused_and_nothing_is_changed(self):
        self.axes([0.5, 1.0], [600.0])
        self.millstudy("run", "study.toml")
        before = self.files()
        self.assertEqual(self.refused("run", "study.toml", "--extend", "--set", "cutter.helix_deg=31.0"),
                         "slot.h5: is of a study with other settings, limits or axes: --extend is for other values on "
                         "the same axes\n")
        self.assertEqual(self.files(), before)
        self.millstudy("run", "study.toml", "--shard", "1/2", "-o", "part.h5")
        self.assertIn("merge the parts first",
                      self.refused("run", "study.toml", "-o", "part.h5", "--extend", "--set",
                                   'sweep.axes."cut.feed_rate_mm_per_min"=[600.0, 700.0]'))

    def test_a_journal_does_not_make_an_unrelated_result_welcome(self):
        depths = '"cut.radial_depth_mm" = {}'
        self.write(SLOT.replace('milling = "slot"', 'milling = "up"\nradial_depth_mm = 6.0') +
                   "[sweep.axes]\n" + depths.format([3.0, 6.0]) + "\n")
        self.millstudy("run", "study.toml")
        # Beside it the journal of another study's run that stopped early.
        other = ("--set", "cutter.helix_deg=40.0", "--set", "sweep.axes." + depths.format([12.5, 13.0, 3.0, 6.0]))
        self.millstudy("run", "study.toml", "-o", "part.h5", *other, "--max-failures", "1", "--block-size", "1",
                       "--threads", "1", code=4)
        (self.folder / "slot.h5").rename(self.folder / "part.h5")
        self.assertTrue((self.folder / "part.h5.journal").exists())
        self.assertIn("is of a study with other settings",
                      self.refused("run", "study.toml", "-o", "part.h5", "--extend", *other))

    def test_without_a_result_it_is_a_run_like_any_other(self):
        self.axes([0.5, 1.0], [600.0])
        self.assertIn("2 points", self.millstudy("run", "study.toml", "--extend").stdout)


if __name__ == "__main__":
    unittest.main()

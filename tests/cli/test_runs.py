# SPDX-License-Identifier: MIT
"""What the verbs do with good studies: results, exit codes, and what is left on the disk."""
import json
import re
import shutil
import unittest

import h5py
import numpy

from program import CURVE, CURVED_SLOT, SLOT, SOURCE, ProgramTest

RADIAL = SLOT.replace('milling = "slot"', 'milling = "up"') + """\
[sweep.axes]
"cut.radial_depth_mm" = [3.0, 12.0, 13.0, 20.0]
"cut.feed_rate_mm_per_min" = [600.0, 1740.0]
"""


def attributes(path):
    with h5py.File(path) as file:
        return {name: value.decode() if isinstance(value, bytes) else value
                for name, value in file.attrs.items()}


class ReadyMadeStudies(ProgramTest):
    """Each of studies/ runs, made smaller by --set."""

    def check(self, name, points, *sets):
        shutil.copytree(SOURCE / "studies", self.folder / "studies")
        shutil.copytree(SOURCE / "data", self.folder / "data")
        arguments = [word for text in sets for word in ("--set", text)]
        done = self.millstudy("run", f"studies/{name}.toml", *arguments)
        self.assertIn(f"done: {points} points, {points} ok, 0 failed, 0 skipped\n", done.stdout)
        with h5py.File(self.folder / f"{name}.h5") as file:
            self.assertTrue((file["status"][()] == 0).all())

    def test_sun2008_interpolators(self):
        self.check("sun2008_interpolators", 12, 'sweep.axes."path.max_iterations"=[1, 2]',
                   'sweep.axes."path.interpolation_period_s"=[0.004]',
                   'sweep.axes."cut.feed_rate_mm_per_min"=[7200.0]')

    def test_haber2004_slot(self):
        self.check("haber2004_slot", 2, "numerics.angular_steps=90")

    def test_ball_edge_convergence(self):
        self.check("ball_edge_convergence", 4, 'sweep.axes."numerics.discs"=[25, 50]')

    def test_ggg70_slot(self):
        self.check("ggg70_slot", 12,
                   'sweep.axes."cut.feed_rate_mm_per_min"={from = 600.0, to = 1800.0, count = 3}',
                   'sweep.axes."cut.spindle_speed_rpm"=[14500.0]',
                   'sweep.axes."cutter.helix_deg"=[0.0, 30.0]',
                   'sweep.axes."path.max_iterations"=[1, 2]')


class Run(ProgramTest):
    def test_a_second_run_does_nothing(self):
        self.write(SLOT)
        first = self.millstudy("run", "study.toml")
        self.assertIn("done: 1 points", first.stdout)
        before = self.files()
        second = self.millstudy("run", "study.toml")
        self.assertIn("already done: 1 points, 1 ok", second.stdout)
        self.assertEqual(self.files(), before)
        self.assertEqual(sorted(before), ["slot.h5", "study.toml"])

    def test_failed_points_are_rows_with_a_reason(self):
        self.write(RADIAL)
        done = self.millstudy("run", "study.toml", "-o", "r.h5", code=3)
        self.assertIn("done: 8 points, 4 ok, 4 failed, 0 skipped\n", done.stdout)
        self.assertIn("  4 failed: cut.radial_depth_mm must be <= cutter.diameter_mm\n", done.stdout)
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(file["status"][()].tolist(), [[0, 0], [0, 0], [1, 1], [1, 1]])
            self.assertEqual(file["failure_code"][()].tolist(), [[0, 0], [0, 0], [1, 1], [1, 1]])
            self.assertEqual(file["failure"].asstr()[()].tolist(),
                             ["none", "cut.radial_depth_mm must be <= cutter.diameter_mm"])
            force = file["force_x_mean"][()]
            self.assertTrue(numpy.isfinite(force[:2]).all())
            self.assertTrue(numpy.isnan(force[2:]).all())
        before = self.files()
        again = self.millstudy("run", "study.toml", "-o", "r.h5", code=3)
        self.assertIn("already done: 8 points, 4 ok, 4 failed", again.stdout)
        self.assertEqual(self.files(), before)

    def test_a_changed_study_is_refused(self):
        self.write(SLOT)
        self.millstudy("run", "study.toml")
        self.write(SLOT.replace("= 0.5", "= 0.6"))
        before = self.files()
        self.assertEqual(self.refused("run", "study.toml"),
                         "slot.h5: holds the result of another study; use --fresh to compute this one (the old result "
                         "is moved aside), --extend if only values of axes differ, or -o for another file\n")
        self.assertEqual(self.files(), before)

    def test_fresh_moves_the_old_result_aside(self):
        self.write(SLOT)
        self.millstudy("run", "study.toml")
        old = (self.folder / "slot.h5").read_bytes()
        self.write(SLOT.replace("= 0.5", "= 0.6"))
        for number in (1, 2):
            done = self.millstudy("run", "study.toml", "--fresh")
            self.assertIn(f"the old result is now slot.previous-{number}.h5\n", done.stderr)
        self.assertEqual((self.folder / "slot.previous-1.h5").read_bytes(), old)
        self.assertEqual(sorted(self.files()),
                         ["slot.h5", "slot.previous-1.h5", "slot.previous-2.h5", "study.toml"])

    def test_sampled_designs_spread_over_all_axes(self):
        axes = """\
[sweep]
design = "%s"
samples = 256
seed = %d
[sweep.axes]
"cut.axial_depth_mm" = { from = 0.1, to = 10.0, spacing = "log" }
"cutter.flutes" = { from = 2, to = 5 }
"cut.milling" = ["up", "down"]
"""
        text = SLOT.replace('milling = "slot"', 'milling = "up"\nradial_depth_mm = 6.0')
        values = {}
        for design, seed in (("sobol", 1), ("sobol", 2), ("latin_hypercube", 1)):
            self.write(text + axes % (design, seed))
            self.millstudy("run", "study.toml", "-o", f"{design}{seed}.h5")
            with h5py.File(self.folder / f"{design}{seed}.h5") as file:
                depth = file["axial_depth_mm"][()]
                self.assertEqual(file["force_x_mean"].shape, (256,))
                self.assertEqual(numpy.unique(file["flutes"], return_counts=True)[1].tolist(), [64] * 4)
                self.assertEqual(file["milling"].asstr()[()].tolist().count("up"), 128)
            parts = numpy.sort(numpy.floor(numpy.log10(depth / 0.1) / 2.0 * 256.0))
            self.assertEqual(parts.tolist(), list(range(256)))
            values[design, seed] = depth.tolist()
        self.assertEqual(len({str(v) for v in values.values()}), 3)
        self.assertIn("already done", self.millstudy("run", "study.toml", "-o", "latin_hypercube1.h5").stdout)
        self.assertIn("another study", self.refused("run", "study.toml", "-o", "sobol1.h5"))

    def test_limits_skip_points(self):
        self.write(SLOT + '[sweep.axes]\n"cut.feed_rate_mm_per_min" = [580.0, 1740.0, 2900.0, 2901.0]\n'
                   '[[sweep.where]]\nquantity = "feed_per_tooth_mm"\nmin = 0.03\nmax = 0.1\n')
        done = self.millstudy("run", "study.toml")
        self.assertIn("done: 4 points, 2 ok, 0 failed, 2 skipped\n", done.stdout)
        with h5py.File(self.folder / "slot.h5") as file:
            self.assertEqual(file["status"][()].tolist(), [2, 0, 0, 2])
            self.assertEqual(numpy.isnan(file["power_mean"][()]).tolist(), [True, False, False, True])
            self.assertEqual(file["failure_code"][()].tolist(), [0, 0, 0, 0])

    def test_json_summary(self):
        self.write(RADIAL)
        for status in ("done", "already done"):
            summary = json.loads(self.millstudy("run", "study.toml", "--json", code=3).stdout)
            self.assertEqual(summary["status"], status)
            self.assertEqual([summary[k] for k in ("points", "ok", "failed", "skipped", "result")],
                             [8, 4, 4, 0, "slot.h5"])
            self.assertRegex(summary["study_hash"], r"\A[0-9a-f]{64}\Z")

    def test_quiet_says_nothing_on_stderr(self):
        self.write(RADIAL)
        self.assertEqual(self.millstudy("run", "study.toml", "--quiet", code=3).stderr, "")

    def test_a_single_point_has_scalar_variables(self):
        self.write(SLOT)
        self.millstudy("run", "study.toml")
        with h5py.File(self.folder / "slot.h5") as file:
            self.assertEqual(file["force_x_mean"].shape, ())
            self.assertEqual(int(file["status"][()]), 0)

    def test_files_can_be_swept(self):
        self.write("name = 'sharp'\nshape = 'flat'\ndiameter_mm = 12.0\nflutes = 2\nhelix_deg = 30.0\n",
                   "flat.toml")
        self.write("shape = 'ball'\ndiameter_mm = 10.0\nflutes = 4\nhelix_deg = 20.0\n", "ball.toml")
        own = SLOT[SLOT.index("[cutter]"):SLOT.index("[coefficients]")]
        self.write(SLOT.replace(own, "") + '[sweep.axes]\n"cutter.cutter_file" = '
                   '["flat.toml", "ball.toml"]\n"cutter.flutes" = [2, 3]\n')
        self.millstudy("run", "study.toml", "--block-size", "1")
        self.millstudy("run", "study.toml", "--block-size", "4", "-o", "one_block.h5")
        self.write(SLOT)
        self.millstudy("run", "study.toml", "-o", "alone.h5", "--set", "cutter.shape=ball", "--set",
                       "cutter.diameter_mm=10", "--set", "cutter.flutes=3", "--set",
                       "cutter.helix_deg=20")
        with h5py.File(self.folder / "slot.h5") as file, \
                h5py.File(self.folder / "one_block.h5") as other, \
                h5py.File(self.folder / "alone.h5") as alone:
            self.assertEqual(file["cutter_file"].asstr()[()].tolist(), ["flat.toml", "ball.toml"])
            for name in ("force_x_mean", "torque_mean", "feed_per_tooth"):
                self.assertEqual(file[name][1, 1], alone[name][()])
                self.assertEqual(file[name][()].tobytes(), other[name][()].tobytes())


    def test_lists_can_be_swept(self):
        self.write(SLOT.replace("flutes = 2", "flutes = 4") + '[sweep.axes]\n"cutter.pitch_deg" = '
                   "[[90, 90, 90, 90], [80, 100, 80, 100], [120, 120, 120]]\n")
        done = self.millstudy("run", "study.toml", code=3)
        self.assertIn("  1 failed: cutter.pitch_deg must have one angle for each flute\n", done.stdout)
        with h5py.File(self.folder / "slot.h5") as file:
            self.assertEqual(file["pitch_deg"].asstr()[()].tolist(),
                             ["90 90 90 90", "80 100 80 100", "120 120 120"])
            self.assertEqual(file["status"][()].tolist(), [0, 0, 1])

    def test_outputs_that_are_asked_for(self):
        self.write(SLOT.replace("helix_deg = 30.0", "helix_deg = 30.0\nstick_out_mm = 40.0") +
                   '[output]\nharmonics = 2\nper_flute = true\n[sweep.axes]\n"cutter.flutes" = [1, 3]\n')
        self.millstudy("run", "study.toml")
        with h5py.File(self.folder / "slot.h5") as file:
            self.assertEqual((file["status"][()] == 0).tolist(), [True, True])
            for name in ("force_x_harmonic_1", "force_z_harmonic_2", "torque_harmonic_2",
                         "bending_moment_max", "flute_1_load_share", "power_max"):
                self.assertTrue(numpy.isfinite(file[name][()]).all(), name)
            share = file["flute_3_load_share"][()]
            self.assertEqual(numpy.isnan(share).tolist(), [True, False])
            self.assertNotIn("force_x_harmonic_3", file)
            self.assertNotIn("flute_4_load_share", file)
        self.millstudy("export", "slot.h5", "-o", "slot.csv")

    def test_coefficients_beyond_their_range_are_used_with_a_warning(self):
        self.write(SLOT.replace("[numerics]", "valid_feed_per_tooth_mm = [0.01, 0.05]\n[numerics]"))
        warning = ("warning: study.toml:17: feed per tooth of 0.06 mm leaves "
                   "coefficients.valid_feed_per_tooth_mm = [0.01, 0.05]: the coefficients are "
                   "extrapolated\n")
        for verb in ("plan", "run", "run"):  # the second run finds the result of the first
            self.assertEqual(self.millstudy(verb, "study.toml").stderr, warning)


class StudyHash(ProgramTest):
    """The hash is of what is computed, not of how the study says it."""

    def hash_of(self, text, *arguments):
        self.write(text)
        self.write(CURVE, "curve.toml")
        return json.loads(self.millstudy("plan", "study.toml", "--json", *arguments).stdout)["study_hash"]

    def test_words_and_defaults_do_not_count(self):
        plain = self.hash_of(SLOT)
        self.assertEqual(plain, self.hash_of("# a comment\n" + SLOT.replace('"slot"\nkind', '"a"\nkind')))
        self.assertEqual(plain, self.hash_of(SLOT.replace("[cutter]", 'description = "why"\n[cutter]')))
        self.assertEqual(plain, self.hash_of(SLOT.replace("[numerics]", "[numerics]\nrule = \"exact\"")))
        self.assertEqual(plain, self.hash_of(SLOT.replace("12.0", "12")))

    def test_values_count(self):
        plain = self.hash_of(SLOT)
        self.assertNotEqual(plain, self.hash_of(SLOT.replace("= 0.5", "= 0.5000000001")))
        self.assertNotEqual(plain, self.hash_of(SLOT, "--set", "cut.axial_depth_mm=0.6"))
        self.assertNotEqual(plain, self.hash_of(SLOT + "[output]\ntraces = true\n"))

    def test_axes_and_limits_count(self):
        swept = SLOT + '[sweep.axes]\n"cutter.helix_deg" = [0.0, 30.0]\n'
        limit = '[[sweep.where]]\nquantity = "feed_per_tooth_mm"\nmax = 0.1\n'
        hashes = {self.hash_of(SLOT), self.hash_of(swept), self.hash_of(swept.replace("30.0]", "31.0]")),
                  self.hash_of(swept + limit), self.hash_of(swept + limit.replace("max", "min"))}
        self.assertEqual(len(hashes), 5)

    def test_contents_of_files_count(self):
        self.write(CURVED_SLOT)
        self.write(CURVE, "curve.toml")
        self.millstudy("run", "study.toml")
        self.write("# the same curve\n" + CURVE, "curve.toml")
        self.assertIn("already done", self.millstudy("run", "study.toml").stdout)
        self.write(CURVE.replace("[2.0, 2.0]", "[2.0, 2.1]"), "curve.toml")
        self.assertIn("holds the result of another study", self.refused("run", "study.toml"))

    def test_overrides_are_recorded(self):
        self.write(SLOT)
        self.millstudy("run", "study.toml", "-o", "a.h5")
        self.millstudy("run", "study.toml", "-o", "b.h5", "--set", "cut.axial_depth_mm=0.6", "--set",
                       "cutter.flutes=3")
        a, b = attributes(self.folder / "a.h5"), attributes(self.folder / "b.h5")
        self.assertEqual(a["overrides"], "")
        self.assertEqual(b["overrides"], "cut.axial_depth_mm=0.6\ncutter.flutes=3\n")
        self.assertNotEqual(a["study_hash"], b["study_hash"])
        self.assertEqual(b["study"], SLOT)


class Plan(ProgramTest):
    def test_prints_points_time_and_size_and_writes_nothing(self):
        self.write(RADIAL)
        before = self.files()
        said = self.millstudy("plan", "study.toml").stdout
        self.assertRegex(said, r"cut\.radial_depth_mm +4 values: 3, 12, 13, 20 mm\n")
        for line in (r"points:  8", r"time:    about .+ on \d+ threads? \(8 points measured\)",
                     r"memory:  about \d", r"file:    about \d"):
            self.assertRegex(said, "(?m)^" + line)
        self.assertEqual(self.files(), before)

    def test_json(self):
        self.write(RADIAL)
        plan = json.loads(self.millstudy("plan", "study.toml", "--json").stdout)
        self.assertEqual(plan["points"], 8)
        self.assertEqual(plan["dimensions"], ["radial_depth_mm", "feed_rate_mm_per_min"])
        self.assertEqual(plan["shape"], [4, 2])

    def test_the_result_is_as_large_as_planned(self):
        axes = '[sweep.axes]\n"cut.axial_depth_mm" = { from = 0.1, to = 9.0, count = %d }\n' \
               '"cutter.helix_deg" = { from = 0.0, to = 50.0, count = %d }\n'
        for text in (SLOT, SLOT + axes % (2, 3), SLOT + axes % (300, 301),
                     SLOT + "[output]\ntraces = true\n" + axes % (5, 2)):
            self.write(text)
            planned = json.loads(self.millstudy("plan", "study.toml", "--json").stdout)["file_bytes"]
            self.millstudy("run", "study.toml", "-o", "R.h5", "--fresh")
            size = (self.folder / "R.h5").stat().st_size
            self.assertLess(abs(planned / size - 1.0), 0.1, f"{planned:.0f} of {size}")

    def test_slow_points_are_not_timed_by_the_thousand(self):
        self.write(SLOT.replace("angular_steps = 90",
                                'angular_steps = 1000\nrule = "discs"\ndiscs = 500_000') +
                   '[sweep.axes]\n"cut.axial_depth_mm" = { from = 0.1, to = 9.0, count = 1000 }\n'
                   '"cut.spindle_speed_rpm" = { from = 9000.0, to = 20000.0, count = 1000 }\n')
        self.assertIn("points:  1,000,000\n", self.millstudy("plan", "study.toml", timeout=20).stdout)


class Other(ProgramTest):
    def test_version_and_help(self):
        self.assertRegex(self.millstudy("--version").stdout, r"\A(millstudy )?\d+\.\d+\.\d+ ?.*\n\Z")
        for verb in ("plan", "run", "export", "keys"):
            self.assertIn("Usage: millstudy " + verb, self.millstudy(verb, "--help").stdout)

    def test_every_key_of_the_reference_is_known(self):
        listed = re.findall(r"^  ([a-z_]+\.[A-Za-z_0-9]+) ", self.millstudy("keys", "force").stdout, re.M)
        self.assertIn("cut.axial_depth_mm", listed)
        self.assertEqual(len(listed), len(set(listed)))


if __name__ == "__main__":
    unittest.main()

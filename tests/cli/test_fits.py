# SPDX-License-Identifier: MIT
"""millstudy fit: coefficients out of traces, their files, and what bad input is told."""
import json
import math
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np
import xarray

from program import PROGRAM, SLOT, SOURCE, ProgramTest

TRUTH = {"Ktc": 1800.0, "Krc": 700.0, "Kac": 350.0, "Kte": 22.0, "Kre": 30.0, "Kae": 4.0}
FIT = """\
schema_version = 1
[fit]
name = "slots"
method = "average"
[cutter]
shape = "flat"
diameter_mm = 12.0
flutes = 2
helix_deg = 30.0
[cut]
axial_depth_mm = 2.0
milling = "slot"
spindle_speed_rpm = 3000.0
[trace]
axes = { x = "Fx", y = "Fy", z = "Fz" }
"""
RECORD = """[[record]]
file = "{0}.csv"
cut = {{ feed_rate_mm_per_min = {0}.0 }}
"""


def slot_forces(feed_rate, samples=2000, rate=5017.31):
    """Forces of a slot without helix by hand: two teeth, one of them in the cut."""
    feed = feed_rate / 6000.0
    rows = []
    for i in range(samples):
        phi = (0.3 + 2.0 * math.pi * 50.0 * i / rate) % math.pi
        s, c = math.sin(phi), math.cos(phi)
        area = feed * s * 2.0
        t = TRUTH["Ktc"] * area + TRUTH["Kte"] * 2.0
        r = TRUTH["Krc"] * area + TRUTH["Kre"] * 2.0
        a = TRUTH["Kac"] * area + TRUTH["Kae"] * 2.0
        rows.append((i / rate, -t * c - r * s, t * s - r * c, -a))
    return rows


class Fits(ProgramTest):
    def write_slots(self, feeds=(200, 400, 600)):
        for feed in feeds:
            lines = ["Time,Fx,Fy,Fz", "s,N,N,N"]
            lines += [",".join(f"{v:.12g}" for v in row) for row in slot_forces(feed)]
            self.write("\n".join(lines) + "\n", f"{feed}.csv")
        return "".join(RECORD.format(feed) for feed in feeds)

    def copy_traces(self):
        shutil.copytree(SOURCE / "data" / "traces", self.folder / "traces")

    def test_average_forces_give_the_coefficients_of_a_hand_made_slot(self):
        self.write(FIT + self.write_slots(), "fit.toml")
        out = json.loads(self.millstudy("fit", "fit.toml", "--json").stdout)
        for name, value in TRUTH.items():
            self.assertAlmostEqual(out["estimates"][name]["value"] / value, 1.0, delta=4e-3)
        self.assertEqual([record["revolutions"] for record in out["records"]], [19, 19, 19])

    def test_synthetic_records_give_their_truth_within_its_intervals(self):
        self.copy_traces()
        out = json.loads(self.millstudy("fit", "traces/fit.toml", "--json", "--quiet").stdout)
        self.assertTrue(out["converged"])
        for name, value in TRUTH.items():
            estimate = out["estimates"][name]
            self.assertLess(abs(estimate["value"] - value), 4.0 * estimate["standard_error"], name)
        for record in out["records"]:
            self.assertAlmostEqual(record["spindle_speed_rpm"], 2994.0, delta=0.05)
        # At the smallest feed runout hardly shows across the direction in which the teeth differ.
        for record in out["records"][1:]:
            self.assertAlmostEqual(record["runout_offset_mm"], 0.008, delta=0.0006)

    def test_the_synthetic_records_are_made_again(self):
        shutil.copy(SOURCE / "studies" / "dynamometer_records.toml", self.folder)
        self.millstudy("run", "dynamometer_records.toml", "--quiet")
        for point, feed in enumerate((150, 300, 450, 600, 750)):
            self.millstudy("export", "dynamometer_records.h5", "--point", str(point), "-o", "again.csv")
            again, kept = (np.loadtxt(path, delimiter=",", skiprows=2)
                           for path in (self.folder / "again.csv", SOURCE / "data" / "traces" / f"f{feed}.csv"))
            np.testing.assert_allclose(again, kept, rtol=1e-4, atol=1e-3)

    def test_the_result_opens_in_xarray_and_says_where_it_came_from(self):
        self.copy_traces()
        self.millstudy("fit", "traces/fit.toml", "-o", "r.h5", "--quiet")
        with xarray.open_dataset(self.folder / "r.h5") as data:
            self.assertEqual(list(data.coefficient_name.values[:6]), list(TRUTH))
            self.assertEqual(data.measured_x.attrs["units"], "N")
            self.assertEqual(data.sizes["record"], 5)
            np.testing.assert_allclose(data.residual_y, data.measured_y - data.predicted_y, atol=1e-9)
            part = slice(int(data.trace_start[1]), int(data.trace_start[1] + data.trace_count[1]))
            m, p = data.measured_x.values[part], data.predicted_x.values[part]
            self.assertAlmostEqual(1.0 - np.sum((m - p) ** 2) / np.sum((m - m.mean()) ** 2),
                                   float(data.r_squared_x[1]), places=9)
            self.assertIn("[fit]", data.attrs["fit"])
            np.testing.assert_allclose(np.diag(data.correlation), 1.0)
            np.testing.assert_allclose(np.sqrt(np.diag(data.covariance)), data.standard_error)

    def test_a_study_takes_the_coefficients(self):
        self.write(FIT + self.write_slots(), "fit.toml")
        self.millstudy("fit", "fit.toml", "--quiet")
        text = re.sub(r"\[coefficients\]\n(K.*\n)+",
                      '[coefficients]\ncoefficients_file = "slots.coefficients.toml"\n', SLOT)
        self.write(text, "study.toml")
        done = self.millstudy("run", "study.toml", "--quiet")
        self.assertIn("valid_axial_depth_mm", done.stderr)  # 0.5 mm were not measured
        with h5py.File(self.folder / "slot.h5") as file:
            self.assertGreater(file["force_y_mean"][()], 0.0)

    def test_one_thread_and_two_find_the_same(self):
        self.copy_traces()
        text = (self.folder / "traces" / "fit.toml").read_text().replace(', "dynamometer"', "")
        (self.folder / "traces" / "fit.toml").write_text(re.sub(r"\[\[dynamometer\.(.|\n)*?(?=\[\[record)", "", text))
        for threads in ("1", "2"):
            self.millstudy("fit", "traces/fit.toml", "-o", f"{threads}.h5", "--threads", threads, "--quiet")
        with h5py.File(self.folder / "1.h5") as one, h5py.File(self.folder / "2.h5") as two:
            for name in one:
                if one[name].dtype.kind == "f":
                    np.testing.assert_array_equal(one[name][()], two[name][()], name)

    def test_plots_are_drawn_of_both_methods(self):
        self.copy_traces()
        self.write(FIT + self.write_slots(), "fit.toml")
        self.millstudy("fit", "fit.toml", "--quiet")
        self.millstudy("fit", "traces/fit.toml", "--quiet")
        for name in ("slots", "synthetic"):
            done = subprocess.run(["/usr/bin/python3", SOURCE / "scripts" / "plot_fit.py", f"{name}.h5"],
                                  cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater((self.folder / f"{name}.png").stat().st_size, 20000)

    def faults(self, text, *names):
        self.write(text, "fit.toml")
        told = self.refused("fit", "fit.toml")
        for name in names:
            self.assertIn(name, told)
        self.assertFalse(list(self.folder.glob("*.h5")))
        self.assertFalse(list(self.folder.glob("*.coefficients.toml")))
        return told

    def test_every_fault_of_a_fit_file_is_told_with_its_line(self):
        records = self.write_slots()
        told = self.faults(
            FIT.replace("average", "averages").replace("diameter_mm", "diametre_mm") + "sampling_rat_Hz = 1.0\n"
            + records.replace("400.0 }", "-400.0 }"),
            "fit.toml:4: fit.method = \"averages\" must be one of average, instantaneous",
            "did you mean cutter.diameter_mm?", "trace.sampling_rat_Hz is not a key of a fit file; did you mean",
            "cut.feed_rate_mm_per_min = -400 mm/min must be > 0")
        self.assertEqual(len(told.splitlines()), 4)
        self.faults(FIT, "there is no [[record]]")
        self.faults("schema_version = 1\n", "[fit] is missing")
        self.faults(FIT.replace('z = "Fz"', 'z = "Fx"') + records, "fit.toml:15: axes.x and axes.z both take channel Fx")
        self.faults(FIT + records.replace("200.csv", "none.csv"), "none.csv")
        self.faults(FIT.replace('method = "average"', 'estimate = ["phase", "dynamometer"]') + records,
                    "needs modes to begin with")
        self.faults(FIT.replace('method = "average"', 'loss = "huber"') + records, "fit.loss_scale_N")
        self.faults(FIT + records + "[[dynamometer.y]]\nfrequency_Hz = -1.0\n", "dynamometer.y.frequency_Hz = -1 Hz must be > 0",
                    "dynamometer.y.damping_ratio is missing")
        self.faults(FIT.replace('method = "average"', "bootstrap = 3") + records, "fit.bootstrap = 3 must be >= 20")
        self.faults(FIT.replace("method", "prior = { Ktc_N_per_mm2 = 3 }\nmethod") + records, "mean = ...")

    def test_bad_traces_are_told_with_file_and_line(self):
        records = self.write_slots()
        good = (self.folder / "400.csv").read_text().splitlines()
        broken = {
            "unequal columns": (good[:50] + ["0.0096,1.0,2.0"] + good[51:], "400.csv:51"),
            "text among numbers": (good[:60] + ["0.0116,1.0,none,3.0"] + good[61:], "400.csv:61"),
            "NaN": (good[:70] + ["0.0136,1.0,nan,3.0"] + good[71:], "400.csv:71"),
            "too short": (good[:12], "400.csv"),
            "less than a revolution": (good[:60], "less than one revolution"),
        }
        for name, (lines, told) in broken.items():
            with self.subTest(name):
                (self.folder / "400.csv").write_text("\n".join(lines) + "\n")
                self.faults(FIT + records, told)

    def test_clipped_signals_are_warned_of(self):
        records = self.write_slots()
        lines = (self.folder / "400.csv").read_text().splitlines()
        clipped = lines[:2] + [",".join(row.split(",")[:2] + [str(min(150.0, float(row.split(",")[2])))]
                                        + row.split(",")[3:]) for row in lines[2:]]
        (self.folder / "400.csv").write_text("\n".join(clipped) + "\n")
        self.write(FIT + records, "fit.toml")
        self.assertRegex(self.millstudy("fit", "fit.toml").stdout, "400.csv: .*clip")

    def test_what_is_odd_about_a_record_is_told(self):
        self.copy_traces()
        fit = (self.folder / "traces" / "fit.toml").read_text()
        fit = re.sub(r"\[\[dynamometer\.(.|\n)*?(?=\[\[record)", "", fit.replace('"instantaneous"', '"average"').replace(', "dynamometer"', ""))

        def notes(text):
            (self.folder / "traces" / "odd.toml").write_text(text)
            return " ".join(json.loads(self.millstudy("fit", "traces/odd.toml", "--json", "--quiet", "-o", "odd.h5").stdout)["remarks"])

        self.assertNotIn("right?", notes(fit))
        self.assertIn("described far better with other axes", notes(fit.replace('x = "Fx", y = "Fy"', 'x = "Fy", y = "Fx"')))
        self.assertIn("number right", notes(fit.replace("flutes = 2", "flutes = 3")))
        path = self.folder / "traces" / "f450.csv"
        lines = path.read_text().splitlines()
        for i in (500, 900, 1300):
            cells = lines[i].split(",")
            lines[i] = ",".join([cells[0], str(float(cells[1]) + 2000.0), *cells[2:]])
        path.write_text("\n".join(lines) + "\n")
        self.assertIn("3 samples are far off the median revolution, the first at 0.0498 s", notes(fit))

    def test_a_record_without_cutting_is_refused(self):
        self.copy_traces()
        rows = np.random.default_rng(3).normal(0.0, 2.0, (2500, 3))
        lines = ["Time,Fx,Fy,Fz", "s,N,N,N"] + [f"{i / 10000.0},{a},{b},{c}" for i, (a, b, c) in enumerate(rows)]
        (self.folder / "traces" / "f450.csv").write_text("\n".join(lines) + "\n")
        self.assertIn("f450.csv: no force repeats with the spindle", self.refused("fit", "traces/fit.toml"))

    def test_cutting_and_air_are_told_apart(self):
        self.copy_traces()
        good = np.loadtxt(self.folder / "traces" / "f450.csv", delimiter=",", skiprows=2)[:, 1:]
        air = np.random.default_rng(4).normal(0.0, 2.0, (1500, 3)) + [1.5, -0.8, 2.0]
        forces = np.vstack([air, good, air]) + np.array([40.0, -30.0, 20.0])
        lines = ["Time,Fx,Fy,Fz", "s,N,N,N"] + [f"{i / 10000.0:.4f},{a},{b},{c}" for i, (a, b, c) in enumerate(forces)]
        (self.folder / "traces" / "long.csv").write_text("\n".join(lines) + "\n")
        text = (self.folder / "traces" / "fit.toml").read_text()
        text = text[:text.index("[[record]]")].replace("[trace]\n", "[trace]\ncutting_only = true\noffset_from_air = true\n")
        text = text.replace('"offset", "drift", ', "")
        (self.folder / "traces" / "long.toml").write_text(
            text + '[[record]]\nfile = "long.csv"\ncut = { feed_rate_mm_per_min = 450.0 }\n')
        out = json.loads(self.millstudy("fit", "traces/long.toml", "--json", "--quiet").stdout)
        for name, value in TRUTH.items():
            self.assertAlmostEqual(out["estimates"][name]["value"] / value, 1.0, delta=0.1, msg=name)

    def test_one_feed_cannot_give_six_coefficients_from_means(self):
        self.write_slots()
        self.faults(FIT + RECORD.format(200) + RECORD.format(200) + RECORD.format(200), "tell", "two feeds")

    def test_no_file_that_a_fit_reads_is_written_over(self):
        self.write(FIT + self.write_slots(), "fit.toml")
        trace = (self.folder / "400.csv").read_bytes()
        for option in ("-o", "--coefficients"):
            self.assertIn("400.csv: holds the trace of record 400.csv",
                          self.refused("fit", "fit.toml", option, "./400.csv"))
            self.assertIn("is the fit file itself", self.refused("fit", "fit.toml", option, "fit.toml"))
        self.assertEqual((self.folder / "400.csv").read_bytes(), trace)
        (self.folder / "400.csv").rename(self.folder / "slots.h5")  # what -o is where nobody says
        self.write((self.folder / "fit.toml").read_text().replace("400.csv", "slots.h5"), "fit.toml")
        self.assertIn("slots.h5: holds the trace", self.refused("fit", "fit.toml"))
        self.assertEqual((self.folder / "slots.h5").read_bytes(), trace)

    def test_both_outputs_are_written_or_none(self):
        self.write(FIT + self.write_slots(), "fit.toml")
        self.assertIn("cannot be one file",
                      self.refused("fit", "fit.toml", "-o", "a.toml", "--coefficients", "./a.toml"))
        self.refused("fit", "fit.toml", "--coefficients", "nowhere/a.toml")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["200.csv", "400.csv", "600.csv", "fit.toml"])

    @staticmethod
    def wait_until_caught(run):
        """Until the program catches SIGINT: it then reads its records."""
        caught, mask = 0, 1 << (signal.SIGINT - 1)
        while run.poll() is None and not caught & mask:
            status = pathlib.Path(f"/proc/{run.pid}/status").read_text()
            caught = int(re.search(r"SigCgt:\s*(\w+)", status)[1], 16)
            time.sleep(0.001)

    @staticmethod
    def wait_for_an_iteration(run):
        while (line := run.stderr.readline()) and "iteration" not in line:
            pass

    def test_an_interrupted_fit_leaves_nothing_behind(self):
        self.copy_traces()
        for moment in (self.wait_until_caught, self.wait_for_an_iteration):
            run = subprocess.Popen([PROGRAM, "fit", "traces/fit.toml", "-o", "r.h5"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            moment(run)
            run.send_signal(signal.SIGINT)
            told = run.communicate()[1]
            self.assertEqual(run.returncode, 4, told)
            self.assertIn("interrupted: nothing was written", told)
            self.assertEqual([path.name for path in self.folder.iterdir()], ["traces"])

    def test_method_average_refuses_what_it_would_ignore(self):
        extra = 'fixed = { Kte_N_per_mm = 5.0 }\nloss = "none"\nbelow_Hz = 300.0\n[cutter]'
        self.faults(FIT.replace("[cutter]", extra) + self.write_slots(), "fit.toml:5: fit.fixed is for method",
                    "fit.toml:6: fit.loss is", "fit.toml:7: fit.below_Hz is")

    def test_a_study_is_no_fit_file(self):
        self.faults(SLOT, "this is a study: millstudy run computes it")


if __name__ == "__main__":
    unittest.main()

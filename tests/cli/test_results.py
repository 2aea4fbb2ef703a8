# SPDX-License-Identifier: MIT
"""Result files and tables as other programs see them, and the same bits however computed."""
import csv
import shutil
import subprocess
import unittest

import h5py
import numpy
import xarray

from program import CURVE, CURVED_SLOT, SLOT, ProgramTest

GRID = SLOT + """\
[sweep.axes]
"cutter.shape" = ["flat", "ball"]
"cut.feed_rate_mm_per_min" = { from = 600.0, to = 3000.0, count = 25 }
"cutter.helix_deg" = [-30.0, 0.0, 30.0]
"""
ZIP = SLOT + """\
[sweep]
design = "zip"
[sweep.axes]
"cut.spindle_speed_rpm" = [14500.0, 17500.0]
"numerics.rule" = ["exact", "discs"]
"""
TRACES = "[output]\ntraces = true\n"
CURVED_SWEEP = CURVED_SLOT + TRACES + """\
[sweep.axes]
"cut.feed_rate_mm_per_min" = { from = 600.0, to = 3000.0, count = 5 }
"path.method" = ["taylor1", "newton"]
"cutter.helix_deg" = [0.0, 30.0]
"""


def contents(path):
    """{name: (type, shape, bytes)} of every dataset, compared bit by bit."""
    found = {}
    with h5py.File(path) as file:
        for name, data in file.items():
            values = data.asstr()[()].tolist() if data.dtype == object else data[()].tobytes()
            found[name] = (str(data.dtype), data.shape, values)
    return found


class SameBits(ProgramTest):
    """DESIGN: the variables do not depend on the number of threads or the size of blocks."""

    def check(self, text):
        self.write(text)
        self.write(CURVE, "curve.toml")
        self.millstudy("run", "study.toml", "-o", "r.h5", "--threads", 1, "--block-size", 7)
        expected = contents(self.folder / "r.h5")
        self.assertGreater(len(expected), 10)
        for threads, block in ((1, 1), (1, 1000), (2, 1), (2, 7), (7, 7), (7, 1), (7, 1000)):
            with self.subTest(threads=threads, block_size=block):
                self.millstudy("run", "study.toml", "-o", "other.h5", "--fresh", "--threads", threads,
                               "--block-size", block)
                self.assertEqual(contents(self.folder / "other.h5"), expected)

    def test_force(self):
        self.check(GRID + TRACES)

    def test_path_force(self):
        self.check(CURVED_SWEEP)

    def test_path(self):
        path = SLOT[:SLOT.index("[cutter]")].replace('"force"', '"path"')
        self.check(path + '[path]\ncurve_file = "curve.toml"\ninterpolation_period_s = 0.002\n'
                   '[cut]\nfeed_rate_mm_per_min = 1740.0\n[sweep.axes]\n'
                   '"path.method" = ["uniform_parameter", "taylor1", "taylor2", "predictor_corrector", '
                   '"arc_length_table", "newton"]\n"path.max_iterations" = [1, 2, 3]\n')


class OpenedElsewhere(ProgramTest):
    def check_variables(self, data):
        for name, variable in data.variables.items():
            if name == "failure":
                continue
            self.assertIn("units", variable.attrs, name)
            self.assertNotEqual(variable.attrs.get("long_name", ""), "", name)

    def test_grid(self):
        self.write(GRID)
        self.millstudy("run", "study.toml", "-o", "r.h5")
        for engine in (None, "netcdf4", "h5netcdf"):
            with self.subTest(engine=engine), \
                    xarray.open_dataset(self.folder / "r.h5", engine=engine) as data:
                self.check_variables(data)
                force = data["force_resultant_mean"]
                self.assertEqual(force.dims, ("shape", "feed_rate_mm_per_min", "helix_deg"))
                self.assertEqual(force.shape, (2, 25, 3))
                self.assertEqual(data["feed_rate_mm_per_min"].attrs["units"], "mm min-1")
                self.assertEqual(data["helix_deg"].attrs["units"], "degree")
                one = force.sel(shape="ball", feed_rate_mm_per_min=700.0, helix_deg=30.0)
                self.assertGreater(float(one), 0.0)
                self.assertEqual(int((data["status"] != 0).sum()), 0)

    def test_zip(self):
        self.write(ZIP)
        self.millstudy("run", "study.toml", "-o", "r.h5")
        for engine in (None, "netcdf4", "h5netcdf"):
            with self.subTest(engine=engine), \
                    xarray.open_dataset(self.folder / "r.h5", engine=engine) as data:
                self.check_variables(data)
                self.assertEqual(data["power_mean"].dims, ("point",))
                self.assertIn("spindle_speed_rpm", data["power_mean"].coords)
                self.assertEqual(data["spindle_speed_rpm"].attrs["units"], "min-1")
                self.assertEqual(data["rule"].values.tolist(), ["exact", "discs"])

    def test_single_point_with_traces(self):
        self.write(SLOT + TRACES)
        self.millstudy("run", "study.toml", "-o", "r.h5")
        for engine in (None, "netcdf4", "h5netcdf"):
            with self.subTest(engine=engine), \
                    xarray.open_dataset(self.folder / "r.h5", engine=engine) as data:
                self.check_variables(data)
                self.assertEqual(data["force_x_mean"].dims, ())
                self.assertEqual(data["trace_force_x"].dims, ("sample",))

    @unittest.skipUnless(shutil.which("ncdump"), "ncdump is not installed")
    def test_ncdump(self):
        self.write(GRID)
        self.write(ZIP, "zip.toml")
        self.millstudy("run", "study.toml", "-o", "grid.h5")
        self.millstudy("run", "zip.toml", "-o", "zip.h5")
        for name, line in (("grid", "double power_mean(shape, feed_rate_mm_per_min, helix_deg) ;"),
                           ("zip", 'power_mean:coordinates = "spindle_speed_rpm rule" ;')):
            header = subprocess.run(["ncdump", "-h", f"{name}.h5"], cwd=self.folder, text=True,
                                    capture_output=True, check=True).stdout
            self.assertIn(line, header)
            self.assertIn('power_mean:units = "W" ;', header)

    def test_range_values_are_those_a_person_expects(self):
        self.write(SLOT + '[sweep.axes]\n"cut.feed_rate_mm_per_min" = { from = 600.0, to = 3000.0, '
                   'count = 25 }\n"cutter.flutes" = { from = 1, to = 100, count = 3, spacing = "log" }\n')
        self.millstudy("run", "study.toml", "-o", "r.h5")
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(file["feed_rate_mm_per_min"][()].tolist(),
                             [600.0 + 100.0 * i for i in range(25)])
            self.assertEqual(file["flutes"][()].tolist(), [1.0, 10.0, 100.0])


class Traces(ProgramTest):
    def check(self, text):
        self.write(text)
        self.write(CURVE, "curve.toml")
        self.millstudy("run", "study.toml", "-o", "r.h5")
        with h5py.File(self.folder / "r.h5") as file:
            start, count = file["trace_start"][()].ravel(), file["trace_count"][()].ravel()
            self.assertEqual(start[0], 0)
            self.assertEqual((start + count)[:-1].tolist(), start[1:].tolist())
            self.assertEqual((start + count)[-1], file["trace_time"].shape[0])
            status = file["status"][()].ravel()
            self.assertTrue((count[status == 0] > 0).all())
            self.assertTrue((count[status != 0] == 0).all())
            for axis in "xyz":
                samples = file[f"trace_force_{axis}"][()]
                self.assertEqual(samples.dtype, numpy.float32)
                for statistic, of in (("max", numpy.max), ("min", numpy.min)):
                    known = file[f"force_{axis}_{statistic}"][()].ravel()
                    for i in numpy.flatnonzero(status == 0):
                        trace = samples[start[i]:start[i] + count[i]]
                        self.assertEqual(of(trace), numpy.float32(known[i]))
            for i in numpy.flatnonzero(status == 0):
                time = file["trace_time"][start[i]:start[i] + count[i]]
                self.assertEqual(time[0], 0.0)
                self.assertTrue((numpy.diff(time) > 0.0).all())
            return file["trace_angle"][()], count

    def test_of_a_revolution(self):
        angle, count = self.check(GRID + TRACES)
        self.assertEqual(set(count.tolist()), {90})
        self.assertAlmostEqual(float(angle[1]), 2.0 * numpy.pi / 90.0, places=6)

    def test_along_a_path(self):
        self.check(CURVED_SWEEP)

    def test_failed_points_have_none(self):
        text = SLOT.replace('milling = "slot"', 'milling = "down"') + TRACES
        self.write(text + '[sweep.axes]\n"cut.radial_depth_mm" = [20.0, 3.0, 13.0, 6.0]\n')
        self.millstudy("run", "study.toml", "-o", "r.h5", code=3)
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(file["trace_count"][()].tolist(), [0, 90, 0, 90])
            self.assertEqual(file["trace_start"][()].tolist(), [0, 0, 90, 90])


class Export(ProgramTest):
    def test_csv_and_npy_hold_the_result(self):
        self.write(GRID)
        self.millstudy("run", "study.toml", "-o", "r.h5")
        for name in ("t.csv", "t.npy"):
            self.assertEqual(self.millstudy("export", "r.h5", "-o", name).stdout, name + "\n")
        with open(self.folder / "t.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        npy = numpy.load(self.folder / "t.npy")
        self.assertEqual(len(rows), 150)
        self.assertEqual(npy.shape, (150,))
        with h5py.File(self.folder / "r.h5") as file:
            for name, units in (("force_x_mean", "N"), ("torque_max", "N m"), ("feed_per_tooth", "mm")):
                values = file[name][()].ravel()
                self.assertEqual(npy[name].tobytes(), values.tobytes())
                self.assertEqual([float(row[f"{name} [{units}]"]) for row in rows], values.tolist())
            feeds = numpy.tile(numpy.repeat(file["feed_rate_mm_per_min"][()], 3), 2)
            self.assertEqual(npy["feed_rate_mm_per_min"].tolist(), feeds.tolist())
            self.assertEqual(npy["shape"].tolist(), ["flat"] * 75 + ["ball"] * 75)
            self.assertEqual([row["shape"] for row in rows], ["flat"] * 75 + ["ball"] * 75)

    def test_an_existing_table_is_replaced_whole(self):
        self.write(GRID)
        self.write("old", "t.csv")
        self.millstudy("run", "study.toml", "-o", "r.h5")
        self.millstudy("export", "r.h5", "-o", "t.csv")
        self.assertEqual(len((self.folder / "t.csv").read_text().splitlines()), 151)
        self.assertEqual(sorted(self.files()), ["r.h5", "study.toml", "t.csv"])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: MIT
"""Compares what the readers of traces give with what NumPy, SciPy, h5py and xarray read from the same file.

Usage: check_traces.py PRINT_TRACE MILLSTUDY (written|measured). `written`: files that SciPy, h5py and millstudy write.
`measured`: recordings that are no part of the project, looked for in $MILLSTUDY_MEASURED_DIR or beside the repository;
without them it is skipped (exit 77).
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
import scipy.io
import xarray

ROOT = pathlib.Path(__file__).resolve().parents[4]
PRINT_TRACE, MILLSTUDY, PART = sys.argv[1:4]
MEASURED = pathlib.Path(os.environ.get("MILLSTUDY_MEASURED_DIR", ROOT.parent / "shared" / "measured"))


def read(file, *words):
    """Format, rate, remarks, column names, values of shape (samples, columns)."""
    done = subprocess.run([PRINT_TRACE, str(file), *words], text=True, capture_output=True)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    lines = done.stdout.splitlines()
    remarks = [line[7:] for line in lines if line.startswith("remark ")]
    first = next(i for i, line in enumerate(lines) if line.startswith("columns"))
    values = np.array([line.split() for line in lines[first + 1:]], float)
    return lines[0][7:], float(lines[1][5:]), remarks, lines[first].split()[1:], values


class Written(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="millstudy-traces-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        random = np.random.default_rng(1)
        self.values = random.normal(size=(4321, 3)) * 10.0 ** random.integers(-9, 9, size=(4321, 3))

    def test_scipy_matlab_files(self):
        x, y, z = self.values.T
        for compressed in (False, True):
            for orientation in ("row", "column"):
                file = self.folder / f"{compressed}{orientation}.mat"
                scipy.io.savemat(file, {"Fx": x, "s": {"Fy": y, "more": {"Fz": z.astype("f4")}}, "n": np.arange(7),
                                        "all": self.values, "note": "text"},
                                 do_compression=compressed, oned_as=orientation)
                name, _, _, _, values = read(file, "a=Fx", "b=s.Fy", "c=s.more.Fz", "d=all(:,3)")
                self.assertEqual(name, "MATLAB 5")
                np.testing.assert_array_equal(values, np.stack([x, y, z.astype("f4"), z], 1))

    def test_h5py_files(self):
        x, y, z = self.values.T
        for libver in ("earliest", "v108", "latest"):
            file = self.folder / f"{libver}.h5"
            with h5py.File(file, "w", libver=libver) as out:
                out.create_dataset("run/x", data=x, chunks=(1000,), compression="gzip", shuffle=True)
                out["run/x"].attrs["units"] = "kN"  # a text of variable length
                out["y"] = y.astype(">f4")
                out["all"] = self.values
            _, _, _, columns, values = read(file, "a=run/x", "b=y", "c=all[:,2]")
            self.assertEqual(columns, ["a[kN]", "b[]", "c[]"])
            np.testing.assert_array_equal(values, np.stack([x, y.astype("f4"), z], 1))

    def test_numpy_tables(self):
        for separator in (",", ";", "\t", " "):
            file = self.folder / "table.txt"
            np.savetxt(file, self.values, delimiter=separator, header=separator.join(("Fx", "Fy", "Fz")), fmt="%.17g")
            _, _, _, columns, values = read(file)
            self.assertEqual(columns, ["Fx[]", "Fy[]", "Fz[]"])
            np.testing.assert_array_equal(values, self.values)
            file.write_text(file.read_text().replace(",", ";").replace(".", ","))  # another locale
            np.testing.assert_array_equal(read(file)[4], self.values)

    def test_histories_of_a_study(self):
        study = self.folder / "study.toml"
        study.write_text((ROOT / "studies" / "haber2004_slot.toml").read_text())
        text = study.read_text()
        self.assertIn("traces = true", text)
        text = text.replace('"../data/', f'"{ROOT}/data/')
        study.write_text(text)
        result = self.folder / "result.h5"
        subprocess.run([MILLSTUDY, "run", study, "-o", result, "--quiet"], check=True)
        with xarray.open_dataset(result) as data:
            starts, counts = data.trace_start.values.ravel(), data.trace_count.values.ravel()
            self.assertGreater(len(starts), 1)
            for point, (start, count) in enumerate(zip(starts, counts)):
                _, _, _, columns, values = read(result, f"point={point}")
                self.assertEqual(columns, ["time", "Fx[N]", "Fy[N]", "Fz[N]"])
                names = ("trace_time", "trace_force_x", "trace_force_y", "trace_force_z")
                expected = np.stack([data[name].values[start:start + count] for name in names], 1)
                np.testing.assert_array_equal(values, expected)


class Measured(unittest.TestCase):
    def test_dynoware(self):
        files = sorted((MEASURED / "flat_slot_2018").glob("*.csv"))
        self.assertEqual(len(files), 5)
        for file in files:
            name, rate, remarks, columns, values = read(file)
            self.assertEqual((name, rate), ("DynoWare text", 10000.0))
            self.assertEqual(columns, ["time", "Fx[N]", "Fy[N]", "Fz[N]"])
            self.assertEqual(remarks, ["the header says 500001 samples, the file holds 10001"])
            np.testing.assert_array_equal(values, np.loadtxt(file, delimiter=",", skiprows=20))

    def test_dynoware_of_another_locale(self):
        """Decimal commas between commas: some rows have whole numbers."""
        for file in sorted((MEASURED / "flat_slot_2018").glob("*.csv")):
            self.compare_in_another_locale(file)

    def compare_in_another_locale(self, file):
        expected = np.loadtxt(file, delimiter=",", skiprows=20)
        with tempfile.TemporaryDirectory(prefix="millstudy-traces-") as folder:
            local = pathlib.Path(folder) / "local.csv"
            local.write_text(file.read_text().replace(".", ","))
            _, _, remarks, _, values = read(local)
            np.testing.assert_array_equal(values, expected)
            self.assertEqual(len(remarks), 2)
            print(remarks[0])

    def test_matlab(self):
        file = MEASURED / "bull_nose_2017" / "bull_nose_slots.mat"
        known = scipy.io.loadmat(file)
        for depth in range(1, 6):
            names = [f"F{axis}_R_{depth}" for axis in "xyz"]
            _, _, _, _, values = read(file, *(f"F{axis}={name}" for axis, name in zip("xyz", names)))
            np.testing.assert_array_equal(values, np.stack([known[name].ravel() for name in names], 1))


if __name__ == "__main__":
    if PART == "measured" and not MEASURED.is_dir():
        print(f"no measurements in {MEASURED}: skipped")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], "Measured" if PART == "measured" else "Written"])

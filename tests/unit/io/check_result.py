#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens results of every shape with what users open them with; any warning is an error.

check_result.py MAKE_IO_SAMPLES   (the program that writes the samples; docs/result_file.md)
"""
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile
import warnings

import h5netcdf  # noqa: F401  imported before warnings become errors: they are its own
import h5py
import netCDF4  # noqa: F401
import numpy as np
import xarray as xr

warnings.simplefilter("error")
warnings.filterwarnings("ignore", category=DeprecationWarning)  # of these packages' own code

ENGINES = ["netcdf4", "h5netcdf"]
COLUMNS = {"force_resultant_mean": "N", "feed_fluctuation_max": "percent", "steps": "1"}
SAMPLES = ["trace_time", "trace_angle", "trace_force_x", "trace_force_y", "trace_force_z"]
SHAPES = {"scalar": (), "grid1": (40,), "grid2": (3, 50), "grid3": (4, 10, 12),
          "grid4": (5, 3, 6, 2), "same": (12, 12), "zip": (100,)}
WITH_TRACES = {"grid3", "same", "zip"}
METHODS = ["taylor1", "taylor2", "newton", "größer"]


def expected_status(points):
    index = np.arange(points)
    return np.where(index % 7 == 3, 1, np.where(index % 11 == 5, 2, 0))


def check_dimensions(name, data):
    shape = SHAPES[name]
    assert data["status"].shape == shape, data["status"].shape
    if name == "zip":
        assert data["status"].dims == ("point",)
        assert list(data["point"].values) == list(range(100))
        for parameter in ("axis_0", "feed_rate_mm_per_min", "spindle_speed_rpm"):
            assert parameter in data["steps"].coords, parameter
            assert data[parameter].dims == ("point",)
            assert data[parameter].attrs["units"] == "mm/min"
        return
    for axis, dimension in enumerate(data["status"].dims):
        assert dimension == ("method" if axis == 0 and shape[0] <= 4 else f"axis_{axis}")
        assert dimension in data.coords
        assert "units" in data[dimension].attrs and "long_name" in data[dimension].attrs
        assert "_FillValue" not in data[dimension].encoding
        if dimension == "method":
            assert list(data["method"].values) == METHODS[:shape[0]], data["method"].values
        else:
            assert list(data[dimension].values) == [600.0 + 100 * i for i in range(shape[axis])]


def check_points(name, data):
    shape = SHAPES[name]
    points = int(np.prod(shape))
    status = expected_status(points).reshape(shape)
    assert data["status"].dtype == np.int8
    assert (data["status"].values == status).all()
    assert list(data["status"].attrs["flag_values"]) == [0, 1, 2, 3]
    assert data["status"].attrs["flag_meanings"] == "ok failed skipped not_run"
    assert data["failure_code"].dtype == np.int32
    assert ((data["failure_code"].values > 0) == (status == 1)).all()
    table = data["failure"].values
    assert table[0] == "none" and data["failure"].dims == ("failure",)
    if points > 10:
        assert list(table[1:]) == ["the chord is too long",
                                   'the path, "as given", has no length'], table
    for column, units in COLUMNS.items():
        assert data[column].dims == data["status"].dims
        assert data[column].attrs["units"] == units and data[column].attrs["long_name"]
        assert np.isnan(data[column].encoding["_FillValue"]), column
        assert (np.isnan(data[column].values) == (status != 0)).all()
    steps = data["steps"].values
    assert (steps[status == 0] == np.arange(points).reshape(shape)[status == 0]).all()
    for variable in data.variables:
        assert "units" in data[variable].attrs, variable
        assert "long_name" in data[variable].attrs, variable


def check_traces(data):
    count = data["trace_count"].values.ravel()
    start = data["trace_start"].values.ravel()
    status = data["status"].values.ravel()
    assert data["trace_count"].attrs["sample_dimension"] == "sample"
    assert (count == np.where(status == 0, np.arange(count.size) % 5, 0)).all()
    assert (start == np.concatenate([[0], np.cumsum(count)[:-1]])).all()
    for name in SAMPLES:
        assert data[name].dims == ("sample",) and data[name].dtype == np.float32
        assert data[name].size == count.sum()
    assert data["trace_time"].attrs["units"] == "s"
    assert all(np.isnan(data[name].encoding["_FillValue"]) for name in SAMPLES)
    part = data.isel(sample=slice(int(start[4]), int(start[4] + count[4])))
    assert list(part["trace_time"].values) == [4.0, 4.125, 4.25, 4.375]


def check_with_xarray(name, path):
    datasets = []
    for engine in ENGINES:
        with xr.open_dataset(path, engine=engine) as data:
            data.load()
            check_dimensions(name, data)
            check_points(name, data)
            if name in WITH_TRACES:
                check_traces(data)
            assert data.attrs["Conventions"] == "CF-1.8"
            assert data.attrs["study"] == 300000 * "x" + "end"
            assert int(data.attrs["points_failed"]) == 3
            assert float(data.attrs["wall_time_s"]) == 1.5
            assert data.attrs["host"] == ""
            datasets.append(data)
    with xr.open_dataset(path) as data:
        xr.testing.assert_identical(data.load().drop_attrs() if hasattr(data, "drop_attrs")
                                    else data, datasets[0])
    xr.testing.assert_equal(*datasets)


def check_with_h5py(path):
    with h5py.File(path) as file:
        assert len(file.attrs["study"]) == 300003
        for name, dataset in file.items():
            scale = dataset.attrs.get("CLASS") == b"DIMENSION_SCALE"
            attached = [len(dimension) for dimension in dataset.dims]
            assert scale or all(n == 1 for n in attached), (name, attached)


def check_with_ncdump(name, path):
    header = subprocess.run(["ncdump", "-h", path], check=True, capture_output=True, text=True)
    assert not header.stderr, header.stderr
    for line in ('steps:units = "1"', ':Conventions = "CF-1.8"', ':title = "sample"',
                 'status:flag_values = 0b, 1b, 2b, 3b'):
        assert line in header.stdout, (name, line, header.stdout[:3000])
    if name in WITH_TRACES:
        assert "sample = UNLIMITED" in header.stdout, header.stdout[:1000]


def check_tables(path):
    """The .npy and the .csv of a result say what the result says."""
    table = np.load(path.replace(".h5", ".npy"))
    with open(path.replace(".h5", ".csv"), newline="", encoding="utf-8") as file:
        titles, *rows = csv.reader(file)
    assert [title.split(" [")[0] for title in titles] == list(table.dtype.names)
    assert "force_resultant_mean [N]" in titles and "steps" in titles
    with xr.open_dataset(path) as data:
        reasons = np.where(data["failure_code"] > 0, data["failure"].values[data["failure_code"]], "")
        words = np.array(["ok", "failed", "skipped", "not_run"])[data["status"]]
        assert (table["failure"] == reasons.ravel()).all()
        assert (table["status"] == words.ravel()).all()
        for name in set(table.dtype.names) - {"failure", "status"}:
            expected = np.ravel(xr.broadcast(data[name], data["status"])[0].transpose(
                *data["status"].dims).values)
            field = [row[titles.index(next(t for t in titles if t.split(" [")[0] == name))]
                     for row in rows]
            if expected.dtype.kind == "f":
                np.testing.assert_array_equal(table[name], expected)
                np.testing.assert_array_equal([float(text or "nan") for text in field], expected)
            elif name != "point":
                assert (table[name] == expected).all() and (field == expected).all(), name


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], folder], check=True)
        for name in SHAPES:
            path = str(pathlib.Path(folder) / f"{name}.h5")
            check_with_xarray(name, path)
            check_with_h5py(path)
            if pathlib.Path(path.replace(".h5", ".npy")).exists():
                check_tables(path)
            if shutil.which("ncdump"):
                check_with_ncdump(name, path)
            print(f"{name}: opened by xarray ({', '.join(ENGINES)}), h5py, ncdump")


if __name__ == "__main__":
    main()

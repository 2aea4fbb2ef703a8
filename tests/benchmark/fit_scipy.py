#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Times the joint fit of five measured bull-nose slots against scipy.optimize.least_squares on a NumPy model, in one run.

Usage: fit_scipy.py MILLSTUDY [--samples N] [--nfev N]. Both fit six coefficients, and phase, spindle speed, runout and offsets of each
record, to all samples of x, y and z. The NumPy model is vectorised over samples and edge nodes; derivatives are scipy's own differences, or with
--grouped differences that know that parameters of a record change that record only. scipy begins next to the solution that millstudy found from nothing. The ratio is that of the joint fits; the time of the whole program (reading,
search of the phase, fit, errors, five fits with a record left out, result file) is printed beside it.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy.io
import scipy.optimize

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "validation"))
from measured_fits import bull_nose, measured_folder  # noqa: E402

RATE = 10000.0
FLUTES = 2
RADIUS, CORNER, TANGENT = 8.0, 3.0, np.tan(np.radians(25.0))
SHARED, OWN = 6, 7  # coefficients; phase, speed, runout cos and sin, three offsets


def edge_nodes(depth):
    """Heights' lag, sin and cos of kappa, chip width and edge length of Gauss nodes along the edge."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    turn = np.arccos(max(0.0, 1.0 - depth / CORNER))
    kappa, step = 0.5 * turn * (1.0 + nodes), 0.5 * turn * weights
    r, dr, dz = RADIUS - CORNER + CORNER * np.sin(kappa), CORNER * np.cos(kappa), CORNER * np.sin(kappa)
    lag = CORNER * (1.0 - np.cos(kappa)) * TANGENT / RADIUS
    columns = [lag, np.sin(kappa), np.cos(kappa), CORNER * step,
               np.sqrt(dr**2 + dz**2 + (r * dz * TANGENT / RADIUS) ** 2) * step]
    if depth > CORNER:
        z, step = CORNER + 0.5 * (depth - CORNER) * (1.0 + nodes), 0.5 * (depth - CORNER) * weights
        line = [z * TANGENT / RADIUS, np.ones_like(z), np.zeros_like(z), step, np.sqrt(1.0 + TANGENT**2) * step]
        columns = [np.concatenate(pair) for pair in zip(columns, line)]
    return columns


class Record:
    def __init__(self, forces, depth, feed_rate):
        self.forces = forces
        self.edge = edge_nodes(depth)
        self.feed_rate = feed_rate
        self.time = (np.arange(forces.shape[1]) - 0.5 * (forces.shape[1] - 1)) / RATE

    def residual(self, k, own):
        phase, speed, ex, ey = own[:4]
        lag, sine, cosine, width, length = (column[None, :] for column in self.edge)
        feed = self.feed_rate * 2.0 * np.pi / (speed * FLUTES)
        sums = np.zeros_like(self.forces)
        for flute in range(FLUTES):
            phi = (phase + speed * self.time + np.pi * flute)[:, None] - lag
            position = np.pi * flute - lag
            s, c = np.sin(phi), np.cos(phi)
            ahead = 2.0 * (ex * np.cos(position) + ey * np.sin(position))
            h = np.minimum(feed * s + ahead, 2.0 * feed * s) * sine
            cuts = (s > 0.0) & (h > 0.0)
            t, r, a = (np.where(cuts, k[i] * h * width + k[3 + i] * length, 0.0) for i in range(3))
            sums[0] += np.sum(-t * c - (r * sine + a * cosine) * s, axis=1)
            sums[1] += np.sum(t * s - (r * sine + a * cosine) * c, axis=1)
            sums[2] += np.sum(r * cosine - a * sine, axis=1)
        return (sums + np.asarray(own[4:])[:, None] - self.forces).ravel()


def joint(records, x):
    return np.concatenate([record.residual(x[:SHARED], x[SHARED + OWN * i:SHARED + OWN * (i + 1)])
                           for i, record in enumerate(records)])


def jacobian(records, x):
    rows = [record.forces.size for record in records]
    out = np.zeros((sum(rows), len(x)))
    first = 0
    for i, record in enumerate(records):
        own = slice(SHARED + OWN * i, SHARED + OWN * (i + 1))
        base = record.residual(x[:SHARED], x[own])
        for column in [*range(SHARED), *range(own.start, own.stop)]:
            moved = x.copy()
            step = 1e-7 * max(1e-2, abs(x[column]))
            moved[column] += step
            out[first:first + rows[i], column] = (record.residual(moved[:SHARED], moved[own]) - base) / step
        first += rows[i]
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("millstudy")
    parser.add_argument("--samples", type=int, default=10001, help="of each record")
    parser.add_argument("--nfev", type=int, default=100, help="most evaluations by scipy")
    parser.add_argument("--grouped", action="store_true", help="derivatives that know which records a parameter changes")
    options = parser.parse_args()
    folder = measured_folder()
    data = scipy.io.loadmat(folder / "bull_nose_2017" / "bull_nose_slots.mat")
    n = options.samples
    records = [Record(np.stack([-data[f"Fy_R_{d}"].ravel()[:n], -data[f"Fx_R_{d}"].ravel()[:n], data[f"Fz_R_{d}"].ravel()[:n]]),
                      float(d), 160.0 / 60.0) for d in range(1, 6)]
    text = bull_nose(folder, "tolerance = 1e-6", seconds=n / RATE)
    with tempfile.TemporaryDirectory() as place:
        (pathlib.Path(place) / "fit.toml").write_text(text)
        begin = time.perf_counter()
        done = subprocess.run([os.path.abspath(options.millstudy), "fit", "fit.toml", "--json", "--quiet"], cwd=place, text=True,
                              capture_output=True, check=True)
        ours = time.perf_counter() - begin
    out = json.loads(done.stdout)
    squares = sum(n * rmse**2 for record in out["records"] for rmse in record["rmse_N"])
    k = [round(out["estimates"][name]["value"], -1 if name.endswith("c") else 0) for name in ("Ktc", "Krc", "Kac", "Kte", "Kre", "Kae")]
    x = list(k)
    for record in out["records"]:
        speed = round(record["spindle_speed_rpm"], 1) * np.pi / 30.0
        phase = np.radians(round(record["phase_deg"])) + speed * 0.5 * (n - 1) / RATE
        e, angle = record["runout_offset_mm"], np.radians(record["runout_angle_deg"])
        x += [phase, speed, e * np.cos(angle), e * np.sin(angle), 0.0, 0.0, 0.0]
    begin = time.perf_counter()
    solved = scipy.optimize.least_squares(lambda p: joint(records, p), np.array(x), x_scale="jac",
                                          jac=(lambda p: jacobian(records, p)) if options.grouped else "2-point", ftol=1e-6, xtol=1e-8, gtol=None, max_nfev=options.nfev)
    theirs = time.perf_counter() - begin
    print(f"{n} samples of each record, x, y and z; sums of squares: millstudy {squares:.6g} N2, scipy {2.0 * solved.cost:.6g} N2 "
          f"(Ktc {out['estimates']['Ktc']['value']:.1f}, {solved.x[0]:.1f} N/mm2)")
    solve = out["seconds"]["solve"]
    print(f"millstudy, joint fit, {out['iterations']} iterations: {solve:.3f} s; the whole program: {ours:.2f} s")
    print(f"scipy, {solved.nfev} evaluations, {solved.njev} derivatives: {theirs:.1f} s{'' if solved.success else ', not converged'}")
    print(f"ratio of the joint fits {theirs / solve:.0f}, of scipy to the whole program {theirs / ours:.1f}")


if __name__ == "__main__":
    main()

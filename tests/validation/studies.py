# SPDX-License-Identifier: MIT
"""Runs a ready-made study and compares its result with published or independent numbers.

Usage: studies.py MILLSTUDY STUDY, where STUDY names one of the functions below.
Every comparison prints the source, the number expected, ours, and the distance; a number that is
off by more than half a unit of its last printed digit (or the tolerance given) fails.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class Checker:
    def __init__(self):
        self.failures = 0

    def number(self, what, source, printed, ours, tolerance=None):
        """printed is text, so that its last digit says how exact it is."""
        expected = float(printed)
        if tolerance is None:
            mantissa, _, exponent = printed.lower().partition("e")
            decimals = len(mantissa.partition(".")[2])
            tolerance = 0.5000001 * 10.0 ** (int(exponent or 0) - decimals)
        fine = abs(ours - expected) <= tolerance
        self.failures += not fine
        print(f"{'ok  ' if fine else 'FAIL'} {what:<46} {source:<22} expected {printed:>15}  "
              f"ours {ours:.12g}  distance {ours - expected:+.2e}")

    def holds(self, what, fine, figure):
        self.failures += not fine
        print(f"{'ok  ' if fine else 'FAIL'} {what}: {figure}")


def run(program, study, folder, *overrides):
    result = pathlib.Path(folder) / "result.h5"
    result.unlink(missing_ok=True)
    command = [program, "run", str(ROOT / "studies" / f"{study}.toml"), "-o", str(result), "--quiet"]
    for override in overrides:
        command += ["--set", override]
    subprocess.run(command, check=True, stdout=subprocess.PIPE)
    with h5py.File(result) as file:
        return {name: data.asstr()[()] if h5py.check_string_dtype(data.dtype) else data[()]
                for name, data in file.items() if data.shape is not None}


def at(result, axes, **where):
    """The index of one point of a grid, by coordinate values."""
    index = []
    for axis in axes:
        wanted = where[axis]
        values = result[axis]
        index.append(list(values).index(wanted) if isinstance(wanted, str)
                     else int(np.argmin(np.abs(values - wanted))))
    return tuple(index)


def sun2008_interpolators(program, folder, check):
    axes = ["method", "max_iterations", "interpolation_period_s", "feed_rate_mm_per_min"]
    result = run(program, "sun2008_interpolators", folder)
    source = "sun2008 Table 1, own run"

    def figures(method, n):
        index = at(result, axes, method=method, max_iterations=n, interpolation_period_s=0.002,
                   feed_rate_mm_per_min=3600.0)
        steps = result["steps"][index]
        return {"max": result["feed_fluctuation_max"][index],
                "rms": result["feed_fluctuation_rms"][index], "steps": steps,
                "evaluations": result["curve_evaluations"][index] / steps,
                "time": result["path_time"][index], "length": result["path_length"][index],
                "chord": result["chord_error_max"][index]}

    expected = [  # method, N, max %, rms %, evaluations per step
        ("taylor1", 1, "6.6316", "2.20", 1), ("taylor2", 1, "1.5246", "0.248", 1),
        ("newton", 1, "2.556e-2", "5.3e-3", 2), ("newton", 2, "3.7942e-7", "5.5e-8", 3)]
    for method, n, largest, rms, evaluations in expected:
        ours = figures(method, n)
        check.number(f"{method} N={n} max fluctuation [%]", source, largest, ours["max"])
        check.number(f"{method} N={n} rms fluctuation [%]", source, rms, ours["rms"])
        check.number(f"{method} N={n} evaluations per step", source, str(evaluations),
                     ours["evaluations"], 0.02)
        check.number(f"{method} N={n} full steps", source, "344", ours["steps"], 0.0)
    floor = figures("newton", 3)
    check.holds("newton N=3 max fluctuation at the rounding floor, 4.3e-12 % within 3x",
                floor["max"] < 3 * 4.3e-12, f"{floor['max']:.2e} %")
    check.holds("newton N=3 rms at the rounding floor, 1.2e-12 % within 3x",
                floor["rms"] < 3 * 1.2e-12, f"{floor['rms']:.2e} %")
    check.number("newton N=3 evaluations per step", source, "4", floor["evaluations"], 0.02)
    two = figures("newton", 2)
    check.number("arc length [mm]", source, "41.36045561601", two["length"])
    check.number("path time [s]", source, "0.690", two["time"], 1e-12)
    check.number("chord error [um]", source, "4.86", 1e3 * two["chord"])
    table = figures("arc_length_table", 1)
    check.holds("an arc-length method ends near its floor kappa^2 (V T)^2 / 24 = 0.44 %",
                0.40 < table["max"] < 0.4415, f"{table['max']:.4f} %")
    print("the paper prints 6.63, about 1.5, about 100 times lower, 3.79e-7 %")


def haber2004_slot(program, folder, check):
    result = run(program, "haber2004_slot", folder)
    mean, largest = result["force_resultant_mean"], result["force_resultant_max"]
    source = "REFERENCE, own run"
    check.number("14 500 rpm mean resultant, exact [N]", source, "56.632", mean[0])
    check.number("17 500 rpm mean resultant, exact [N]", source, "69.9585", mean[1])
    check.number("14 500 rpm max resultant [N]", source, "83.315", largest[0])
    check.number("17 500 rpm max resultant [N]", source, "104.249", largest[1])
    for speed, printed, ours in (("14 500", "56.7", mean[0]), ("17 500", "70.6", mean[1])):
        check.number(f"{speed} rpm mean resultant [N]", "haber2004 Table II", printed, ours,
                     0.011 * float(printed))
    for speed, measured, ours in (("14 500", 55.6, mean[0]), ("17 500", 71.7, mean[1])):
        print(f"     {speed} rpm: the article measured {measured} N with a new tool; "
              f"({measured} - ours) / {measured} = {100 * (measured - ours) / measured:+.1f} %")
    for steps, printed in ((360, "56.6350"), (720, "56.6322"), (3600, "56.6318")):
        ours = run(program, "haber2004_slot", folder, f"numerics.angular_steps={steps}")
        check.number(f"mean resultant at {steps} steps [N]", source, printed,
                     ours["force_resultant_mean"][0])
    discs = run(program, "haber2004_slot", folder, "numerics.rule=discs", "numerics.discs=20000")
    check.number("with 20 000 discs [N]", source, "56.632", discs["force_resultant_mean"][0])
    check.number("with 20 000 discs [N]", source, "69.9585", discs["force_resultant_mean"][1])
    for depth, printed in ((0.5, "95.80"), (3.0, "396.616"), (6.0, "712.611")):
        ball = run(program, "haber2004_slot", folder, "cutter.shape=ball",
                   f"cut.axial_depth_mm={depth}")
        check.number(f"ball, {depth} mm deep, mean resultant [N]", source, printed,
                     ball["force_resultant_mean"][0], 0.01)


def ball_edge_convergence(program, folder, check):
    result = run(program, "ball_edge_convergence", folder, "numerics.angular_steps=3600")
    mean = result["force_resultant_mean"]
    exact = mean[list(result["rule"]).index("exact")]
    discs = mean[list(result["rule"]).index("discs")]
    check.holds("the exact rule does not depend on discs", np.ptp(exact) == 0.0, f"{exact[0]:.6f} N")
    low = {int(n): 100 * (exact[0] - force) / exact[0] for n, force in zip(result["discs"], discs)}
    for n, printed in ((50, "2.2"), (400, "0.77"), (20000, "0.1")):
        check.number(f"{n} discs are low by [%]", "DESIGN 3", printed, low[n],
                     0.05 if n != 400 else 0.005)
    order = np.polyfit(np.log(result["discs"]), np.log(list(low.values())), 1)[0]
    check.number("order of convergence in the number of discs", "1/sqrt(z) at the tip", "-0.5", order,
                 0.02)


def ggg70_slot(program, folder, check):
    """Some feeds and helix angles of the study; all of it, with MILLSTUDY_WHOLE_STUDIES=1, takes minutes on slow cores."""
    axes = ["feed_rate_mm_per_min", "spindle_speed_rpm", "helix_deg", "max_iterations"]
    plan = json.loads(subprocess.run([program, "plan", str(ROOT / "studies" / "ggg70_slot.toml"), "--json"], check=True,
                                     stdout=subprocess.PIPE).stdout)
    check.holds("at least 100 000 points", plan["points"] >= 100_000, plan["points"])
    some = ['sweep.axes."cut.feed_rate_mm_per_min"=[600.0, 960.0, 1320.0, 1740.0, 2100.0, 2460.0, 3000.0]',
            'sweep.axes."cutter.helix_deg"=[0.0, 10.0, 20.0, 30.0, 40.0, 50.0]']
    result = run(program, "ggg70_slot", folder, *([] if os.environ.get("MILLSTUDY_WHOLE_STUDIES") else some))
    status, mean = result["status"], result["force_resultant_mean"]
    check.holds("every point is ok or skipped", not np.isin(status, (1, 3)).any(),
                f"{(status == 0).sum()} ok, {(status == 2).sum()} skipped")
    feed = result["feed_rate_mm_per_min"][:, None] / (2 * result["spindle_speed_rpm"][None, :])
    check.holds("skipped is exactly what is beyond 0.15 mm per tooth",
                np.array_equal(status[:, :, 0, 0] == 2, feed > 0.15 * (1 + 1e-12)),
                f"{(feed > 0.15 * (1 + 1e-12)).sum()} of {feed.size} feeds and speeds")
    iterations = np.nanmax(np.abs(mean[..., 0] / mean[..., 1] - 1))
    check.holds("one Newton update instead of two moves the force by less than 0.03 %",
                iterations < 3e-4, f"{100 * iterations:.2e} %")
    peak = result["force_resultant_max"][..., 1]
    fall = 100 * (1 - peak[..., -1] / peak[..., 0])
    check.holds("a helix of 50 degrees takes the peak down by 2 to 3 %",
                2 < np.nanmin(fall) and np.nanmax(fall) < 3,
                f"{np.nanmin(fall):.2f} to {np.nanmax(fall):.2f} %")
    index = at(result, axes, feed_rate_mm_per_min=1740.0, spindle_speed_rpm=14500.0, helix_deg=30.0,
               max_iterations=2)
    straight = run(program, "haber2004_slot", folder, "numerics.angular_steps=360",
                   "cut.axial_depth_mm=3.0")
    check.holds("along the curve as on the straight line, 14 500 rpm and 1740 mm/min, within 0.5 %",
                abs(mean[index] / straight["force_resultant_mean"][0] - 1) < 5e-3,
                f"{mean[index]:.4f} N against {straight['force_resultant_mean'][0]:.4f} N")


def corner_engagement(program, folder, check):
    result = run(program, "corner_engagement", folder)
    start, count = result["trace_start"], result["trace_count"]

    def stretch(milling, depth, first, last):
        point = at(result, ["milling", "radial_depth_mm"], milling=milling, radial_depth_mm=depth)
        samples = slice(int(start[point]), int(start[point] + count[point]))
        time = result["trace_time"][samples]
        inside = (time > first) & (time < last)
        return np.sqrt(sum(result[f"trace_force_{axis}"][samples][inside] ** 2 for axis in "xyz"))

    # 25 mm/s: straight until 0.8 s, the corner of 12.57 mm until 1.303 s, straight again.
    for depth in result["radial_depth_mm"]:
        for milling, sign in (("down", 1.0), ("up", -1.0)):
            equivalent = depth * (1 + sign * (6.0 - 0.5 * depth) / 8.0)
            straight = run(program, "corner_engagement", folder, f'sweep.axes."cut.milling"=["{milling}"]',
                           f'sweep.axes."cut.radial_depth_mm"=[{float(equivalent)!r}]', "cut.stock=endless",
                           'path.curve_file=../data/curves/line.toml', "output.traces=false")
            check.number(f"{depth} mm {milling}: corner as a straight cut of {equivalent:.4g} mm [N]", "own run, straight path",
                         f"{straight['force_resultant_mean'].item():.4g}", stretch(milling, depth, 0.85, 1.15).mean(),
                         0.005 * straight["force_resultant_mean"].item())
    check.number("straight, 2 mm, mean [N]", "own run", "72.6", stretch("down", 2.0, 0.3, 0.75).mean())
    check.number("inside corner, mean [N]", "own run", "106.8", stretch("down", 2.0, 0.85, 1.15).mean())
    check.number("outside corner, mean [N]", "own run", "35.0", stretch("up", 2.0, 0.85, 1.15).mean())
    check.holds("in air at the very start, and at the end", stretch("down", 2.0, -1.0, 0.04).max() == 0.0
                and stretch("down", 2.0, 2.0, 3.0)[-1] < 20.0, f"{stretch('down', 2.0, 2.0, 3.0)[-1]:.2f} N in the last sample")


def haber2004_worn_tool(program, folder, check):
    result = run(program, "haber2004_worn_tool", folder)
    mean, scale = result["force_resultant_mean"], result["edge_scale"]
    slow, fast = mean[0, 0], mean[1, 1]
    check.number("new tool, 14 500 rpm [N]", "REFERENCE, own run", "56.632", slow[0])
    check.number("new tool, 17 500 rpm [N]", "REFERENCE, own run", "69.9585", fast[0])
    of_slow, of_fast = np.interp(82.5, slow, scale), np.interp(90.9, fast, scale)
    check.number("edge_scale of 82.5 N at 14 500 rpm", "haber2004 Table II, ours", "3.59", of_slow)
    check.number("edge_scale of 90.9 N at 17 500 rpm", "haber2004 Table II, ours", "3.10", of_fast)
    check.number("the first scale at the second speed [N]", "own run", "95.8", np.interp(of_slow, scale, fast))
    check.number("the second scale at the first speed [N]", "own run", "77.6", np.interp(of_fast, scale, slow))
    off = [np.interp(3.35, scale, slow) / 82.5 - 1, np.interp(3.35, scale, fast) / 90.9 - 1]
    check.holds("edge_scale 3.35 is within 3 % of both", max(map(abs, off)) < 0.03,
                f"{100 * off[0]:+.1f} % and {100 * off[1]:+.1f} %")


def helix_and_depth(program, folder, check):
    result = run(program, "helix_and_depth", folder)
    ripple = (result["force_x_max"] - result["force_x_min"]) / np.abs(result["force_x_mean"])
    depth = result["axial_depth_mm"]
    for row, helix in zip(ripple, result["helix_deg"]):
        pitch = np.pi * 12.0 / (4 * np.tan(np.radians(helix)))
        near = [int(np.argmin(np.abs(depth - k * pitch))) for k in range(1, int(40.0 / pitch) + 1)]
        check.holds(f"helix {helix:.0f} deg: hardly any ripple next to every {pitch:.3f} mm",
                    max(row[i] for i in near) < 0.02, f"{max(row[i] for i in near):.1e} of the mean")
        for k in (1, 2):
            exact = run(program, "helix_and_depth", folder, f'sweep.axes."cutter.helix_deg"=[{helix}]',
                        f'sweep.axes."cut.axial_depth_mm"=[{k * pitch!r}]')
            for force in ("x", "y", "z"):
                low, high, mean = (exact[f"force_{force}_{name}"].item() for name in ("min", "max", "mean"))
                check.holds(f"helix {helix:.0f} deg, {k} axial pitches: ripple of {force} below 1e-12 of the mean",
                            high - low < 1e-12 * abs(mean), f"{(high - low) / abs(mean):.1e}")
            harmonics = [exact[f"force_x_harmonic_{n}"].item() for n in (1, 2, 3)]
            check.holds("and no harmonic", max(harmonics) < 1e-12 * abs(exact["force_x_mean"].item()),
                        f"{max(harmonics):.1e} N")


def runout_and_pitch(program, folder, check):
    result = run(program, "runout_and_pitch", folder)
    offset = result["runout_offset_mm"]
    share = np.array([result[f"flute_{j}_load_share"] for j in range(1, 5)])
    chip = np.array([result[f"flute_{j}_chip_thickness_max"] for j in range(1, 5)])
    check.holds("the shares sum to one", np.abs(share.sum(axis=0) - 1).max() < 1e-12,
                f"{np.abs(share.sum(axis=0) - 1).max():.1e}")
    check.holds("without runout equal flutes share alike", np.ptp(share[:, 0, 0, 0]) < 1e-12,
                f"{np.ptp(share[:, 0, 0, 0]):.1e}")
    energy = result["power_mean"]
    for j, pitch in enumerate(result["pitch_deg"]):
        first = offset[np.argmax((chip[:, :, j, 0] == 0).any(axis=0))]
        check.number(f"pitch {pitch}: a flute cuts nothing from runout [mm]", "own run", "0.037", first, 1e-9)
        check.holds("at 0.02 mm one flute does more than 0.4 of the work",
                    0.40 < share[:, 20, j, 0].max() < 0.46, f"{share[:, 20, j, 0].max():.3f}")
    removal = result["material_removal_rate"]
    check.holds("material is removed at the same rate whatever the runout", np.ptp(removal) == 0.0, f"{removal.flat[0]:.3f} cm3/min")
    # Chip forces depend on the material alone, edge forces on who is in cut: less power as flutes miss.
    check.holds("flutes that miss their cut save edge forces", (energy[-1] < energy[0]).all(),
                f"{energy[-1, 0, 0] / energy[0, 0, 0]:.3f} of the power")


def unlike_helix(program, folder, check):
    result = run(program, "unlike_helix", folder)
    share = np.array([result[f"flute_{j}_load_share"] for j in range(1, 5)])
    off = np.abs(share.sum(axis=0) - 1).max()
    check.holds("the shares sum to one", off < 1e-12, f"{off:.1e}")
    even = share[:, :, :, 0]
    off = np.abs(even[:, 0] - 0.25).max()
    check.holds("without runout equal flutes share alike", off < 1e-12, f"{off:.1e}")
    off = max(np.abs(even[0, 1] - even[2, 1]).max(), np.abs(even[1, 1] - even[3, 1]).max())
    check.holds("and unlike ones by turns", off < 1e-12, f"{off:.1e}")
    for name, printed, value in (
            ("unlike, no runout, 15 mm: least share", "0.2385", even[:, 1, -1].min()),
            ("unlike, no runout, 15 mm: largest share", "0.2615", even[:, 1, -1].max()),
            ("unlike, 0.01 mm, 15 mm: least share", "0.1603", share[:, 1, -1, 10].min()),
            ("unlike, 0.01 mm, 15 mm: largest share", "0.3697", share[:, 1, -1, 10].max()),
            ("equal, 0.01 mm, 15 mm: least share", "0.1517", share[:, 0, -1, 10].min()),
            ("equal, 0.01 mm, 15 mm: largest share", "0.3540", share[:, 0, -1, 10].max()),
            ("unlike, 0.02 mm, 10 mm: least share", "0.0500", share[:, 1, 9, 20].min()),
            ("unlike, 0.02 mm, 10 mm: largest share", "0.5000", share[:, 1, 9, 20].max())):
        check.number(name, "own run", printed, value)
    one = ['sweep.axes."cutter.helix_deg"=[[35.0, 38.0, 35.0, 38.0]]', 'sweep.axes."cut.axial_depth_mm"=[10.0]',
           'sweep.axes."cutter.runout_offset_mm"=[0.02]']
    discs = run(program, "unlike_helix", folder, *one, "numerics.rule=discs", "numerics.discs=20000")
    off = np.abs(np.array([discs[f"flute_{j}_load_share"].item() for j in range(1, 5)]) - share[:, 1, 9, 20]).max()
    check.holds("20 000 discs share the work alike", off < 1e-6, f"{off:.1e}")


def cutter_shapes(program, folder, check):
    result = run(program, "cutter_shapes", folder)
    check.holds("every shape is computed", not result["status"].any(), f"{result['status'].size} points")
    discs = run(program, "cutter_shapes", folder, "numerics.rule=discs", "numerics.discs=20000")
    off = np.abs(discs["force_resultant_mean"] / result["force_resultant_mean"] - 1).max(axis=1)
    for shape, distance in zip(result["cutter_file"], off):
        check.holds(f"{pathlib.Path(shape).stem}: 20 000 discs are within 0.2 %", distance < 2e-3, f"{100 * distance:.4f} %")
    energy = result["specific_energy"]
    check.holds("corners and balls cost most where the cut is shallow", (energy[:2, 0] > energy[:2, -1] * 1.2).all(),
                f"{energy[0, 0]:.2f} and {energy[0, -1]:.2f} J/mm3 of the bull-nose")


def coefficient_laws(program, folder, check):
    result = run(program, "coefficient_laws", folder)
    mean = result["force_resultant_mean"][:, :, 0]
    laws = [pathlib.Path(name).stem for name in result["coefficients_file"]]
    against = dict(zip(laws, 100 * (mean / mean[0] - 1)))
    feeds = list(result["feed_per_tooth_mm"])
    for law, feed, printed in (("size_effect", 0.0125, "7.7"), ("size_effect", 0.2, "-12.0"),
                               ("height_table", 0.05, "6.1"), ("height_polynomial", 0.05, "0.8"),
                               ("orthogonal", 0.2, "-1.0")):
        check.number(f"{law} against constant at {feed} mm [%]", "own run", printed,
                     against[law][feeds.index(feed)], 0.06)
    worn = run(program, "coefficient_laws", folder, 'sweep.axes."cut.feed_per_tooth_mm"=[0.05]',
               "coefficients.edge_scale=2.0")["force_resultant_mean"][:, 0, 0]
    check.holds("a worn edge adds force with any law", (worn > mean[:, feeds.index(0.05)] * 1.5).all(), worn)
    scaled = result["torque_mean"][..., 1] - result["torque_mean"][..., 0]
    check.holds("cutting_scale 1.2 adds a fifth of the chip's torque", (scaled > 0).all(),
                f"{scaled[0, 2]:.3f} N m at 0.05 mm")


def insperger_lobes(program, folder, check):
    result = run(program, "insperger_lobes", folder)
    limit, speed = result["axial_depth_limit"], result["spindle_speed_rpm"]
    source = "Insperger & Stepan 2004, two programs"
    fixed = run(program, "insperger_lobes", folder, "stability.intervals=100",
                'sweep.axes."cut.spindle_speed_rpm"=[5000.0, 10000.0, 15000.0, 20000.0, 25000.0]')
    expected = [("0.419", "0.324", "0.388", "1.419", "3.940"), ("2.224", "4.098", "8.200", "2.300", "2.917")]
    for i, immersion in enumerate((1, 0.05)):
        for k, printed in enumerate(expected[i]):
            check.number(f"immersion {immersion}, {5000 * (k + 1)} rpm, 100 intervals [mm]", source, printed,
                         fixed["axial_depth_limit"][i, k], 0.005 * float(printed))
    half = run(program, "insperger_lobes", folder, "stability.tolerance=5e-4")["axial_depth_limit"]
    check.holds("limits with the tolerance halved: 0.1 %", (np.abs(limit / half - 1) < 1e-3).all(),
                f"{np.abs(limit / half - 1).max():.1e}")
    frequency = result["chatter_frequency_at_limit"]
    tooth = 2 * speed / 60
    halves = frequency[1] / tooth * 2
    flips = np.isclose(halves, np.round(halves), atol=1e-6) & (np.round(halves) % 2 == 1)
    check.holds("shallow cut: period doubling limits some speeds", 60 < flips.sum() < 200, f"{flips.sum()} of {speed.size}")


def altintas_two_mode(program, folder, check):
    result = run(program, "altintas_two_mode", folder)
    limit = result["axial_depth_limit"]  # method, radial depth, speed
    speed = result["spindle_speed_rpm"]
    check.holds("slot, four teeth: zeroth order is exact", (np.abs(limit[0, 0] / limit[1, 0] - 1) < 1e-5).all(),
                f"{np.abs(limit[0, 0] / limit[1, 0] - 1).max():.1e}")
    ratio = limit[1, 1] / limit[0, 1]
    check.number("5 % immersion: zeroth order over multipliers, most", "own run", "5.24", ratio.max(), 0.01)
    check.number("at [rpm]", "own run", "15950", speed[ratio.argmax()])
    check.number("least", "own run", "0.664", ratio.min(), 0.001)
    frequency = result["chatter_frequency_at_limit"]
    found = np.isfinite(frequency[:, 0]).all(axis=0)
    check.holds("and both name the same frequency in the slot",
                np.allclose(frequency[0, 0, found], frequency[1, 0, found], rtol=1e-4),
                f"{np.abs(frequency[0, 0, found] / frequency[1, 0, found] - 1).max():.1e}")


def measured_response(program, folder, check):
    slot = run(program, "altintas_two_mode", folder,
               "sweep.axes.\"cut.radial_depth_mm\"=[16.0]")["axial_depth_limit"][0, 0]
    fitted, direct = run(program, "measured_response", folder)["axial_depth_limit"]
    for name, limit, most, rms in (("fitted modes", fitted, "0.0055", "0.0025"),
                                   ("the response itself", direct, "0.0883", "0.0208")):
        off = limit / slot - 1
        check.number(f"{name}: limits off those of the true modes by up to", "own run", most, np.abs(off).max(), 0.001)
        check.number(f"{name}: root mean square", "own run", rms, np.sqrt((off**2).mean()), 0.001)


def process_damping(program, folder, check):
    result = run(program, "process_damping", folder)
    limit, speed = result["axial_depth_limit"], result["spindle_speed_rpm"]
    for rpm, printed in ((300, ("2.23", "14.5", "40.0")), (900, ("2.23", "5.07", "19.3")), (6000, ("2.34", "2.50", "3.45"))):
        for c, figure in enumerate(printed):
            check.number(f"C = {result['process_damping_N_per_mm'][c]:g} N/mm, {rpm} rpm [mm]", "own run", figure,
                         limit[c, np.argmin(np.abs(speed - rpm))], 0.06)
    check.holds("damping never makes it shallower", (np.diff(limit, axis=0) >= -1e-3 * limit[1:]).all(),
                f"least step {np.diff(limit, axis=0).min():.3g} mm")
    zeroth = run(program, "process_damping", folder, "cut.radial_depth_mm=19.0",
                 "stability.method=zeroth_order")["axial_depth_limit"]
    slot = run(program, "process_damping", folder, "cut.radial_depth_mm=19.0")["axial_depth_limit"]
    check.holds("in a slot with four teeth the zeroth order is exact with damping too",
                (np.abs(zeroth / slot - 1) < 1e-3).all(), f"{np.abs(zeroth / slot - 1).max():.1e}")


def variable_pitch_lobes(program, folder, check):
    result = run(program, "variable_pitch_lobes", folder)
    limit, speed = result["axial_depth_limit"], result["spindle_speed_rpm"]
    for pitch, rpm, printed in ((0, 5100, "2.52"), (2, 5100, "6.30"), (0, 7400, "3.35"), (3, 7400, "6.17")):
        check.number(f"pitch {result['pitch_deg'][pitch]} at {rpm} rpm [mm]", "own run", printed,
                     limit[pitch, np.argmin(np.abs(speed - rpm))], 0.006)
    lowest = limit.min(axis=1)
    check.holds("the lowest limit over all speeds does not rise", lowest[0] >= lowest[1:].max(),
                np.array2string(lowest, precision=2))


def interval_convergence(program, folder, check):
    result = run(program, "interval_convergence", folder)
    off = result["axial_depth_limit"] / 0.40862777 - 1  # order, intervals; the limit of insperger_lobes at tolerance 1e-7
    count = list(result["intervals"])
    for order, intervals, printed in ((0, 40, "0.174"), (0, 100, "0.0247"), (1, 100, "0.0122"), (2, 40, "0.024"), (2, 100, "0.0010")):
        check.number(f"order {order}, {intervals} intervals: limit off by", "own run", printed, off[order, count.index(intervals)])
    for order in (0, 1):
        ratio = off[order, count.index(400)] / off[order, count.index(800)]
        check.number(f"order {order}: error at 400 over 800", "second order", "4.0", ratio, 0.2)


def runout_chatter(program, folder, check):
    result = run(program, "runout_chatter", folder)
    stable, depth = result["stable"], result["axial_depth_mm"]
    for row, offset, printed in zip(stable, result["runout_offset_mm"], ("1.8", "1.6", "2.2", "2.4")):
        last = np.nonzero(row)[0].max()
        first = depth[last + 1]
        check.number(f"runout {offset} mm: it chatters from [mm]", "own run", printed, first, 0.21)
    check.holds("what is stable decays", (result["spectral_radius"][stable == 1] < 1).all(), "")


def surface_location_error(program, folder, check):
    result = run(program, "surface_location_error", folder)
    error, speed = result["surface_location_error"], result["spindle_speed_rpm"]  # milling, speed
    check.number("down-milling: largest error [um]", "own run", "-18.5", error[1].min(), 0.06)
    check.number("at [rpm]", "own run", "9850", speed[error[1].argmin()], 51)
    last = np.nonzero(np.diff(np.sign(error[1])))[0].max()
    check.number("it changes sign past the synchronous speed, at [rpm]", "own run", "20340", speed[last:last + 2].mean(), 40)
    check.holds("up-milling stays within 2 um", np.abs(error[0]).max() < 2, f"{np.abs(error[0]).max():.2f} um")
    simulated = run(program, "surface_location_error", folder, 'finish.method="time_domain"',
                    'sweep.axes."cut.spindle_speed_rpm"={ from = 4000.0, to = 25000.0, count = 22 }')
    off = np.abs(simulated["surface_location_error"] - error[:, ::20]) / result["vibration_y_peak_to_peak"][:, ::20]
    check.holds("the simulation in time gives the same: 0.5 % of the vibration", off.max() < 5e-3, f"{off.max():.1e}")
    # f^2 / (8 R), and what the speed of the feed stretches
    stretch = 1 + np.array([1, -1]) * 0.16 / (2 * np.pi) / 8
    rigid = 1e3 * 0.08**2 / (8 * 8) / stretch**2
    far = result["roughness_rz"][:, -1] / rigid
    check.holds("Rz far from resonance is that of a rigid tool, within 5 %", np.abs(far - 1).max() < 0.05, f"{far}")


def finish_dataset(program, folder, check):
    result = run(program, "finish_dataset", folder)
    stable = result["stable"] == 1
    check.holds("some cuts chatter, most do not", 0.5 < stable.mean() < 0.99, f"{stable.mean():.3f} of {stable.size} stable")
    for name in ("surface_location_error", "roughness_ra", "roughness_rq", "roughness_rz"):
        check.holds(f"{name} where stable, nowhere else", np.array_equal(np.isfinite(result[name]), stable), "")
    ball = np.char.find(result["cutter_file"].astype(str), "tapered_ball") >= 0
    cusp = result["cusp_height"]
    check.number("cusps of a ball of 6 mm at 0.5 mm [um]", "R - sqrt(R^2 - e^2/4)", "10.43", cusp[ball].max())
    check.number("the same, least", "R - sqrt(R^2 - e^2/4)", "10.43", cusp[ball].min())
    check.holds("none between flat ends", (cusp[~ball] == 0).all(), "")
    depth = np.sort(result["axial_depth_mm"])
    parts = np.floor(np.log(depth / 0.1) / np.log(40.0) * 2000).astype(int)
    check.holds("one depth in each of 2000 equal parts", (parts == np.arange(2000)).all(), "")
    check.holds("Ra <= Rq <= Rz", ((result["roughness_ra"] <= result["roughness_rq"])[stable].all()
                                   and (result["roughness_rq"] <= result["roughness_rz"])[stable].all()), "")


def stability_dataset(program, folder, check):
    """A thinned grid: the million takes minutes."""
    result = run(program, "stability_dataset", folder,
                 'sweep.axes."cut.axial_depth_mm"={ from = 0.1, to = 10.0, count = 13 }',
                 'sweep.axes."cut.spindle_speed_rpm"={ from = 3000.0, to = 18000.0, count = 31 }')
    stable = result["stable"]  # flutes, radial, axial, speed
    check.holds("every point has a label", np.isin(stable, (0, 1)).all(), f"{stable.size} points")
    check.holds("the label is the radius below one", np.array_equal(stable == 1, result["spectral_radius"] < 1), "")
    check.holds("deeper cuts are stable less often", (np.diff(stable.mean(axis=(0, 1, 3))) <= 0).all(),
                np.array2string(stable.mean(axis=(0, 1, 3)), precision=2))
    check.holds("wider cuts too", (np.diff(stable.mean(axis=(0, 2, 3))) <= 0).all(),
                np.array2string(stable.mean(axis=(0, 2, 3)), precision=2))
    check.holds("and more teeth", (np.diff(stable.mean(axis=(1, 2, 3))) <= 0).all(),
                np.array2string(stable.mean(axis=(1, 2, 3)), precision=2))


def force_sensitivity(program, folder, check):
    """The mean force of a slot is a product and sum of its inputs: its indices are known exactly."""
    result = run(program, "force_sensitivity", folder)
    indices = json.loads(subprocess.run(
        [program, "sensitivity", str(pathlib.Path(folder) / "result.h5"), "--variable", "force_y_mean", "--json"],
        check=True, stdout=subprocess.PIPE).stdout)[0]
    check.holds("no group is dropped", indices["groups"] == 4096 and indices["dropped_groups"] == 0, indices["groups"])
    # |Fy| = a (N c Ktc / 4 + N Kte / pi), Altintas, Manufacturing Automation, eq. 2.21; means and variances of uniform inputs.
    mean, variance = {}, {}
    for name, low, high in (("a", 0.9, 1.1), ("c", 0.05, 0.07), ("Ktc", 1900.0, 2450.0), ("Kte", 12.0, 22.0)):
        mean[name], variance[name] = (low + high) / 2, (high - low) ** 2 / 12
    u, v = 4 / 4, 4 / np.pi
    second = {name: variance[name] + mean[name] ** 2 for name in mean}
    g = u * mean["c"] * mean["Ktc"] + v * mean["Kte"]
    var_g = u * u * (second["c"] * second["Ktc"] - (mean["c"] * mean["Ktc"]) ** 2) + v * v * variance["Kte"]
    whole = second["a"] * (var_g + g * g) - (mean["a"] * g) ** 2

    def without(fixed):
        """Variance of the mean over one input of g."""
        parts = {"c": u * u * mean["c"] ** 2 * variance["Ktc"] + v * v * variance["Kte"],
                 "Ktc": u * u * mean["Ktc"] ** 2 * variance["c"] + v * v * variance["Kte"],
                 "Kte": var_g - v * v * variance["Kte"]}
        return second["a"] * (parts[fixed] + g * g) - (mean["a"] * g) ** 2

    first = {"cut.axial_depth_mm": variance["a"] * g * g / whole,
             "cut.feed_per_tooth_mm": (mean["a"] * u * mean["Ktc"]) ** 2 * variance["c"] / whole,
             "coefficients.Ktc_N_per_mm2": (mean["a"] * u * mean["c"]) ** 2 * variance["Ktc"] / whole,
             "coefficients.Kte_N_per_mm": (mean["a"] * v) ** 2 * variance["Kte"] / whole,
             "coefficients.Krc_N_per_mm2": 0.0, "cutter.helix_deg": 0.0}
    total = {"cut.axial_depth_mm": 1.0 - mean["a"] ** 2 * var_g / whole,
             "cut.feed_per_tooth_mm": 1.0 - without("c") / whole,
             "coefficients.Ktc_N_per_mm2": 1.0 - without("Ktc") / whole,
             "coefficients.Kte_N_per_mm": 1.0 - without("Kte") / whole,
             "coefficients.Krc_N_per_mm2": 0.0, "cutter.helix_deg": 0.0}
    for axis in indices["axes"]:
        name = axis["axis"]
        check.number(f"{name} alone", "exact", f"{first[name]:.6f}", axis["first"]["value"], 0.002)
        check.number(f"{name} in all", "exact", f"{total[name]:.6f}", axis["total"]["value"], 0.002)
    check.number("mean of the mean force along y", "exact", f"{mean['a'] * g:.6f}",
                 np.abs(result["force_y_mean"]).reshape(-1, 8)[:, :2].mean(), 0.01)


def main():
    program, study = sys.argv[1:]
    check = Checker()
    with tempfile.TemporaryDirectory() as folder:
        globals()[study](program, folder, check)
    print(f"{study}: {check.failures} numbers off")
    return 1 if check.failures else 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: MIT
"""Fits coefficients to measured forces and compares with what is known of them.

Usage: measured_fits.py MILLSTUDY CASE. The measurements are no part of the project: they are looked for in $MILLSTUDY_MEASURED_DIR or
beside the repository, and without them the test is skipped (exit 77). Figures are those of the experimenters' regression (flat slots) and of
trials with independent NumPy models (bull-nose slots); each is printed with our distance.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SKIPPED = 77
FEEDS = {300: 8.0, 600: 5.0, 900: 3.0, 1200: 2.0, 1500: 2.0}  # [mm/min], and where the clock of the record begins [s]
DEPTHS = (1, 2, 3, 4, 5)
# The two cases that take minutes fit four tenths of each record, unless all of it is asked for.
WHOLE = bool(os.environ.get("MILLSTUDY_WHOLE_STUDIES"))
AVERAGE = {"Ktc": 958.82, "Krc": 251.06, "Kac": 146.39, "Kte": 15.753, "Kre": 19.424, "Kae": 18.206}
MODES = """[[dynamometer.{axis}]]
frequency_Hz = {frequency}
damping_ratio = 0.05
gain = {gain}
"""

failures = []


def check(words, good):
    print(f"{'ok  ' if good else 'FAIL'} {words}")
    if not good:
        failures.append(words)


def measured_folder():
    places = [os.environ.get("MILLSTUDY_MEASURED_DIR"), ROOT.parent / "shared" / "measured"]
    for place in places:
        if place and (pathlib.Path(place) / "flat_slot_2018").is_dir():
            return pathlib.Path(place).resolve()
    print("no measured forces here: skipped")
    sys.exit(SKIPPED)


def flat(folder, keys, more="", seconds=1.0):
    text = f"""schema_version = 1
[fit]
name = "flat"
{keys}
[cutter]
shape = "flat"
diameter_mm = 25.0
flutes = 2
helix_deg = 45.0
[cut]
axial_depth_mm = 3.0
milling = "slot"
spindle_speed_rpm = 6000.0
[trace]
axes = {{ x = "Fy", y = "Fx", z = "-Fz" }}
{more}"""
    for feed, begin in FEEDS.items():
        text += f"""[[record]]
file = "{folder}/flat_slot_2018/n6000_f{feed}_ap3.csv"
name = "{feed} mm/min"
window_s = [{begin}, {begin + seconds}]
cut = {{ feed_rate_mm_per_min = {feed}.0 }}
"""
    return text


def bull_nose(folder, keys, depths=DEPTHS, seconds=1.0):
    text = f"""schema_version = 1
[fit]
name = "bull_nose"
{keys}
[cutter]
shape = "bull_nose"
diameter_mm = 16.0
corner_radius_mm = 3.0
flutes = 2
helix_deg = 25.0
[cut]
milling = "slot"
spindle_speed_rpm = 800.0
feed_rate_mm_per_min = 160.0
[trace]
axes = {{ x = "-Fy", y = "-Fx", z = "Fz" }}
sampling_rate_Hz = 10000.0
units = {{ Fx = "N", Fy = "N", Fz = "N" }}
window_s = [0.0, {seconds}]
"""
    for depth in depths:
        text += f"""[[record]]
file = "{folder}/bull_nose_2017/bull_nose_slots.mat"
name = "{depth} mm"
variables = {{ Fx = "Fx_R_{depth}", Fy = "Fy_R_{depth}", Fz = "Fz_R_{depth}" }}
cut = {{ axial_depth_mm = {depth}.0 }}
"""
    return text


def fit(program, text):
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "fit.toml").write_text(text)
        done = subprocess.run([program, "fit", "fit.toml", "--json", "--quiet"], cwd=folder, text=True, capture_output=True)
        if done.returncode != 0:
            print(done.stdout, done.stderr)
            sys.exit(1)
        return json.loads(done.stdout)


def check_records(out, limits, key="r_squared"):
    """R2 of x and y of every record."""
    for record, limit in zip(out["records"], limits):
        x, y = record[key][0], record[key][1]
        check(f"{record['name']}: {key.replace('_', ' ')} x {x:.4f} y {y:.4f}, at least {limit}", min(x, y) >= limit)


def flat_average(program, folder):
    out = fit(program, flat(folder, 'method = "average"'))
    for name, known in AVERAGE.items():
        found = out["estimates"][name]["value"]
        distance = 100.0 * (found / known - 1.0)
        check(f"{name} {found:.4f}, known {known}: {distance:+.4f} %", abs(distance) < 0.02)


def flat_rigid(program, folder):
    out = fit(program, flat(folder, 'weights = "records"\nbelow_Hz = 300.0\ntolerance = 1e-6'))
    check_records(out, [0.94] * 5)
    check_records(out, [-1.0] * 5, "left_out_r_squared")
    check("the program recommends average forces", any('method = "average"' in remark for remark in out["remarks"]))


def flat_ringing(program, folder):
    modes = "".join(MODES.format(axis=axis, frequency=f, gain=g)
                    for axis, pair in (("x", ((992.0, 1.0), (1400.0, 0.0))), ("y", ((788.0, 1.0), (1000.0, 0.0))),
                                       ("z", ((1000.0, 1.0), (2000.0, 0.0))))
                    for f, g in pair)
    out = fit(program, flat(folder, 'weights = "records"\nrunout_limit_mm = 0.1\ntolerance = 1e-6\n'
                            'estimate = ["phase", "spindle_speed", "runout", "offset", "dynamometer"]', modes,
                            1.0 if WHOLE else 0.4))
    check_records(out, [0.84] * 4 + [0.72])
    check_records(out, [-1.0] * 5, "left_out_r_squared")
    # Two modes of an axis that come close share their gain in several ways that fit alike, and the last bits of a processor choose: of y
    # 2.5 and -0.1, or 3.9 and -1.7 at an error 1 % less. A pair that cancels would have tens.
    for axis in "xyz":
        gains = [out["estimates"][f"dynamometer_{axis}_{mode}_gain"]["value"] for mode in (0, 1)]
        check(f"dynamometer {axis}: gains {gains[0]:.2f} and {gains[1]:.2f}, together no larger than 3, none than 5",
              abs(sum(gains)) < 3.0 and max(map(abs, gains)) < 5.0)
    check("the program recommends average forces", any('method = "average"' in remark for remark in out["remarks"]))


def bull_nose_each(program, folder):
    """One record at a time, as in the trials: 0.991/0.990, 0.993/0.995, 0.997/0.997, 0.996/0.996, 0.995/0.995."""
    for depth in DEPTHS:
        check_records(fit(program, bull_nose(folder, "", [depth])), [0.99])


def bull_nose_wandering(program, folder):
    estimate = 'estimate = ["phase", "spindle_speed", "runout", "offset", "phase_drift"]\ntolerance = 1e-6'
    for depth in DEPTHS:
        check_records(fit(program, bull_nose(folder, estimate, [depth])), [0.996])


def bull_nose_together(program, folder):
    """One set for all depths; trials reached 0.987/0.981 in the worst record, left out 0.983/0.980."""
    out = fit(program, bull_nose(folder, "tolerance = 1e-6"))
    check_records(out, [0.98] * 5)
    check_records(out, [0.975] * 5, "left_out_r_squared")


def bull_nose_choice(program, folder):
    """Trials: linear in height, records weighted alike, 0.990/0.991 in the worst record, left out 0.980/0.987."""
    out = fit(program, bull_nose(folder, 'model = "auto"\nweights = "records"\ntolerance = 1e-6',
                                 seconds=1.0 if WHOLE else 0.4))
    reason = next(remark for remark in out["remarks"] if remark.startswith("model "))
    print(f"     {reason}")
    check("it takes coefficients linear in height", reason.startswith("model per_height was chosen"))
    check_records(out, [0.985] * 5)
    check_records(out, [0.975] * 5, "left_out_r_squared")


CASES = {case.__name__: case for case in (flat_average, flat_rigid, flat_ringing, bull_nose_each, bull_nose_wandering,
                                          bull_nose_together, bull_nose_choice)}

if __name__ == "__main__":
    CASES[sys.argv[2]](os.path.abspath(sys.argv[1]), measured_folder())
    sys.exit(1 if failures else 0)

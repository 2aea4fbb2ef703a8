#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a result of millstudy fit: measured and predicted forces, what is left, its spectrum, the intervals.

One column for each record (at most --records of them, spread over all), rows: the forces over the first revolutions, the residual, the
amplitude spectra of both. Below them the coefficients of all records with their 95 % intervals, relative to their values.
"""
import argparse
import sys

try:
    import h5py
    import matplotlib
    import numpy as np
except ImportError as error:
    sys.exit(f"plot_fit.py: {error} (Debian: apt install python3-h5py python3-matplotlib)")

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito's colours: told apart with every kind of colour vision.
AXES = {"x": "#0072B2", "y": "#D55E00", "z": "#009E73"}
STYLE = {
    "font.size": 9, "axes.titlesize": 9.5, "axes.labelsize": 9, "legend.fontsize": 8,
    "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8,
    "axes.edgecolor": "#444444", "xtick.color": "#444444", "ytick.color": "#444444",
    "legend.frameon": False, "figure.constrained_layout.use": True,
}


def text(value):
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


class Record:
    def __init__(self, file, index):
        self.name = text(file["record"][index])
        first = int(file["trace_start"][index])
        samples = slice(first, first + int(file["trace_count"][index]))
        self.time = file["time"][samples]
        self.axes = [a for a in AXES if f"measured_{a}" in file
                     and np.isfinite(file[f"measured_{a}"][samples]).any()]
        self.measured = {a: file[f"measured_{a}"][samples] for a in self.axes}
        self.predicted = {a: file[f"predicted_{a}"][samples] for a in self.axes if f"predicted_{a}" in file}
        self.r_squared = {a: float(file[f"r_squared_{a}"][index]) for a in self.predicted}
        self.turn = 60.0 / float(file["spindle_speed"][index]) if "spindle_speed" in file else None


def draw_forces(axes, record, turns):
    shown = record.time < record.time[0] + (turns * record.turn if record.turn else np.inf)
    for a in record.axes:
        axes.plot(record.time[shown], record.measured[a][shown], color=AXES[a], lw=0.8, alpha=0.45)
        if a in record.predicted:
            axes.plot(record.time[shown], record.predicted[a][shown], color=AXES[a], lw=1.3)
    axes.set_title(record.name + "\nR² " + "  ".join(f"{a} {r:.4f}" for a, r in record.r_squared.items()))


def draw_residual(axes, record, turns):
    shown = record.time < record.time[0] + (turns * record.turn if record.turn else np.inf)
    for a in record.predicted:
        axes.plot(record.time[shown], (record.measured[a] - record.predicted[a])[shown], color=AXES[a], lw=0.8)
    axes.axhline(0.0, color="#888888", lw=0.6)
    axes.set_xlabel("time [s]")


def draw_spectrum(axes, record):
    window = np.hanning(len(record.time))
    rate = (len(record.time) - 1) / (record.time[-1] - record.time[0])
    frequency = np.fft.rfftfreq(len(record.time), 1.0 / rate)

    def amplitude(signal):
        return 2.0 * np.abs(np.fft.rfft((signal - signal.mean()) * window)) / window.sum()

    for a in record.predicted:
        axes.semilogy(frequency, amplitude(record.measured[a]), color=AXES[a], lw=0.7, alpha=0.45)
        axes.semilogy(frequency, amplitude(record.predicted[a]), color=AXES[a], lw=1.0)
    axes.set_xlabel("frequency [Hz]")
    axes.set_xlim(0.0, min(frequency[-1], 3000.0))
    top = max(amplitude(record.measured[a]).max() for a in record.axes)
    axes.set_ylim(1e-4 * top, 2.0 * top)


def draw_intervals(axes, file):
    names = [text(name) for name in file["coefficient_name"][()]]
    units = [text(unit) for unit in file["coefficient_unit"][()]]
    values, low, high = (file[n][()] for n in ("coefficient", "confidence_low", "confidence_high"))
    for i, (name, value, a, b) in enumerate(zip(names, values, low, high)):
        scale = abs(value) if value else 1.0
        axes.plot([100.0 * (a - value) / scale, 100.0 * (b - value) / scale], [i, i], color="#0072B2", lw=3)
        axes.plot([0.0], [i], "o", color="#0072B2", ms=5)
    axes.set_yticks(range(len(names)), [f"{n} = {v:.5g} {u if u != '1' else ''}"
                                        for n, v, u in zip(names, values, units)])
    axes.invert_yaxis()
    axes.axvline(0.0, color="#888888", lw=0.6)
    axes.set_xlabel("95 % interval [% of the value]")
    axes.set_title("estimates that all records share")


def draw_means(axes, file):
    """Mean forces over the records: of method average."""
    count = len(file["record"])
    for a in AXES:
        axes.plot(range(count), file[f"mean_force_{a}"][()], "o", color=AXES[a], ms=5, mfc="none")
        axes.plot(range(count), file[f"predicted_mean_force_{a}"][()], color=AXES[a], lw=1.3,
                  label=f"{a}: R² {float(file[f'r_squared_{a}'][()]):.3f}")
    axes.set_xticks(range(count), [text(name) for name in file["record"][()]], rotation=30, ha="right")
    axes.set_ylabel("mean force [N]")
    axes.legend()


def draw(file, most, turns):
    indices = range(len(file["record"]))
    if "predicted_x" not in file and "mean_force_x" in file:
        figure, (means, intervals) = plt.subplots(1, 2, figsize=(11, 4.2))
        draw_means(means, file)
        draw_intervals(intervals, file)
        return figure
    if len(indices) > most:
        indices = sorted({round(i * (len(indices) - 1) / max(1, most - 1)) for i in range(most)})
    records = [Record(file, i) for i in indices]
    rows = len(file["coefficient_name"])
    figure = plt.figure(figsize=(3.6 * len(records) + 0.6, 7.4 + 0.24 * rows))
    above, below = figure.subfigures(2, 1, height_ratios=[7.0, 1.0 + 0.24 * rows])
    grid = above.subplots(3, len(records), squeeze=False, height_ratios=[2.2, 1.0, 1.5])
    for column, record in enumerate(records):
        panels = grid[:, column]
        draw_forces(panels[0], record, turns)
        draw_residual(panels[1], record, turns)
        draw_spectrum(panels[2], record)
        if column == 0:
            for panel, label in zip(panels, ("force [N]", "measured less\npredicted [N]", "amplitude [N]")):
                panel.set_ylabel(label)
            for a in record.axes:
                panels[2].plot([], [], color=AXES[a], lw=1.3, label=a)
            panels[2].plot([], [], color="#888888", lw=0.8, alpha=0.45, label="pale: measured")
            panels[2].legend(loc="upper right", ncol=4, handlelength=1.2, columnspacing=0.8)
    draw_intervals(below.subplots(), file)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("result", help="result of millstudy fit (.h5)")
    parser.add_argument("-o", "--output", help="picture (default: result.png)")
    parser.add_argument("--records", type=int, default=3, help="most records that are drawn")
    parser.add_argument("--turns", type=float, default=2.0, help="revolutions that are drawn of each")
    options = parser.parse_args()
    output = options.output or options.result.rsplit(".", 1)[0] + ".png"
    try:
        with h5py.File(options.result) as file:
            if text(file.attrs.get("kind", "")) != "fit":
                sys.exit(f"{options.result}: is no result of millstudy fit")
            with plt.rc_context(STYLE):
                figure = draw(file, max(1, options.records), options.turns)
                figure.suptitle(text(file.attrs.get("title", "")), fontsize=10.5)
                figure.savefig(output, dpi=120)
    except OSError as error:
        sys.exit(f"{options.result}: {error}")
    print(output)


if __name__ == "__main__":
    main()

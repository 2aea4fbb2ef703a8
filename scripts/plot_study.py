#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a result file of millstudy: a curve for one axis, a map for two, small multiples for more.

Of more than three axes, the further ones are held at their middle value, and the title says so.
Results of zip and sampled designs are drawn as points over the first parameter that varies.
"""
import argparse
import pathlib
import re
import sys

try:
    import h5py
    import matplotlib
    import numpy as np
except ImportError as error:
    sys.exit(f"plot_study.py: {error} (Debian: apt install python3-h5py python3-matplotlib)")

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import LogNorm, Normalize  # noqa: E402

FIRST_CHOICES = ("force_resultant_mean", "feed_fluctuation_max", "axial_depth_limit",
                 "spectral_radius", "surface_location_error")
# Okabe and Ito's colours: told apart with every kind of colour vision.
CURVE_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
FEW = 5
MOST_PANELS = 12
LOG_DECADES = 2.0
STYLE = {
    "font.size": 9.5, "axes.titlesize": 9.5, "axes.labelsize": 9.5, "legend.fontsize": 8.5,
    "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8,
    "axes.edgecolor": "#444444", "xtick.color": "#444444", "ytick.color": "#444444",
    "axes.labelcolor": "#222222", "legend.frameon": False, "axes.grid": False,
    "lines.linewidth": 1.6, "hatch.linewidth": 0.5, "figure.constrained_layout.use": True,
}


class BadInput(Exception):
    """Something the user can mend; printed as one line."""


def text(value):
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def shown_units(units):
    """UDUNITS as people write them: "mm min-1" is "mm/min"; empty for a pure number."""
    names = {"1": "", "percent": "%", "degree": "°", "um": "µm"}
    above = [names.get(part, part) for part in units.split() if not part.endswith("-1")]
    below = [part[:-2] for part in units.split() if part.endswith("-1") and part != "-1"]
    return "/".join([" ".join(above) or ("1" if below else "")] + below)


class Axis:
    """Values along one axis, with its label; texts are categories 0, 1, 2, ..."""

    def __init__(self, dataset):
        self.name = dataset.name.lstrip("/")
        self.long_name = text(dataset.attrs.get("long_name", "")) or self.name
        self.units = shown_units(text(dataset.attrs.get("units", "1")))
        self.words = None
        if dataset.dtype.kind in "OS":
            self.words = [text(word) for word in dataset[()]]
            self.values = np.arange(len(self.words), dtype=float)
        else:
            self.values = np.asarray(dataset[()], dtype=float)

    def __len__(self):
        return len(self.values)

    @property
    def label(self):
        return f"{self.short} [{self.units}]" if self.units else self.short

    @property
    def short(self):
        """Long name up to the first comma, colon, semicolon or bracket: for titles."""
        return re.split(r"[,;:(]", self.long_name)[0].strip()

    def value_text(self, index):
        if self.words:
            return self.words[index]
        unit = f" {self.units}" if self.units else ""
        return f"{self.values[index]:.6g}{unit}"


class Study:
    """One variable of a result over its axes."""

    def __init__(self, file, variable):
        if "status" not in file:
            raise BadInput("is no result of a study: it has no variable status")
        self.title = text(file.attrs.get("title", ""))
        self.name = variable or default_variable(file)
        if self.name not in file or not is_drawable(file, self.name):
            names = ", ".join(name for name in file if is_drawable(file, name))
            raise BadInput(f"has no variable {self.name} to draw; it has {names}")
        dataset = file[self.name]
        self.data = np.asarray(dataset[()], dtype=float)
        self.status = np.asarray(file["status"][()])
        self.data = np.where((self.status == 0) & np.isfinite(self.data), self.data, np.nan)
        self.label = text(dataset.attrs.get("long_name", self.name))
        units = shown_units(text(dataset.attrs.get("units", "1")))
        self.label += f" [{units}]" if units else ""
        names = text(dataset.attrs.get("coordinates", "")).split()
        self.is_grid = not names and self.data.ndim > 0
        if self.is_grid:
            self.axes = [Axis(dimension[0]) for dimension in dataset.dims]
        else:
            self.axes = [Axis(file[name]) for name in names]
            if self.data.ndim == 1 and not self.axes:
                self.axes = [Axis(dataset.dims[0][0])]


def is_drawable(file, name):
    return (isinstance(file[name], h5py.Dataset) and file[name].dtype.kind in "fi"
            and file[name].shape == file["status"].shape
            and file[name].attrs.get("CLASS") != b"DIMENSION_SCALE"
            and name not in text(file["status"].attrs.get("coordinates", "")).split()
            and name not in ("status", "failure_code", "trace_start", "trace_count"))


def default_variable(file):
    names = [name for name in file if is_drawable(file, name)]
    for name in (*FIRST_CHOICES, *names):
        if name in names and np.isfinite(file[name][()]).any():
            return name
    if not names:
        raise BadInput("has no variable to draw")
    return names[0]


def wants_log(values):
    """True for positive values over more than two decades."""
    values = values[np.isfinite(values)]
    return bool(values.size and values.min() > 0
                and np.log10(values.max() / values.min()) > LOG_DECADES)


def edges(axis):
    """Borders of the cells around the values of an axis, midway (in the log where it is one)."""
    values = axis.values
    if len(values) == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    log = not axis.words and wants_log(values)
    points = np.log(values) if log else values
    middle = 0.5 * (points[1:] + points[:-1])
    borders = np.concatenate([[2 * points[0] - middle[0]], middle, [2 * points[-1] - middle[-1]]])
    return np.exp(borders) if log else borders


def sorted_axis(axis, data, dimension):
    """Axis values ascending, data to match: lists in a study may be in any order."""
    order = np.argsort(axis.values, kind="stable")
    axis.values = axis.values[order]
    return np.take(data, order, axis=dimension)


def dress_axis(axes, which, axis):
    getattr(axes, f"set_{which}label")(axis.label)
    if axis.words:
        getattr(axes, f"set_{which}ticks")(axis.values)
        slant = {"rotation": 30, "ha": "right"} if which == "x" and len(axis.words) > 3 else {}
        getattr(axes, f"set_{which}ticklabels")(axis.words, **slant)
        getattr(axes, f"set_{which}lim")(-0.5, len(axis.words) - 0.5)
    elif wants_log(axis.values):
        getattr(axes, f"set_{which}scale")("log")


def draw_curve(axes, axis, values):
    """A single curve; failed and skipped points are grey bands."""
    axes.plot(axis.values, values, marker="o" if len(axis) <= 40 else None, markersize=3.5,
              color=CURVE_COLOURS[0])
    borders = edges(axis)
    for index in np.flatnonzero(np.isnan(values)):
        axes.axvspan(borders[index], borders[index + 1], facecolor="#EEEEEE", edgecolor="none",
                     zorder=0)


def draw_family(axes, curves, axis, data):
    """Curves over one axis, labelled by the values of another where there is one."""
    for index, values in enumerate(data):
        label = curves.value_text(index) if curves else None
        if label or axis.words:
            mark = "o" if len(axis) <= 40 else None
            axes.plot(axis.values, values, linestyle="" if axis.words else "-", marker=mark,
                      markersize=6 if axis.words else 3.5, label=label,
                      color=CURVE_COLOURS[index % len(CURVE_COLOURS)])
        else:
            draw_curve(axes, axis, values)
    axes.grid(axis="y", color="#DDDDDD", linewidth=0.6)
    axes.set_axisbelow(True)


def scale_of(data):
    finite = data[np.isfinite(data)]
    if not finite.size:
        raise BadInput("has no finished point with a value of this variable")
    if wants_log(data):
        return LogNorm(finite.min(), finite.max())
    low, high = finite.min(), finite.max()
    return Normalize(low, high if high > low else low + 1.0)


def draw_map(axes, down, across, data, scale):
    """Failed and skipped points show the hatched ground."""
    axes.set_facecolor("#E8E8E8")
    axes.patch.set_hatch("////")
    axes.patch.set_edgecolor("#BBBBBB")
    return axes.pcolormesh(edges(across), edges(down), np.ma.masked_invalid(data), norm=scale,
                           cmap="viridis", rasterized=True)


def draw_grid(figure, study):
    """One panel, or one for every value of the first of three axes, with one scale for all."""
    across = study.axes[-1]
    second = study.axes[-2] if len(study.axes) > 1 else None
    panels = study.axes[0] if len(study.axes) > 2 else None
    data = sorted_axis(across, study.data, -1).reshape(
        (len(panels) if panels else 1, len(second) if second else 1, len(across)))
    as_curves = second is None or is_family(second)
    if not as_curves:
        data = sorted_axis(second, data, 1)
    scale = scale_of(data)
    columns, rows = panel_table(study)
    grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    for index, axes in enumerate(grid.flat):
        if index >= len(data):
            axes.set_visible(False)
            continue
        if as_curves:
            draw_family(axes, second, across, data[index])
        else:
            image = draw_map(axes, second, across, data[index], scale)
            dress_axis(axes, "y", second)
        dress_axis(axes, "x", across)
        if as_curves and isinstance(scale, LogNorm):
            axes.set_yscale("log")
        if panels:
            name = "" if panels.words else f"{panels.short}: "
            axes.set_title(name + panels.value_text(index))
            axes.set(xlabel="", ylabel="")
            axes.xaxis.set_tick_params(labelbottom=index + columns >= len(data))
    down_label = study.label if as_curves else second.label
    if panels:
        figure.supxlabel(across.label, fontsize=9.5, color="#222222")
        figure.supylabel(down_label, fontsize=9.5, color="#222222")
    else:
        grid[0, 0].set_ylabel(down_label)
    if not as_curves:
        bar = figure.colorbar(image, ax=grid, label=study.label, aspect=30, pad=0.02)
        bar.outline.set_linewidth(0.0)
    elif second:
        grid[0, -1].legend(title=second.short, loc="upper left", bbox_to_anchor=(1.01, 1.0),
                           alignment="left", borderaxespad=0.0)


def draw_points(figure, study):
    """Zip and sampled designs: points over the first parameter that varies."""
    varying = [axis for axis in study.axes if len(set(axis.values)) > 1] or study.axes
    axis, axes = varying[0], figure.subplots()
    ordered = 3 <= len(axis) <= 200 and bool((np.diff(axis.values) > 0).all()) and not axis.words
    axes.plot(axis.values, study.data, "o-" if ordered else "o", color=CURVE_COLOURS[0],
              markersize=6 if len(axis) <= 20 else 4 if len(axis) <= 200 else 2,
              alpha=1.0 if len(axis) <= 200 else 0.6,
              markeredgewidth=0)
    dress_axis(axes, "x", axis)
    axes.set_ylabel(study.label)
    if wants_log(study.data):
        axes.set_yscale("log")
    axes.grid(axis="y", color="#DDDDDD", linewidth=0.6)


def draw_value(figure, study):
    """A study without a sweep is one number."""
    axes = figure.subplots()
    axes.axis("off")
    axes.text(0.5, 0.6, f"{float(study.data):.6g}", ha="center", fontsize=28,
              color=CURVE_COLOURS[0])
    axes.text(0.5, 0.35, study.label, ha="center", fontsize=11)


def drop_single_axes(study):
    """Axes of one value say nothing as an axis; their value goes to the title."""
    notes = []
    for position in reversed(range(len(study.axes))):
        if len(study.axes[position]) == 1 and len(study.axes) > 1:
            axis = study.axes.pop(position)
            study.data = np.squeeze(study.data, axis=position)
            notes.insert(0, f"{axis.short} {axis.value_text(0)}")
    return notes


def hold_further_axes(study):
    """More than three axes: texts and the longest are kept, the others held in the middle."""
    notes = []
    while len(study.axes) > 3:
        shortest = min(range(len(study.axes)),
                       key=lambda d: (study.axes[d].words is not None, len(study.axes[d])))
        axis = study.axes.pop(shortest)
        middle = len(axis) // 2
        study.data = np.take(study.data, middle, axis=shortest)
        notes.append(f"{axis.short} {axis.value_text(middle)}")
    return notes


def is_family(axis):
    """True for an axis whose values are better told apart as curves than along a map."""
    return axis.words is not None or len(axis) <= FEW


def order_axes(study):
    """Texts first, then the shortest of three: panels, then curves or the map, along the last."""
    by_use = [d for d, axis in enumerate(study.axes) if axis.words]
    numbers = [d for d in range(len(study.axes)) if d not in by_use]
    if len(study.axes) == 3 and not by_use or len(numbers) == 2:
        shortest = min(numbers, key=lambda d: len(study.axes[d]))
        if len(study.axes) == 3 and not by_use or len(study.axes[shortest]) <= FEW:
            numbers.remove(shortest)
            numbers.insert(0, shortest)
    order = by_use + numbers
    study.axes = [study.axes[d] for d in order]
    study.data = np.transpose(study.data, order)


def thin_panels(study):
    """Keeps at most MOST_PANELS evenly spaced values of the first of three axes."""
    axis = study.axes[0]
    if len(axis) <= MOST_PANELS:
        return []
    note = f"{MOST_PANELS} of {len(axis)} values of {axis.short}"
    kept = np.linspace(0, len(axis) - 1, MOST_PANELS).round().astype(int)
    study.data = study.data[kept]
    axis.values = axis.values[kept]
    axis.words = [axis.words[k] for k in kept] if axis.words else None
    return [note]


def panel_table(study):
    """Columns and rows of panels."""
    panels = len(study.axes[0]) if study.is_grid and len(study.axes) == 3 else 1
    columns = panels if panels <= 4 else 3 if panels in (5, 6, 9) else 4
    return columns, -(-panels // columns)


def draw(study):
    notes = []
    if study.is_grid:
        notes = drop_single_axes(study) + hold_further_axes(study)
        order_axes(study)
        notes += thin_panels(study) if len(study.axes) == 3 else []
    columns, rows = panel_table(study)
    size = (6.4, 4.0) if columns == 1 else (1.8 + 2.5 * columns, 1.2 + 2.2 * rows)
    figure = plt.figure(figsize=size)
    if not study.axes:
        draw_value(figure, study)
    elif study.is_grid:
        draw_grid(figure, study)
    else:
        draw_points(figure, study)
    missing = int((study.status != 0).sum())
    if missing:
        notes.append(f"{missing} of {study.status.size} points failed or skipped")
    lines = [study.title] * bool(study.title) + ["; ".join(notes)] * bool(notes)
    figure.suptitle("\n".join(lines), fontsize=10)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("result", help="result file (.h5)")
    parser.add_argument("-o", "--output", help="picture; by default beside the result, as .png")
    parser.add_argument("--variable", help="variable to draw, e.g. force_x_max")
    parser.add_argument("--dpi", type=int, default=150)
    arguments = parser.parse_args()
    output = arguments.output or str(pathlib.Path(arguments.result).with_suffix(".png"))
    plt.rcParams.update(STYLE)
    try:
        if not 10 <= arguments.dpi <= 2000:
            raise BadInput(f"cannot be drawn with {arguments.dpi} dpi: 10 to 2000")
        if not pathlib.Path(arguments.result).is_file():
            raise BadInput("no such file")
        if not h5py.is_hdf5(arguments.result):
            raise BadInput("is no HDF5 file")
        with h5py.File(arguments.result, "r") as file:
            study = Study(file, arguments.variable)
        draw(study).savefig(output, dpi=arguments.dpi)
    except Exception as error:  # whatever is in the file: one line
        line = " ".join(str(error).split())
        print(f"plot_study.py: {arguments.result}: {line}", file=sys.stderr)
        return 2
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())

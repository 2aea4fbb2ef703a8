#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a result file of millstudy: a curve for one axis, a map for two, small multiples for more.

Of more than three axes, the further ones are held at their middle value, and the title says so.
Results of zip designs are drawn as points over the first parameter that varies. Time histories
(--variable traces, or one of them) are drawn for the points named by --point.
"""
import argparse
import pathlib
import re
import sys
import textwrap

try:
    import h5py
    import matplotlib
    import numpy as np
except ImportError as error:
    sys.exit(f"plot_study.py: {error} (Debian: apt install python3-h5py python3-matplotlib)")

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import LogNorm, Normalize  # noqa: E402
from matplotlib.ticker import MaxNLocator, MultipleLocator  # noqa: E402

FIRST_CHOICES = ("force_resultant_mean", "feed_fluctuation_max", "axial_depth_limit", "surface_location_error",
                 "spectral_radius")
# Okabe and Ito's colours: told apart with every kind of colour vision.
CURVE_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
# Curves that coincide show through each other's gaps, markers inside each other.
CURVE_DASHES = ("-", (0, (5, 2.5)), (0, (1.2, 1.6)), (0, (6, 2, 1.2, 2)), (0, (3, 1.5)))
CURVE_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
MARKER_SIZES = (6.5, 5.0, 4.0, 3.0)
FEW = 5
FEW_TICKS = 12
MOST_PANELS = 12
MOST_POINTS = 6
LOG_DECADES = 2.0
STYLE = {
    "font.size": 9.5, "axes.titlesize": 9.5, "axes.labelsize": 9.5, "legend.fontsize": 8.5,
    "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8,
    "axes.edgecolor": "#444444", "xtick.color": "#444444", "ytick.color": "#444444",
    "axes.labelcolor": "#222222", "legend.frameon": False, "axes.grid": False,
    "axes.formatter.useoffset": False, "lines.linewidth": 1.6,
    "hatch.linewidth": 0.5, "figure.constrained_layout.use": True,
}


class BadInput(Exception):
    """Something the user can mend; printed as one line, about the result or what is named."""

    def __init__(self, what, about=None):
        super().__init__(what)
        self.about = about


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
            words = [text(word) for word in dataset[()]]
            # Files are told apart by their names alone.
            stems = [pathlib.PurePath(word).stem if word.endswith(".toml") else word for word in words]
            self.words = stems if len(set(stems)) == len(words) else words
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
            raise no_such_variable(file, self.name)
        dataset = file[self.name]
        self.data = np.asarray(dataset[()], dtype=float)
        self.status = np.asarray(file["status"][()])
        self.data = np.where((self.status == 0) & np.isfinite(self.data), self.data, np.nan)
        self.label = label_of(dataset)
        names = text(dataset.attrs.get("coordinates", "")).split()
        self.is_grid = not names and self.data.ndim > 0
        self.axes = axes_of(file, dataset, names)


class Histories:
    """Time histories of some points, over the spindle angle or the time."""

    def __init__(self, file, variable, points, over):
        if "trace_start" not in file:
            raise BadInput("has no time histories: [output] traces = true keeps them")
        names = trace_names(file)
        self.all_forces = variable == "traces"
        forces = [name for name in names if name.startswith("trace_force_")]
        chosen = forces if self.all_forces else [variable]
        if not set(chosen) <= set(names):
            raise no_such_variable(file, variable)
        self.title = text(file.attrs.get("title", ""))
        abscissa = file["trace_angle" if over == "angle" else "trace_time"]
        self.over = "spindle angle [°]" if over == "angle" else "time [s]"
        self.degrees = over == "angle"
        self.labels = [label_of(file[name]) for name in chosen]
        self.panels = [self.read(file, point, abscissa, chosen) for point in points]

    def read(self, file, point, abscissa, chosen):
        """Title, abscissa, and values of one point."""
        starts, counts = file["trace_start"][()], file["trace_count"][()]
        if not 0 <= point < starts.size:
            raise BadInput(f"has no point {point}: it has {starts.size}, from 0")
        first, count = int(starts.flat[point]), int(counts.flat[point])
        if count == 0:
            raise BadInput(f"has no time history of point {point}: {reason(file, point)}")
        part = slice(first, first + count)
        across = np.asarray(abscissa[part], dtype=float)
        return (point_title(file, point), np.degrees(across) if self.degrees else across,
                [np.asarray(file[name][part], dtype=float) for name in chosen])


def trace_names(file):
    return [name for name in file if name.startswith("trace_") and file[name].dtype.kind == "f"]


def reason(file, point):
    """Why a point has no values."""
    status = int(file["status"][()].flat[point])
    if status == 1 and "failure" in file:
        return "it failed: " + text(file["failure"][int(file["failure_code"][()].flat[point])])
    return {1: "it failed", 2: "it was skipped", 3: "it was not run"}.get(status, "it is empty")


def point_title(file, point):
    """The parameters of one point: those that vary."""
    status = file["status"]
    names = text(status.attrs.get("coordinates", "")).split()
    axes = axes_of(file, status, names)
    places = [point] * len(axes) if names else np.unravel_index(point, status.shape)
    parts = [f"{axis.short} {axis.value_text(int(place))}" for axis, place in zip(axes, places)
             if axis.name != "point" and len(set(axis.values)) > 1]
    return "\n".join(parts) or f"point {point}"


def axes_of(file, dataset, names):
    """Axes of a variable: the parameters named, or its dimensions."""
    if names:
        missing = [name for name in names if name not in file]
        if missing:
            raise BadInput(f"has no variable {missing[0]}, which {dataset.name} names")
        return [Axis(file[name]) for name in names]
    if not all(len(dimension) for dimension in dataset.dims):
        raise BadInput(f"has a dimension of {dataset.name} without values")
    return [Axis(dimension[0]) for dimension in dataset.dims]


def label_of(dataset):
    units = shown_units(text(dataset.attrs.get("units", "1")))
    name = text(dataset.attrs.get("long_name", dataset.name.lstrip("/")))
    return f"{name} [{units}]" if units else name


def no_such_variable(file, name):
    names = [each for each in file if is_drawable(file, each)]
    names += ["traces", *trace_names(file)] if "trace_start" in file else []
    return BadInput(f"has no variable {name} to draw; it has {', '.join(names)}")


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


def is_log_axis(values):
    """True for positive values, nearly evenly spaced in ratio, over more than a decade."""
    values = np.sort(values)
    if len(values) < 3 or values[0] <= 0 or values[-1] <= 10 * values[0]:
        return False
    steps = np.diff(np.log(values))
    return bool(steps.min() > 0 and steps.max() < 2.0 * steps.min())


def edges(axis):
    """Borders of the cells around the values of an axis, midway (in the log where it is one)."""
    values = axis.values
    if len(values) == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    log = not axis.words and is_log_axis(values)
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
    elif is_log_axis(axis.values):
        getattr(axes, f"set_{which}scale")("log")
    elif len(axis) <= FEW_TICKS and (axis.values == np.round(axis.values)).all():
        getattr(axes, f"{which}axis").set_major_locator(MaxNLocator(integer=True))


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
            dashes = CURVE_DASHES[index % len(CURVE_DASHES)]
            mark = CURVE_MARKERS[index % len(CURVE_MARKERS)] if len(axis) <= 40 else None
            axes.plot(axis.values, values, linestyle="" if axis.words else dashes, marker=mark,
                      markersize=MARKER_SIZES[index % len(MARKER_SIZES)], label=label,
                      markerfacecolor="none" if index % 2 == 0 and len(data) > 1 else None,
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
    down_label = fitting(study.label if as_curves else second.label, 0.9 * figure.get_figheight())
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


def fitting(text, inches):
    """Lines of text that are no longer than a figure's side, of characters of 10 points."""
    return "\n".join(textwrap.fill(line, int(13.5 * inches)) for line in text.split("\n"))


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
    """Keeps every second, third, ... value of the first of three axes: at most MOST_PANELS."""
    axis = study.axes[0]
    if len(axis) <= MOST_PANELS:
        return []
    stride = -(-len(axis) // MOST_PANELS)
    kept = np.arange(0, len(axis), stride)
    note = f"{len(kept)} of {len(axis)} values of {axis.short}"
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
    for code, name in ((1, "failed"), (2, "skipped"), (3, "not run")):
        count = int((study.status == code).sum())
        if count:
            notes.append(f"{count:,} of {study.status.size:,} points {name}")
    lines = [study.title] * bool(study.title) + ["; ".join(notes)] * bool(notes)
    figure.suptitle(fitting("\n".join(lines), size[0]), fontsize=10)
    return figure


def draw_histories(histories):
    """A panel for every point, with one scale for all."""
    columns = 2 if len(histories.panels) == 4 else min(len(histories.panels), 3)
    rows = -(-len(histories.panels) // columns)
    figure = plt.figure(figsize=(6.4, 4.0) if columns == 1 else (1.6 + 3.4 * columns,
                                                                 0.9 + 2.9 * rows))
    grid = figure.subplots(rows, columns, squeeze=False, sharey=True)
    for axes in grid.flat[len(histories.panels):]:
        axes.set_visible(False)
    for axes, (title, across, curves) in zip(grid.flat, histories.panels):
        for index, values in enumerate(curves):
            axes.plot(across, values, linestyle=CURVE_DASHES[index % len(CURVE_DASHES)],
                      color=CURVE_COLOURS[index % len(CURVE_COLOURS)],
                      label=re.sub(r" \[.*", "", histories.labels[index]))
        if histories.all_forces:
            axes.plot(across, np.sqrt(sum(values ** 2 for values in curves)), color="#888888",
                      linewidth=1.0, label="resultant", zorder=1)
        axes.axhline(0.0, color="#444444", linewidth=0.6, zorder=0)
        axes.grid(axis="y", color="#DDDDDD", linewidth=0.6)
        axes.set_axisbelow(True)
        axes.set_title(title)
        axes.set_xlabel(histories.over)
        axes.set_xlim(across[0], across[-1] + (across[1] - across[0] if len(across) > 1 else 1.0))
        if histories.degrees and np.ptp(across) <= 720.0:
            axes.xaxis.set_major_locator(MultipleLocator(90.0))
    one = len(histories.labels) == 1
    for axes in grid[:, 0]:
        axes.set_ylabel(histories.labels[0] if one else "force on the tool [N]")
    if not one:
        grid[0, columns - 1].legend(loc="upper left", bbox_to_anchor=(1.01, 1.0),
                                    borderaxespad=0.0)
    figure.suptitle(fitting(histories.title, figure.get_figwidth()), fontsize=10)
    return figure


def read(arguments):
    """What is to be drawn, out of the file; errors of HDF5 are the file's."""
    if not pathlib.Path(arguments.result).is_file():
        raise BadInput("no such file")
    wants_traces = (arguments.variable or "").startswith("trace")
    points = arguments.point or [0]
    if len(points) > MOST_POINTS:
        raise BadInput(f"cannot be drawn with more than {MOST_POINTS} points in one picture")
    if (arguments.point or arguments.over) and not wants_traces:
        raise BadInput("--point and --over are for time histories: --variable traces")
    try:
        if not h5py.is_hdf5(arguments.result):
            raise BadInput("is no HDF5 file")
        with h5py.File(arguments.result, "r") as file:
            if wants_traces:
                return Histories(file, arguments.variable, points, arguments.over or "angle")
            return Study(file, arguments.variable)
    except (OSError, RuntimeError) as error:
        raise BadInput(str(error)) from error


def save(figure, output, dpi):
    """Errors here are those of the picture: its folder, its permissions, its ending."""
    endings = figure.canvas.get_supported_filetypes()
    ending = pathlib.Path(output).suffix.lstrip(".").lower()
    if ending not in endings:
        raise BadInput(f"no such kind of picture; take one of {', '.join(sorted(endings))}", output)
    try:
        figure.savefig(output, dpi=dpi)
    except OSError as error:
        raise BadInput(f"cannot be written: {error.strerror or error}", output) from error


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("result", help="result file (.h5)")
    parser.add_argument("-o", "--output", help="picture; by default beside the result, as .png")
    parser.add_argument("--variable", help="variable to draw, e.g. force_x_max; a time history, "
                        "e.g. trace_force_x; or traces: the forces in x, y and z together")
    parser.add_argument("--point", type=int, nargs="+", metavar="N", help="points to draw time "
                        "histories of, counted from 0 in the order of the table (default: 0)")
    parser.add_argument("--over", choices=("angle", "time"),
                        help="time histories over the spindle angle (default) or the time")
    parser.add_argument("--dpi", type=int, default=150)
    arguments = parser.parse_args()
    output = arguments.output or str(pathlib.Path(arguments.result).with_suffix(".png"))
    plt.rcParams.update(STYLE)
    try:
        if not 10 <= arguments.dpi <= 2000:
            raise BadInput(f"cannot be drawn with {arguments.dpi} dpi: 10 to 2000", output)
        drawn = read(arguments)
        figure = draw_histories(drawn) if isinstance(drawn, Histories) else draw(drawn)
        save(figure, output, arguments.dpi)
    except BadInput as error:
        line = " ".join(str(error).split())
        print(f"plot_study.py: {error.about or arguments.result}: {line}", file=sys.stderr)
        return 2
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())

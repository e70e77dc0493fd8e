"""force_graph.py - a graph of each foot's vertical force over time, drawn into a corner of a viewport.

Forces --layout--> lines, bands and labels in pixels --draw--> the viewport
"""

from dataclasses import dataclass, field

import numpy as np

from . import compat
from .drawing import batch, blf, gpu

COLOURS = (
    (0.35, 0.66, 0.95),
    (0.95, 0.52, 0.25),
    (0.40, 0.80, 0.45),
    (0.75, 0.50, 0.90),
    (0.90, 0.78, 0.30),
    (0.45, 0.80, 0.85),
)
PAPER, INK, PALE = (0.08, 0.08, 0.08, 0.82), (0.9, 0.9, 0.9, 1.0), (0.9, 0.9, 0.9, 0.35)
WIDE, HIGH = 460.0, 190.0  # of a graph [pixel], times the interface's scale
EDGE = 14.0  # between graphs and to the viewport's edge
LEFT, RIGHT, BELOW, ABOVE = 40.0, 12.0, 30.0, 26.0  # of the plot inside its paper
LETTERS = 11.0  # size of letters
DASH = 6.0


@dataclass
class Layout:
    """A graph in pixels of its region."""

    paper: tuple  # x, y, width, height
    bands: list = field(default_factory=list)  # (x, y, width, height, colour) of contacts
    lines: list = field(default_factory=list)  # (points (n, 2) of a strip, colour, width)
    labels: list = field(default_factory=list)  # (x, y, text, colour, where the text stands: 0 left .. 1 right)


def layout(forces, name, frame, region, scale, row=0):
    """The graph of one armature; region: (width, height) [pixel]; row: 0 = the lowest."""
    width = min(WIDE * scale, region[0] - 2 * EDGE * scale)
    height = HIGH * scale
    x, y = EDGE * scale, EDGE * scale + row * (height + EDGE * scale)
    out = Layout((x, y, width, height))
    left, low = x + LEFT * scale, y + BELOW * scale
    wide, high = width - (LEFT + RIGHT) * scale, height - (BELOW + ABOVE) * scale
    if wide <= 0.0 or y + height > region[1]:
        return out
    frames = forces.frame_start + (forces.time - forces.time[0]) * forces.frame_rate
    vertical = forces.force[:, :, 2]
    top = max(1.2, 1.1 * float(vertical.max(initial=0.0)))
    bottom = min(0.0, float(vertical.min(initial=0.0)))
    last = max(frames[-1], frames[0] + 1e-6)
    across = lambda value: left + wide * (np.asarray(value) - frames[0]) / (last - frames[0])
    upward = lambda value: low + high * (np.asarray(value) - bottom) / (top - bottom)

    step = _step(top - bottom, 4)
    for value in np.arange(0.0, top, step):
        out.lines.append((np.array(((left, upward(value)), (left + wide, upward(value)))), PALE, 1.0))
        out.labels.append((left - 6 * scale, upward(value) - 4 * scale, f"{value:g}", INK, 1.0))
    step = max(1.0, _step(last - frames[0], 6))
    for value in np.arange(np.ceil(frames[0] / step) * step, last + 1e-6, step):
        out.labels.append((across(value), low - 15 * scale, f"{value:g}", INK, 0.5))
    out.labels.append((left + wide, y + 4 * scale, "frame", INK, 1.0))

    for limb, force in enumerate(vertical):
        colour = COLOURS[limb % len(COLOURS)]
        edges = np.flatnonzero(np.diff(np.concatenate([[0], forces.touching[limb].astype("i1"), [0]])))
        for first, end in zip(edges[::2], edges[1::2]):
            begin, until = across(frames[first]), across(frames[end - 1])
            out.bands.append((begin, low, max(until - begin, 1.0), high, (*colour, 0.14)))
        out.lines.append((np.stack([across(frames), upward(force)], axis=1), (*colour, 1.0), 2.0))
    body = upward(1.0)
    for begin in np.arange(left, left + wide, 2 * DASH * scale):  # body weight, dashed
        end = min(begin + DASH * scale, left + wide)
        out.lines.append((np.array(((begin, body), (end, body))), INK, 1.0))
    if frames[0] <= frame <= last:
        now = across(frame)
        out.lines.append((np.array(((now, low), (now, low + high))), (1.0, 1.0, 1.0, 0.9), 1.0))

    head = y + height - 17 * scale
    out.labels.append((x + 8 * scale, head, f"{name}: vertical force [body weights]", INK, 0.0))
    place = left + wide
    for limb in reversed(range(len(vertical))):
        out.labels.append((place, head, forces.names[limb], (*COLOURS[limb % len(COLOURS)], 1.0), 1.0))
        place -= (0.62 * LETTERS * len(forces.names[limb]) + 10) * scale
    return out


def _step(span, most):
    """A round step of which about `most` fit into a span."""
    rough = max(span, 1e-9) / most
    power = 10.0 ** np.floor(np.log10(rough))
    return float(next(k * power for k in (1.0, 2.0, 5.0, 10.0) if k * power >= rough))


# ---- drawing ------------------------------------------------------------------------------------------


def draw(context, name, forces, frame, row):
    region, scale = context.region, context.preferences.system.ui_scale
    graph = layout(forces, name, frame, (region.width, region.height), scale, row)
    if not graph.lines:
        return
    flat, room = compat.flat_shader()
    line = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    gpu.state.blend_set("ALPHA")
    for x, y, width, height, colour in [(*graph.paper, PAPER)] + graph.bands:
        corners = [(x, y), (x + width, y), (x, y + height), (x + width, y + height)]
        corners = [(*each, 0.0)[:room] for each in corners]
        flat.bind()
        flat.uniform_float("color", colour)
        batch.batch_for_shader(flat, "TRI_STRIP", {"pos": corners}).draw(flat)
    for points, colour, width in graph.lines:
        line.bind()
        line.uniform_float("viewportSize", (region.width, region.height))
        line.uniform_float("lineWidth", width * scale)
        line.uniform_float("color", colour)
        strip = [(float(x), float(y), 0.0) for x, y in points]
        batch.batch_for_shader(line, "LINE_STRIP", {"pos": strip}).draw(line)
    gpu.state.blend_set("NONE")
    for x, y, text, colour, where in graph.labels:
        blf.size(0, LETTERS * scale)
        blf.color(0, *colour)
        blf.position(0, x - where * blf.dimensions(0, text)[0], y, 0.0)
        blf.draw(0, text)

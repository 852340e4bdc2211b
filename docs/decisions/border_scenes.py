#!/usr/bin/env python3
"""Writes the scenes of border.md into a folder: nets of cables tied in knots, and planks on two ropes.

    docs/decisions/border_scenes.py FOLDER
"""

import math
import pathlib
import sys

ROPE = "axial_stiffness = {}\nbending_stiffness = {}\nmass_per_length = {}\ndamping = {{ axial = {}, bending = 0.01 }}\n"


def net(side, duration):
    """A net of side x side knots that are 0.4 m apart, held at its corners, catches a ball, as assets/contact/net.toml."""
    half = 0.2 * (side - 1)
    out = [f'name = "net{2 * side * (side - 1)}"\nduration = {duration}\n\n[[body]]\nname = "ball"\nshape = {{ ball = 0.3 }}\n'
           "mass = 5.0\nposition = [0.05, 1.3, 0.03]\nfriction = 0.5\n"]
    ends = {}
    for i in range(side):
        for j in range(side):
            for direction, (a, b) in (("x", (i + 1, j)), ("z", (i, j + 1))):
                if a < side and b < side:
                    name, points = f"{direction}{i}_{j}", [[0.4 * x - half, 0, 0.4 * z - half] for x, z in ((i, j), (a, b))]
                    out.append(f'[[cable]]\nname = "{name}"\npoints = {points}\nelements = 4\n'
                               + ROPE.format(100000, 0.01, 0.05, 0.005) + "contact = { radius = 0.005, friction = 0.5 }\n")
                    ends.setdefault((i, j), []).append((name, "start"))
                    ends.setdefault((a, b), []).append((name, "end"))
    for (i, j), tied in ends.items():
        if i in (0, side - 1) and j in (0, side - 1):
            out += [f'[[attachment]]\ncable = "{cable}"\nat = "{end}"\nbody = "world"\n' for cable, end in tied]
        else:
            (first, at), *others = tied
            out += [f'[[junction]]\ncable = "{first}"\nat = "{at}"\nother = "{cable}"\nother_at = "{end}"\n'
                    for cable, end in others]
    return "\n".join(out)


def bridge(planks, hooks, duration):
    """Two ropes with planks of 1 m, each on one or two hooks per rope; a box falls on it."""
    count = 2 * planks

    def at(k):
        return planks * k / count, 5.0 - 0.32 * planks * (k / count) * (1 - k / count)

    length = sum(math.dist(at(k), at(k + 1)) for k in range(count))
    out = [f'name = "bridge{2 * planks * hooks}"\nduration = {duration}\n']
    for cable, z in (("a", -0.6), ("b", 0.6)):
        points = [[*at(k), z] for k in range(count + 1)]
        out.append(f'[[cable]]\nname = "{cable}"\npoints = {points}\nelements = {count}\n' + ROPE.format(5e5, 0.2, 0.4, 0.01))
        out += [f'[[attachment]]\ncable = "{cable}"\nat = "{end}"\nbody = "world"\n' for end in ("start", "end")]
    for plank in range(planks):
        places = [2 * plank + 1] if hooks == 1 else [2 * plank + 0.6, 2 * plank + 1.4]
        x, y = (sum(at(k)[c] for k in places) / len(places) for c in (0, 1))
        out.append(f'[[body]]\nname = "plank{plank}"\nshape = {{ cuboid = [0.4, 0.03, 0.6] }}\nmass = 15.0\nposition = [{x}, {y}, 0.0]\n')
        out += [f'[[attachment]]\ncable = "{cable}"\nat = {length * k / count}\nbody = "plank{plank}"\n' for cable in "ab" for k in places]
    out.append(f'[[body]]\nname = "box"\nshape = {{ cuboid = [0.3, 0.3, 0.3] }}\nmass = 60.0\nposition = [{planks / 2}, 7.0, 0.0]\n')
    return "\n".join(out)


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "net40.toml").write_text(net(5, 3.0))
    (folder / "net180.toml").write_text(net(10, 1.5))
    for planks, hooks in ((10, 1), (10, 2), (20, 1), (20, 2)):
        (folder / f"bridge{2 * planks * hooks}.toml").write_text(bridge(planks, hooks, 2.0))

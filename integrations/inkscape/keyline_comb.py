#!/usr/bin/env python3
"""Keyline > Curvature comb: lines across a path, as long as its curvature is large."""

import keyline_paths as kp


PLAIN = {"stroke": "#d40055", "stroke-dasharray": "none", "marker-start": "none", "marker-mid": "none", "marker-end": "none"}


class Comb(kp.Extension):
    def add_arguments(self, pars):
        pars.add_argument("--height", type=float, default=0.2)
        pars.add_argument("--teeth", type=int, default=120)

    def effect(self):
        """The tallest tooth is `height` of the longest curve's length; all stand on one scale, on the outer side."""
        shapes = [(shape, curve) for shape in self.paths() for curve in kp.curves_of(shape)]
        combs = [self.perform(shape, "curve.show", {"curve": curve, "comb": {}})["comb"] for shape, curve in shapes]
        largest = max(abs(k) for comb in combs for k in comb["curvature"])
        longest = max(comb["arc_length"][-1] for comb in combs)
        if largest * longest < 1e-9:
            raise kp.inkex.AbortExtension("All is straight: the comb is flat.")
        for (shape, _), comb in zip(shapes, combs):
            self.draw(shape, comb, self.options.height * longest / largest)

    def draw(self, shape, comb, scale):
        step = max(1, len(comb["points"]) // self.options.teeth)
        teeth, tips = kp.Path(), kp.Path()
        for i, (point, normal, k) in enumerate(zip(comb["points"], comb["normals"], comb["curvature"])):
            tip = (point[0] - scale * k * normal[0], point[1] - scale * k * normal[1])
            tips.append((kp.inkex.paths.Line if i else kp.inkex.paths.Move)(*tip))
            if i % step == 0:
                teeth.append(kp.inkex.paths.Move(*point))
                teeth.append(kp.inkex.paths.Line(*tip))
        width = shape.specified_style().get("stroke-width", 1)
        thin = str(self.svg.unittouu(str(width)) / 3)
        for data in (teeth, tips):
            kp.put(shape, data, **PLAIN, **{"stroke-width": thin})


if __name__ == "__main__":
    Comb().run()

#!/usr/bin/env python3
"""Keyline > Curvature comb: lines across a path, as long as its curvature is large."""

import keyline_paths as kp
from keyline_paths import keyline


class Comb(kp.Extension):
    def add_arguments(self, pars):
        pars.add_argument("--height", type=float, default=0.2)
        pars.add_argument("--teeth", type=int, default=120)

    def work(self):
        for shape in self.paths(1):
            for curve in kp.curves_of(shape):
                self.draw(shape, keyline.perform("curve.show", {"curve": curve, "comb": {}})["comb"])

    def draw(self, shape, comb):
        """The tallest tooth is `height` of the path's length; they stand on its outer side."""
        largest = max(abs(k) for k in comb["curvature"])
        if largest == 0:
            raise kp.inkex.AbortExtension("The path is straight: its comb is flat.")
        scale = self.options.height * comb["arc_length"][-1] / largest
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
            kp.put(shape, data, **{"stroke": "#d40055", "stroke-width": thin})


if __name__ == "__main__":
    Comb().run()

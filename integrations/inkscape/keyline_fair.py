#!/usr/bin/env python3
"""Keyline > Fair path: each selected path becomes the calmest curve within the tolerance."""

import keyline_paths as kp
from keyline_paths import keyline


class Fair(kp.Extension):
    def add_arguments(self, pars):
        pars.add_argument("--tolerance", type=float, default=0)
        pars.add_argument("--keep_corners", type=kp.inkex.Boolean, default=True)
        pars.add_argument("--keep_original", type=kp.inkex.Boolean, default=False)

    def work(self):
        for shape in self.paths(1):
            data = kp.Path()
            for curve in kp.curves_of(shape):
                answer = self.fair(curve)
                data += kp.as_path(answer["bezier"])
                if not answer["within_tolerance"]:
                    name, worst = shape.get_id(), answer["deviation"]["max"]
                    self.msg(f"{name}: up to {worst:.3g} off; {answer['tolerance']:.3g} could not be met.")
            (kp.put if self.options.keep_original else kp.replace)(shape, data)

    def fair(self, curve):
        points = kp.points_of(curve)  # straight lines are points that were measured or traced
        request = {
            "curve": {"type": "polyline", "points": points} if points else curve,
            "keep_corners": self.options.keep_corners,
            # cubics are off by a tenth of what the curve may be
            "bezier": {"degree": 3, "tolerance": 0.1 * self.tolerance_of([curve])},
        }
        if points:
            request["closed"] = curve["closed"]
        if self.options.tolerance > 0:
            request["tolerance"] = self.options.tolerance
        return keyline.perform("fair", request)


if __name__ == "__main__":
    Fair().run()

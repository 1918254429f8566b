#!/usr/bin/env python3
"""Keyline > Fair path: each selected path becomes the calmest curve within the tolerance."""

import keyline_paths as kp


class Fair(kp.Extension):
    def add_arguments(self, pars):
        pars.add_argument("--tolerance", type=float, default=0)
        pars.add_argument("--keep_corners", type=kp.inkex.Boolean, default=True)
        pars.add_argument("--keep_original", type=kp.inkex.Boolean, default=False)

    def effect(self):
        for shape in self.paths():
            data = kp.Path()
            for curve in kp.curves_of(shape):
                answer = self.fair(shape, curve)
                data += kp.as_path(answer["bezier"])
                if kp.points_of(curve):  # some may have been taken for strays
                    self.msg(f"{shape.get_id()}: {'; '.join(answer['report'])}.")
                if not answer["within_tolerance"]:
                    name, worst = shape.get_id(), answer["deviation"]["max"]
                    self.msg(f"{name}: up to {worst:.3g} off; {answer['tolerance']:.3g} could not be met.")
            (kp.put if self.options.keep_original else kp.replace)(shape, data)

    def fair(self, shape, curve):
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
        return self.perform(shape, "fair", request)


if __name__ == "__main__":
    Fair().run()

#!/usr/bin/env python3
"""Keyline > Blend: a log-aesthetic curve from the end of one path into the start of the next."""

import keyline_paths as kp
from keyline_paths import keyline


class Blend(kp.Extension):
    def add_arguments(self, pars):
        pars.add_argument("--order", default="G2")
        pars.add_argument("--alpha", type=float, default=-1)
        pars.add_argument("--tolerance", type=float, default=0)

    def work(self):
        shapes = self.paths(2)[:2]
        curves = [next(kp.curves_of(shape)) for shape in shapes]
        answer = keyline.perform(
            "lac.blend",
            {
                "curves": curves,
                "order": self.options.order,
                "alpha": self.options.alpha,
                "bezier": {"degree": 3, "tolerance": self.tolerance_of(curves)},
            },
        )
        kp.put(shapes[0], kp.as_path(answer["bezier"]))


if __name__ == "__main__":
    Blend().run()

#!/usr/bin/env python3
"""Keyline > Blend: a log-aesthetic curve from the end of one path into the start of the next."""

import keyline_paths as kp


class Blend(kp.Extension):
    def add_arguments(self, pars):
        pars.add_argument("--order", default="G2")
        pars.add_argument("--alpha", type=float, default=-1)
        pars.add_argument("--tolerance", type=float, default=0)

    def effect(self):
        shapes = self.paths()
        if len(shapes) != 2:
            raise kp.inkex.AbortExtension(f"Select two paths: the selection holds {len(shapes)}.")
        curves = [list(kp.curves_of(shapes[0]))[-1], next(kp.curves_of(shapes[1]))]
        for shape, curve in zip(shapes, curves):
            if curve["closed"]:
                raise kp.inkex.AbortExtension(f"{shape.get_id()} is closed: it has no end to join.")
        answer = self.perform(
            shapes[0],
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

#!/usr/bin/env python3
"""Keyline > Log-aesthetic from three nodes: the first three nodes of a path are handles."""

import keyline_paths as kp


class Segment(kp.Extension):
    def add_arguments(self, pars):
        pars.add_argument("--alpha", type=float, default=-1)
        pars.add_argument("--tolerance", type=float, default=0)

    def effect(self):
        for shape in self.paths():
            nodes = [n[1] for sub in kp.CubicSuperPath(shape.path.transform(shape.composed_transform())) for n in sub]
            if len(nodes) < 3:
                raise kp.inkex.AbortExtension("The path needs three nodes: an end, a handle, the other end.")
            handles = [list(node) for node in nodes[:3]]
            tolerance = self.tolerance_of([{"type": "polyline", "points": handles}])
            answer = self.perform(
                shape,
                "lac.segment",
                {
                    "points": handles,
                    "alpha": self.options.alpha,
                    "bezier": {"degree": 3, "tolerance": tolerance},
                },
            )
            kp.put(shape, kp.as_path(answer["bezier"]))


if __name__ == "__main__":
    Segment().run()

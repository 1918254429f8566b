#pragma once

#include "keyline/sketch/dash_row.h"
#include "keyline/sketch/thinning.h"

namespace keyline::sketch {

/// One step of plain erosion (ink with paper beside or above or below it goes) or dilation.
void erode(Binary& ink);
void dilate(Binary& ink);

/// Plain smoothing, [Sketch] Fig. 6b, what the feature-based kind is compared with: `times`
/// erosions, twice as many dilations, and as many erosions again. Corners are rounded by it and
/// lines thinner than twice `times` are lost.
void smooth_pixels(Binary& ink, int times);

/// Feature-based erosion and dilation, `times` of each in turn: only features that stand out of an
/// edge by a pixel (bumps on a flat base) or lie in it (dents), and single pixels, are taken away
/// or filled. Flat, sloping and rounded edges, right-angled corners, ends and connections of thin
/// lines stay where they are.
struct Smoothed {
  long changed = 0;  ///< pixels
  InkPieces lost;    ///< pieces of a few pixels of which nothing was left
};
Smoothed smooth_edges(Binary& ink, int times);

/// Pieces of ink (8-connected) of fewer than `specks` pixels become paper, holes (4-connected) of
/// fewer than `pinholes` pixels ink. Where more than half of the ink lies in pieces between that
/// size and half of it they are what was drawn (fine dashes), and only smaller ones go; dashes of a
/// row (dash_row.h) stay in any case. Returns the pieces and how many holes went.
struct Removed {
  InkPieces specks;
  int pinholes = 0;
};
Removed remove_specks(Binary& ink, int specks, int pinholes);

/// All pieces of ink (8-connected); the picture is empty then.
InkPieces take_pieces(Binary& ink);

}  // namespace keyline::sketch

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bounding_box.h"
#include "keyline/document/planar_curve.h"
#include "keyline/document/space_curve.h"
#include "keyline/surface/surface.h"

namespace keyline::document {

/// What every thing in a document carries beside its geometry; each may be empty.
struct Label {
  std::string name;
  std::string layer;
  std::string color;  ///< "#rrggbb"
  friend bool operator==(const Label&, const Label&) = default;
};

struct NamedPath {
  Label label;
  Path path;
  double stroke_width = 0;  ///< in the document's unit; 0: none given
};

struct NamedSpaceCurve {
  Label label;
  SpaceCurve curve;
  bool half_breadth = false;  ///< of a hull: y counts from its centre plane and is never negative
};

struct NamedSurface {
  Label label;
  surface::Surface surface;
  int trims = 0;  ///< edges that cut a face out of it in the file; the surface here is whole
  /// Where there are any: the whole border of the face, loop by loop, curves end to end.
  std::vector<std::vector<SpaceCurve>> trim_loops = {};
};

/// What a file holds once transforms are applied: things with their place, in one unit.
struct Document {
  std::string unit;  ///< "mm", "cm", "m", "in", "ft", "pt", "px" or empty where none is given
  std::vector<NamedPath> paths;
  std::vector<NamedSpaceCurve> space_curves;
  std::vector<NamedSurface> surfaces;
  std::optional<curve::Box2> page;   ///< what a drawing shows; empty: tight around the curves
  std::vector<std::string> skipped;  ///< what was in the file and is not here, in words
};

/// Number of things of all kinds.
std::size_t size(const Document& document);

/// Their labels: paths, space curves, surfaces; the order that indices count in.
std::vector<Label> labels(const Document& document);

/// Keeps what `wanted` means and drops the rest: all things of that name; if there are none, all of
/// that layer; if none, all parts of what has that name ("hood/face-3", "roof#2"); if none, the
/// thing of that index, counted from 1. An empty `wanted` keeps all.
/// Fails: bad_input where it means nothing here, with the names there are as a hint.
core::Result<void> select(Document& document, const std::string& wanted);

/// The curves of all trim loops as curves of the document too, "name/trim-1" … of their surface.
void add_trim_curves(Document& document);

/// Length of the unit in millimetres; 0 for an unknown one. px counts 96 to the inch.
double millimetres(const std::string& unit);

}  // namespace keyline::document

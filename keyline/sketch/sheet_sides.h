#pragma once

#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/image.h"

namespace keyline::sketch {

/// Straight border of something light: points p with dot(normal, p) = offset; the normal (unit)
/// points to the light side.
struct Side {
  core::Vector2 normal;
  double offset = 0;
};

/// Where two sides meet. Precondition: they are not parallel.
core::Point2 meeting(const Side& a, const Side& b);

/// A reduced photo without its thin lines, as logarithms, and the borders in it.
class Borders {
 public:
  /// Precondition: a picture of some hundred pixels across.
  explicit Borders(Raster<float> level);

  /// The straight ones that most of the picture's border pixels lie on, strongest first.
  std::vector<Side> sides() const;

  /// True where beside p a border pixel of that side lies.
  bool supports(const Side& side, core::Point2 p) const;

  const Raster<float>& level() const { return level_; }

 private:
  struct Pixel {
    core::Point2 place;     ///< of its middle
    core::Vector2 towards;  ///< the light, unit
  };
  class Votes;

  void find_pixels();
  Side fitted(const Side& side) const;

  Raster<float> level_;
  std::vector<Pixel> pixels_;
  Raster<int> index_;  ///< of the pixel there in `pixels_`; -1: none
};

}  // namespace keyline::sketch

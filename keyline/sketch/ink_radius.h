#pragma once

#include <utility>
#include <vector>

#include "keyline/sketch/thinning.h"

namespace keyline::sketch {

/// Half the ink's width at the pixels of its lines.
class InkRadius {
 public:
  /// Cost: linear; beside what it keeps (a few bytes a pixel of line) a band of some hundred rows
  /// at a time, so that large pictures fit.
  InkRadius(const Binary& lines, const Binary& ink);

  /// At a pixel of the lines, in pixels: how far its centre lies from the ink's border, 0.5 at
  /// least. Precondition: (x, y) is one.
  float at(int x, int y) const;

 private:
  /// Rows [first, last) from the pixels of paper around each; false where ink is broader than a
  /// search is worth.
  bool add_near(const Binary& lines, const Binary& ink, int first, int last);

  /// Rows [first, last) from distances measured `margin` rows farther; false where ink is broader.
  bool add_rows(const Binary& lines, const Binary& ink, int first, int last, int margin);

  std::vector<std::vector<std::pair<int, float>>> rows_;  ///< by row: column and radius, in order
};

}  // namespace keyline::sketch

#pragma once

#include <string>

#include "keyline/figure/drawing.h"

namespace keyline::figure::detail {

/// What a kind of file has to be able to paint; the walk over the display list is shared.
class Painter {
 public:
  virtual ~Painter() = default;
  virtual void begin_group(const Group& group) = 0;
  virtual void end_group(const Group& group) = 0;
  virtual void shape(const Shape& shape) = 0;
  virtual void label(const Label& label) = 0;
  virtual void dots(const Marks& marks) = 0;
  virtual void picture(const Picture& picture) = 0;
};

/// Paints all items in order. Painters get finite coordinates within ±1e6 units, valid pictures
/// and clean text only; markers other than dots arrive as shapes.
void paint(const Drawing& drawing, Painter& painter);

/// How far below label.at the letters stand.
inline double baseline_drop(const Label& label) {
  if (label.baseline == Baseline::middle) return 0.36 * label.size;
  return label.baseline == Baseline::top ? 0.76 * label.size : 0;
}

/// px per unit of the drawing.
inline double px_per_unit(PageUnit unit) { return unit == PageUnit::mm ? 96 / 25.4 : 1; }

}  // namespace keyline::figure::detail

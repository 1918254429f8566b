#include "keyline/curve/piecewise_bezier.h"

#include <algorithm>

#include "keyline/curve/shares.h"

namespace keyline::curve {

namespace {

Share locate(const PiecewiseBezier& c, double t) {
  if (c.pieces.empty()) throw core::InvalidInput("PiecewiseBezier: no piece");
  return share_of(c.pieces.size(), t);
}

}  // namespace

core::Point2 evaluate(const PiecewiseBezier& c, double t) {
  const Share at = locate(c, t);
  return evaluate(c.pieces[at.index], at.t);
}

Jet2 jet(const PiecewiseBezier& c, double t) {
  const Share at = locate(c, t);
  return rescaled(jet(c.pieces[at.index], at.t), static_cast<double>(c.pieces.size()));
}

std::vector<double> breakpoints(const PiecewiseBezier& c) {
  if (c.pieces.empty()) throw core::InvalidInput("PiecewiseBezier: no piece");
  std::vector<double> t(c.pieces.size() + 1);
  for (std::size_t i = 0; i < t.size(); ++i)
    t[i] = static_cast<double>(i) / static_cast<double>(c.pieces.size());
  return t;
}

PiecewiseBezier reverse(const PiecewiseBezier& c) {
  PiecewiseBezier r = c;
  std::reverse(r.pieces.begin(), r.pieces.end());
  for (Bezier2& piece : r.pieces) piece = reverse(piece);
  return r;
}

PiecewiseBezier transform(const PiecewiseBezier& c, const core::Similarity2& map) {
  PiecewiseBezier moved = c;
  for (Bezier2& piece : moved.pieces) piece = transform(piece, map);
  moved.deviation *= map.scale;
  return moved;
}

}  // namespace keyline::curve

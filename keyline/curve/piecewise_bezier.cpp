#include "keyline/curve/piecewise_bezier.h"

#include <algorithm>

namespace keyline::curve {

namespace {

struct Place {
  std::size_t piece;
  double t;
};

/// Piece and parameter in it; a breakpoint belongs to the piece that starts there.
Place locate(const PiecewiseBezier& c, double t) {
  if (c.pieces.empty()) throw core::InvalidInput("PiecewiseBezier: no piece");
  const double n = static_cast<double>(c.pieces.size());
  t = t >= 0 ? std::min(t, 1.0) : 0.0;  // 0 for NaN, too
  auto i = std::min(static_cast<std::size_t>(t * n), c.pieces.size() - 1);
  if (i + 1 < c.pieces.size() && static_cast<double>(i + 1) / n <= t) ++i;
  if (i > 0 && t < static_cast<double>(i) / n) --i;
  return {i, std::clamp(t * n - static_cast<double>(i), 0.0, 1.0)};
}

}  // namespace

core::Point2 evaluate(const PiecewiseBezier& c, double t) {
  const Place at = locate(c, t);
  return evaluate(c.pieces[at.piece], at.t);
}

Jet2 jet(const PiecewiseBezier& c, double t) {
  const Place at = locate(c, t);
  return rescaled(jet(c.pieces[at.piece], at.t), static_cast<double>(c.pieces.size()));
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

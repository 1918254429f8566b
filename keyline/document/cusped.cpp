#include "keyline/operations/cusped.h"

#include <cmath>
#include <limits>

namespace keyline::operations {

std::vector<Cusp> cusps_of(const document::Path& path) {
  std::vector<Cusp> cusps;
  const auto count = static_cast<double>(path.curves.size());
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    const auto* chain = std::get_if<lac::Chain>(&path.curves[i].value);
    if (!chain) continue;
    const double whole = lac::arc_length(*chain);
    double before = 0;
    for (const lac::Piece& piece : chain->pieces) {
      const auto meet = [&](double curvature, double at) {
        if (std::isinf(curvature))
          cusps.push_back(
              {(static_cast<double>(i) + at / whole) / count, curvature > 0 ? 1. : -1.});
      };
      meet(piece.curvature_start, before);
      before += piece.length;
      meet(piece.curvature_end, before);
    }
  }
  return cusps;
}

curve::Jet2 jet(const CuspedPath& c, double t) {
  constexpr double kSame = 1e-15;
  curve::Jet2 j = jet(c.placed(), t);
  for (const Cusp& cusp : c.cusps()) {
    if (!(std::abs(t - cusp.t) <= kSame)) continue;
    const auto endless = [&](double x) {
      return x == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), x * cusp.sign);
    };
    const core::Vector2 normal = core::perpendicular_left(j.first);
    j.second = {endless(normal.x), endless(normal.y)};
  }
  return j;
}

}  // namespace keyline::operations

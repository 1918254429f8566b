#include "keyline/lac/segment/lambda.h"

#include <cmath>

namespace keyline::lac {

double lambda_of(const Piece& p) {
  if (p.curvature_start == p.curvature_end) return 0;
  const double k0 = std::abs(p.curvature_start);
  const double k1 = std::abs(p.curvature_end);
  const bool first = (p.alpha <= 1) == (k0 >= k1);
  // Of the piece whose curvature there is 1: lambda is the same at every size, squares of curvature
  // are not.
  const double k = first ? k0 : k1;
  const Piece unit{p.alpha, k * p.length, p.curvature_start / k, p.curvature_end / k};
  return std::abs(curvature_rate(unit, first ? 0 : 1));
}

}  // namespace keyline::lac

#include "keyline/lac/segment/lambda.h"

#include <cmath>

namespace keyline::lac {

double lambda_of(const Piece& p) {
  if (p.curvature_start == p.curvature_end) return 0;
  // Of a piece of length 1: it is the same at every size, squares of curvature are not.
  const Piece unit{p.alpha, 1, p.length * p.curvature_start, p.length * p.curvature_end};
  const double k0 = std::abs(unit.curvature_start);
  const double k1 = std::abs(unit.curvature_end);
  const bool first = (p.alpha <= 1) == (k0 >= k1);
  const double k = first ? k0 : k1;
  return std::abs(curvature_rate(unit, first ? 0 : 1)) / k / k;
}

}  // namespace keyline::lac

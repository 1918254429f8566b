#include "keyline/lac/segment/lambda.h"

#include <cmath>

namespace keyline::lac {

double lambda_of(const Piece& p) {
  if (p.curvature_start == p.curvature_end) return 0;
  const double k0 = std::abs(p.curvature_start);
  const double k1 = std::abs(p.curvature_end);
  const bool first = (p.alpha <= 1) == (k0 >= k1);
  const double k = first ? k0 : k1;
  return std::abs(curvature_rate(p, first ? 0 : 1)) / k / k;
}

}  // namespace keyline::lac

#include "keyline/numeric/monotone_cubic.h"

#include <algorithm>
#include <cstddef>

namespace keyline::numeric {

double monotone_cubic(std::span<const double> x, std::span<const double> y, double t) {
  if (t <= x.front()) return y.front();
  if (t >= x.back()) return y.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), t) - x.begin()) - 1;
  const auto secant = [&](std::size_t k) { return (y[k + 1] - y[k]) / (x[k + 1] - x[k]); };
  const auto slope = [&](std::size_t k) {
    if (k == 0) return secant(0);
    if (k + 1 == x.size()) return secant(k - 1);
    const double left = secant(k - 1);
    const double right = secant(k);
    return left * right <= 0 ? 0 : 2 * left * right / (left + right);
  };
  const double h = x[i + 1] - x[i];
  const double u = (t - x[i]) / h;
  const double m0 = slope(i) * h;
  const double m1 = slope(i + 1) * h;
  const double rise = y[i + 1] - y[i];
  return y[i] + u * (m0 + u * ((3 * rise - 2 * m0 - m1) + u * (m0 + m1 - 2 * rise)));
}

}  // namespace keyline::numeric

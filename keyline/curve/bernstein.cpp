#include "keyline/curve/bernstein.h"

namespace keyline::curve::detail {

Halves halves(Coefficients<double> b) {
  const std::size_t n = b.size() - 1;
  Halves h{Coefficients<double>(n + 1), Coefficients<double>(n + 1)};
  for (std::size_t level = 0; level <= n; ++level) {
    h.left[level] = b[0];
    h.right[n - level] = b[n - level];
    for (std::size_t i = 0; i + level < n; ++i) b[i] = 0.5 * (b[i] + b[i + 1]);
  }
  return h;
}

double value_at(Coefficients<double> b, double t) {
  for (std::size_t count = b.size(); count > 1; --count)
    for (std::size_t i = 0; i + 1 < count; ++i) b[i] = (1 - t) * b[i] + t * b[i + 1];
  return b[0];
}

namespace {

int sign_changes(const Coefficients<double>& b) {
  int changes = 0;
  double last = 0;
  for (const double x : b) {
    if (x == 0) continue;
    if (last != 0 && (x > 0) != (last > 0)) ++changes;
    last = x;
  }
  return changes;
}

/// The one sign change of b, by bisection ending in the Illinois variant of regula falsi.
double single_root(const Coefficients<double>& b) {
  double low = 0;
  double high = 1;
  double f_low = b.front();
  double f_high = b.back();
  if (f_low == 0 || f_high == 0) {  // the first coefficient that counts gives the sign
    for (const double x : b)
      if (f_low == 0) f_low = x;
    f_high = -f_low;
  }
  int side = 0;
  for (int step = 0; step < 100 && high - low > 1e-15; ++step) {
    double t = (f_low * high - f_high * low) / (f_low - f_high);
    if (step % 4 == 3 || !(t > low && t < high)) t = 0.5 * (low + high);
    const double f = value_at(b, t);
    if (f == 0) return t;
    if ((f > 0) == (f_low > 0)) {
      low = t;
      f_low = f;
      if (side == -1) f_high *= 0.5;
      side = -1;
    } else {
      high = t;
      f_high = f;
      if (side == 1) f_low *= 0.5;
      side = 1;
    }
  }
  return 0.5 * (low + high);
}

void collect(const Coefficients<double>& b, double low, double width, std::vector<double>& roots) {
  const int changes = sign_changes(b);
  if (changes == 0) return;
  if (changes == 1 || width < 1e-13) {
    roots.push_back(low + width * (changes == 1 ? single_root(b) : 0.5));
    return;
  }
  const Halves h = halves(b);
  collect(h.left, low, 0.5 * width, roots);
  if (h.right.front() == 0 && sign_changes({h.left[h.left.size() - 2], h.right[1]}) == 1)
    roots.push_back(low + 0.5 * width);
  collect(h.right, low + 0.5 * width, 0.5 * width, roots);
}

}  // namespace

std::vector<double> roots_in_unit(const Coefficients<double>& b) {
  std::vector<double> roots;
  if (b.size() > 1) collect(b, 0, 1, roots);
  return roots;
}

}  // namespace keyline::curve::detail

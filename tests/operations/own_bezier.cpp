#include "own_bezier.h"

namespace keyline::own {
namespace {

Four mixed(const Four& a, const Four& b, double t) {
  Four m{};
  for (std::size_t i = 0; i < 4; ++i) m[i] = (1 - t) * a[i] + t * b[i];
  return m;
}

Four homogeneous(const json& point, double weight) {
  const Vec p = vec(point);
  return {weight * p[0], weight * p[1], weight * p[2], weight};
}

/// The blossom of a spline on [knots[k], knots[k + 1]] at as many arguments as its degree.
Four blossom(const Bezier& control, const std::vector<double>& knots, std::size_t k,
             const std::vector<double>& at) {
  const std::size_t p = at.size();
  Bezier d(control.begin() + static_cast<std::ptrdiff_t>(k - p),
           control.begin() + static_cast<std::ptrdiff_t>(k + 1));
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double low = knots[j + k - p], high = knots[j + 1 + k - r];
      d[j] = mixed(d[j - 1], d[j], (at[r - 1] - low) / (high - low));
    }
  return d[p];
}

}  // namespace

Four casteljau(Bezier b, double t) {
  for (std::size_t level = b.size() - 1; level > 0; --level)
    for (std::size_t i = 0; i < level; ++i) b[i] = mixed(b[i], b[i + 1], t);
  return b[0];
}

Bezier derivative(const Bezier& b) {
  if (b.size() < 2) return {Four{}};
  Bezier d;
  for (std::size_t i = 0; i + 1 < b.size(); ++i) {
    Four f{};
    for (std::size_t c = 0; c < 4; ++c)
      f[c] = static_cast<double>(b.size() - 1) * (b[i + 1][c] - b[i][c]);
    d.push_back(f);
  }
  return d;
}

Bezier control_of(const json& points, const json* weights) {
  Bezier all;
  for (std::size_t i = 0; i < points.size(); ++i)
    all.push_back(homogeneous(points[i], weights ? (*weights)[i].get<double>() : 1));
  return all;
}

std::vector<Bezier> cut(const Bezier& control, const std::vector<double>& knots, std::size_t p) {
  std::vector<Bezier> all;
  for (std::size_t k = p; k < control.size(); ++k) {
    if (!(knots[k] < knots[k + 1])) continue;
    Bezier piece;
    for (std::size_t i = 0; i <= p; ++i) {
      std::vector<double> at(p - i, knots[k]);
      at.insert(at.end(), i, knots[k + 1]);
      piece.push_back(blossom(control, knots, k, at));
    }
    all.push_back(std::move(piece));
  }
  return all;
}

}  // namespace keyline::own

#include "keyline/surface/sample_grid.h"

#include "keyline/core/error.h"
#include "keyline/numeric/parallel.h"
#include "keyline/surface/curvature.h"
#include "keyline/surface/tensor.h"

namespace keyline::surface {
namespace {

constexpr int kSecondOrder = 3;  // value, first, second

detail::Basis basis_u(const Surface& s, double t) {
  if (const auto* b = std::get_if<BezierSurface>(&s))
    return detail::bernstein_basis(b->net.rows - 1, t);
  const auto& spline = std::get<BSplineSurface>(s);
  return detail::spline_basis(spline.degree[0], spline.knots[0], t);
}

detail::Basis basis_v(const Surface& s, double t) {
  if (const auto* b = std::get_if<BezierSurface>(&s))
    return detail::bernstein_basis(b->net.columns - 1, t);
  const auto& spline = std::get<BSplineSurface>(s);
  return detail::spline_basis(spline.degree[1], spline.knots[1], t);
}

const std::vector<double>& weights_of(const Surface& s) {
  return std::visit([](const auto& x) -> const std::vector<double>& { return x.weights; }, s);
}

}  // namespace

JetGrid sample_grid(const Surface& s, int rows, int columns, int threads) {
  if (rows < 2 || columns < 2 || rows > kMostGridPoints / columns)
    throw core::InvalidInput("sample_grid: number of rows or columns");
  jet(s, 0, 0);  // throws for a surface whose counts do not agree
  JetGrid grid{rows, columns, {}};
  grid.jets.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  std::vector<detail::Basis> across(columns);
  for (int j = 0; j < columns; ++j) across[j] = basis_v(s, j / (columns - 1.0));
  const detail::NetView net{&net_of(s), &weights_of(s)};
  numeric::parallel_for(static_cast<std::size_t>(rows), threads, [&](std::size_t i) {
    detail::Strip strip;
    const double u = static_cast<double>(i) / (rows - 1);
    detail::contract(net, basis_u(s, u), kSecondOrder, strip);
    for (int j = 0; j < columns; ++j) {
      SurfaceJet& here = grid.jets[i * static_cast<std::size_t>(columns) + j];
      here = detail::combine(strip, across[j], kSecondOrder);
      if (frame_of(here)) continue;
      const core::Point3 point = here.point;
      here = jet_with_normal(s, u, j / (columns - 1.0));
      here.point = point;
    }
  });
  return grid;
}

}  // namespace keyline::surface

#include "keyline/surface/gordon.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "keyline/numeric/monotone_cubic.h"
#include "keyline/surface/curve_net.h"
#include "keyline/surface/interpolate.h"
#include "keyline/surface/tensor.h"

namespace keyline::surface {

using core::ErrorCode;
using core::Point3;
using core::Result;
using core::Vector3;
using detail::CurveNet;
using detail::Thread;

namespace {

using Rows = std::vector<std::vector<Vector3>>;

constexpr int kDegree = 3;
constexpr int kMostSpans = 128;
constexpr int kLooks = 8;  ///< of a span

/// At least `spans` spans from 0 to 1, as even as the places allow, which are among their ends.
std::vector<double> divided(const std::vector<double>& places, int spans) {
  std::vector<double> all;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double width = places[i + 1] - places[i];
    const int parts = std::max(1, static_cast<int>(std::ceil(spans * width - 1e-9)));
    for (int k = 0; k < parts; ++k) all.push_back(places[i] + width * k / parts);
  }
  all.push_back(1);
  return all;
}

/// Places of one thread at shares of the net: its own crossings lie at theirs.
class Warp {
 public:
  Warp(const Thread& thread, const std::vector<double>& net, std::vector<double> own)
      : thread_(thread), net_(net), own_(std::move(own)) {}
  Vector3 at(double share) const {
    return thread_.at(numeric::monotone_cubic(net_, own_, share)) - Point3{};
  }

 private:
  const Thread& thread_;
  const std::vector<double>& net_;
  std::vector<double> own_;
};

std::vector<Warp> warps_of_u(const CurveNet& net) {
  std::vector<Warp> warps;
  for (std::size_t i = 0; i < net.u.size(); ++i) {
    std::vector<double> own;
    for (const auto& c : net.crossings[i]) own.push_back(c.along_u);
    warps.emplace_back(net.u[i], net.u_places, std::move(own));
  }
  return warps;
}

std::vector<Warp> warps_of_v(const CurveNet& net) {
  std::vector<Warp> warps;
  for (std::size_t j = 0; j < net.v.size(); ++j) {
    std::vector<double> own;
    for (const auto& row : net.crossings) own.push_back(row[j].along_v);
    warps.emplace_back(net.v[j], net.v_places, std::move(own));
  }
  return warps;
}

Rows transposed(const Rows& rows) {
  Rows columns(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t j = 0; j < row.size(); ++j) columns[j].push_back(row[j]);
  return columns;
}

/// Values at `wanted`, row by row, of the splines through rows of values at `places`.
Rows across(const std::vector<double>& places, const Rows& values,
            const std::vector<double>& wanted) {
  const int degree = std::min<int>(kDegree, static_cast<int>(places.size()) - 1);
  const auto knots = detail::averaged_knots(places, degree);
  const Rows control = detail::interpolate(places, knots, degree, values);
  Rows all;
  for (const double w : wanted) {
    const detail::Basis b = detail::spline_basis(degree, knots, w);
    all.emplace_back(values.front().size(), Vector3{});
    for (int k = 0; k < b.count; ++k)
      for (std::size_t j = 0; j < all.back().size(); ++j)
        all.back()[j] = all.back()[j] + b.values[0][k] * control[b.first + k][j];
  }
  return all;
}

/// S at all u (rows) and v (columns).
Rows blended(const CurveNet& net, const std::vector<double>& u, const std::vector<double>& v) {
  Rows along_u;  // a row for each curve along u
  for (const Warp& warp : warps_of_u(net)) {
    along_u.emplace_back();
    for (const double share : u) along_u.back().push_back(warp.at(share));
  }
  Rows along_v;
  for (const Warp& warp : warps_of_v(net)) {
    along_v.emplace_back();
    for (const double share : v) along_v.back().push_back(warp.at(share));
  }
  Rows corners;  // a row for each curve along v
  for (std::size_t j = 0; j < net.v.size(); ++j) {
    corners.emplace_back();
    for (const auto& row : net.crossings) corners.back().push_back(row[j].place - Point3{});
  }
  Rows all = transposed(across(net.v_places, along_u, v));
  const Rows other = across(net.u_places, along_v, u);
  const Rows both =
      across(net.u_places, transposed(across(net.v_places, transposed(corners), v)), u);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all[i].size(); ++j)
      all[i][j] = all[i][j] + other[i][j] - both[i][j];
  return all;
}

BSplineSurface spline_through(const Rows& values, const std::vector<double>& u,
                              const std::vector<double>& v) {
  BSplineSurface s{{kDegree, kDegree},
                   {detail::averaged_knots(u, kDegree), detail::averaged_knots(v, kDegree)},
                   {},
                   {}};
  const Rows rows = detail::interpolate(u, s.knots[0], kDegree, values);
  const Rows control = transposed(detail::interpolate(v, s.knots[1], kDegree, transposed(rows)));
  s.net.rows = static_cast<int>(u.size());
  s.net.columns = static_cast<int>(v.size());
  for (const auto& row : control)
    for (const Vector3& p : row) s.net.points.push_back(Point3{} + p);
  return s;
}

/// Largest distance of curves from the surface at their own parameters. `surface_at(i, share)` is
/// the surface where curve i should pass after that share of its parameter.
template <class SurfaceAt>
double largest_miss(const std::vector<Warp>& warps, std::size_t spans,
                    const SurfaceAt& surface_at) {
  double worst = 0;
  const auto looks = static_cast<int>(spans) * kLooks;
  for (std::size_t i = 0; i < warps.size(); ++i)
    for (int k = 0; k <= looks; ++k) {
      const double share = static_cast<double>(k) / looks;
      worst = std::max(worst, norm(surface_at(i, share) - Point3{} - warps[i].at(share)));
    }
  return worst;
}

/// The surface of a net, with as few spans as the tolerance takes.
Result<GordonSurface> surface_of(const CurveNet& net, double tolerance) {
  int spans_u = kDegree;
  int spans_v = kDegree;
  double off = INFINITY;
  while (spans_u <= kMostSpans && spans_v <= kMostSpans) {
    const auto u = divided(net.u_places, spans_u);
    const auto v = divided(net.v_places, spans_v);
    GordonSurface made{spline_through(blended(net, u, v), u, v), 0, net.gap};
    const double off_u = largest_miss(warps_of_u(net), u.size(), [&](std::size_t i, double share) {
      return evaluate(made.surface, share, net.v_places[i]);
    });
    const double off_v = largest_miss(warps_of_v(net), v.size(), [&](std::size_t j, double share) {
      return evaluate(made.surface, net.u_places[j], share);
    });
    made.deviation = off = std::max(off_u, off_v);
    if (off <= std::max(tolerance, net.gap)) return made;
    if (off_u > tolerance) spans_u *= 2;
    if (off_v > tolerance) spans_v *= 2;
  }
  return core::fail(ErrorCode::not_converged,
                    "the curves stay " + std::to_string(off) + " off any smooth surface",
                    "split the network at corners of its curves, or give a larger tolerance");
}

}  // namespace

Result<GordonSurface> gordon_surface(const std::vector<curve::BSpline3>& along_u,
                                     const std::vector<curve::BSpline3>& along_v,
                                     const GordonOptions& options) {
  for (const auto& [curves, name] : {std::pair{&along_u, "along_u"}, {&along_v, "along_v"}})
    if (curves->size() < 2 || curves->size() > 64)
      return core::fail(ErrorCode::bad_input, "a network takes 2 to 64 curves either way",
                        "give its borders at least", name);
  std::optional<Result<GordonSurface>> best;
  for (const auto measure : {detail::Measure::parameter, detail::Measure::length}) {
    const auto net = detail::net_of_curves(along_u, along_v, measure, options.gap);
    if (!net) return std::unexpected(net.error());
    auto made = surface_of(*net, options.tolerance);
    if (!best ||
        (made && (!*best || made->surface.net.points.size() < (*best)->surface.net.points.size())))
      best = std::move(made);
  }
  return *best;
}

}  // namespace keyline::surface

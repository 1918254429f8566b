#include <algorithm>
#include <cmath>

#include "keyline/surface/interpolate.h"
#include "keyline/surface/sweep.h"

namespace keyline::surface {

using core::ErrorCode;
using core::fail;
using core::Result;
using core::Vector3;
using curve::BSpline3;

namespace {

constexpr double kSameKnot = 1e-9;

/// Clamped, over [0, 1].
BSpline3 normalized(const BSpline3& given) {
  BSpline3 c = curve::clamp_ends(given);
  const double low = c.knots.front();
  const double range = c.knots.back() - low;
  for (double& k : c.knots) k = (k - low) / range;
  return c;
}

/// Inner knots of all curves, each as often as the curve that has it most.
std::vector<double> all_inner_knots(const std::vector<BSpline3>& curves) {
  std::vector<double> merged;
  for (const BSpline3& c : curves) {
    std::vector<double> next;
    auto a = merged.begin();
    auto b = c.knots.begin() + c.degree + 1;
    const auto b_end = c.knots.end() - c.degree - 1;
    while (a != merged.end() || b != b_end) {
      if (b == b_end || (a != merged.end() && *a < *b - kSameKnot)) {
        next.push_back(*a++);
      } else if (a == merged.end() || *b < *a - kSameKnot) {
        next.push_back(*b++);
      } else {
        next.push_back(*a++);
        ++b;
      }
    }
    merged = std::move(next);
  }
  return merged;
}

/// The curve with the knots of `merged` it lacks; its own are moved onto them (kSameKnot).
BSpline3 with_knots(BSpline3 c, const std::vector<double>& merged) {
  std::vector<double> missing;
  auto own = c.knots.begin() + c.degree + 1;
  const auto end = c.knots.end() - c.degree - 1;
  for (const double k : merged) {
    if (own != end && std::abs(*own - k) <= kSameKnot)
      *own++ = k;
    else
      missing.push_back(k);
  }
  return missing.empty() ? c : curve::refine_knots(c, missing);
}

Result<std::vector<BSpline3>> made_alike(const std::vector<BSpline3>& sections) {
  std::vector<BSpline3> alike;
  int degree = 1;
  bool rational = false;
  for (const BSpline3& c : sections) {
    degree = std::max(degree, c.degree);
    rational = rational || is_rational(c);
  }
  for (const BSpline3& c : sections) {
    BSpline3 raised = normalized(c);
    if (rational && raised.weights.empty()) raised.weights.assign(raised.control.size(), 1.0);
    if (degree > c.degree) raised = curve::elevate_degree(raised, degree - c.degree);
    alike.push_back(std::move(raised));
  }
  const auto merged = all_inner_knots(alike);
  for (BSpline3& c : alike) c = with_knots(std::move(c), merged);
  for (const BSpline3& c : alike)
    for (std::size_t i = 0; i < c.weights.size(); ++i)
      if (std::abs(c.weights[i] - alike[0].weights[i]) > 1e-12 * alike[0].weights[i])
        return fail(ErrorCode::unsupported, "the sections have different weights",
                    "approximate rational sections by polynomial ones", "sections");
  return alike;
}

/// Parameters of the sections, 0 to 1 by the mean distance of their control points.
std::vector<double> places_of(const std::vector<BSpline3>& sections) {
  std::vector<double> places{0};
  for (std::size_t i = 1; i < sections.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < sections[i].control.size(); ++j)
      sum += core::distance(sections[i - 1].control[j], sections[i].control[j]);
    places.push_back(places.back() + sum);
  }
  const double total = places.back();
  for (double& p : places) p /= total;
  places.back() = 1;
  return places;
}

}  // namespace

Result<BSplineSurface> loft(const std::vector<BSpline3>& sections) {
  if (sections.size() < 2 || sections.size() > 512)
    return fail(ErrorCode::bad_input, "a loft takes 2 to 512 sections", "give at least two",
                "sections");
  const auto alike = made_alike(sections);
  if (!alike) return std::unexpected(alike.error());
  const auto places = places_of(*alike);
  for (std::size_t i = 1; i < places.size(); ++i)
    if (!(places[i] > places[i - 1]))
      return fail(ErrorCode::bad_input, "the section is the one before it over again",
                  "leave one of the two out", "sections[" + std::to_string(i) + "]");
  std::vector<std::vector<Vector3>> rows;
  for (const BSpline3& c : *alike) {
    rows.emplace_back();
    for (const core::Point3& p : c.control) rows.back().push_back(p - core::Point3{});
  }
  const int degree = std::min<int>(3, static_cast<int>(sections.size()) - 1);
  const auto knots = detail::averaged_knots(places, degree);
  const BSpline3& like = alike->front();
  BSplineSurface s{{degree, like.degree}, {knots, like.knots}, {}, {}};
  s.net.rows = static_cast<int>(sections.size());
  s.net.columns = static_cast<int>(like.control.size());
  for (const auto& row : detail::interpolate(places, knots, degree, rows)) {
    for (const Vector3& v : row) s.net.points.push_back(core::Point3{} + v);
    s.weights.insert(s.weights.end(), like.weights.begin(), like.weights.end());
  }
  return s;
}

}  // namespace keyline::surface

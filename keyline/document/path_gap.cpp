#include "keyline/document/path_gap.h"

#include <algorithm>
#include <utility>

#include "keyline/core/text.h"

namespace keyline::document {
namespace {

/// How far the curves reach from their start, at some places of each.
template <class Curve>
double reach_of(const std::vector<Curve>& curves) {
  constexpr int kPlaces = 8;
  const auto start = evaluate(curves.front(), 0);
  double reach = 0;
  for (const Curve& member : curves)
    for (int i = 0; i <= kPlaces; ++i)
      reach = std::max(reach, distance(start, evaluate(member, 1.0 * i / kPlaces)));
  return reach;
}

/// From where files of other formats are off at the most.
constexpr double kShare = 1e-5;

template <class Curve>
std::optional<PathGap> gap_among(const std::vector<Curve>& curves) {
  std::optional<double> reach;  // looked for where ends differ at all
  for (std::size_t i = 1; i < curves.size(); ++i) {
    const double width = distance(evaluate(curves[i - 1], 1), evaluate(curves[i], 0));
    if (width == 0) continue;
    if (!reach) reach = reach_of(curves);
    if (width > kShare * *reach) return PathGap{i, width};
  }
  return {};
}

}  // namespace

std::optional<PathGap> first_gap(const Path& path) { return gap_among(path.curves); }
std::optional<PathGap> first_gap(const std::vector<SpaceCurve>& curves) {
  return gap_among(curves);
}

bool ends_meet(const SpaceCurve& curve) {
  return distance(evaluate(curve, 0), evaluate(curve, 1)) <= kShare * reach_of(std::vector{curve});
}

void close_gaps(Path& path) {
  const double least = kShare * reach_of(path.curves);
  auto* alone =
      path.curves.size() == 1 ? std::get_if<curve::Polyline2>(&path.curves[0].value) : nullptr;
  if (alone) {
    if (path.closed && distance(alone->points.back(), alone->points.front()) > least)
      alone->points.push_back(alone->points.front());
    return;
  }
  std::vector<PlanarCurve> whole;
  const auto bridge = [&](const PlanarCurve& from, const PlanarCurve& to) {
    const core::Point2 end = evaluate(from, 1), start = evaluate(to, 0);
    if (distance(end, start) > least) whole.push_back({curve::Bezier2{{end, start}, {}}});
  };
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    if (i > 0) bridge(path.curves[i - 1], path.curves[i]);
    whole.push_back(path.curves[i]);
  }
  if (path.closed) bridge(path.curves.back(), path.curves.front());
  path.curves = std::move(whole);
}

std::string in_words(const PathGap& gap) {
  return "begins " + core::number_text(gap.width, 3) + " away from where the one before it ends";
}

}  // namespace keyline::document

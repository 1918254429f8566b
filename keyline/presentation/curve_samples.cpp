#include "keyline/presentation/curve_samples.h"

#include <algorithm>
#include <cmath>

#include "keyline/analysis/split.h"

namespace keyline::presentation::detail {
namespace {

using core::Point2;
using figure::SampledCurve;

constexpr int kSamples = 2400;     // of a whole curve
constexpr int kPieceSamples = 32;  // of each piece, at least
constexpr int kSplineSamples = 2001;

void add(SampledCurve& curve, double s, Point2 p, double angle, double curvature) {
  curve.arc_length.push_back(s);
  curve.points.push_back(p);
  curve.tangent_angle.push_back(angle);
  curve.curvature.push_back(curvature);
}

void start_piece(SampledCurve& curve, const std::string& name) {
  curve.piece_names.push_back(name);
  if (!curve.points.empty()) curve.joints.push_back(curve.points.size());
}

void add_segment(SampledCurve& curve, const lac::Segment& segment, double from, double whole,
                 bool with_end) {
  const int n = std::max(kPieceSamples, static_cast<int>(kSamples * segment.length / whole));
  const std::vector<Point2> points = lac::sample(segment, n + 1);
  for (int i = 0; i < n + (with_end ? 1 : 0); ++i) {
    const double t = static_cast<double>(i) / n;
    add(curve, from + t * segment.length, points[static_cast<std::size_t>(i)],
        lac::tangent_angle(segment, t), lac::curvature(segment, t));
  }
}

/// A stretch of a curve by parameter and by arc length.
struct Stretch {
  core::Interval t;
  core::Interval s;
};

/// n >= 2 samples at equal steps of the length, the ends from inside the stretch.
void add_view(SampledCurve& curve, const analysis::CurveView& view,
              const analysis::ArcLengthTable& table, const Stretch& stretch, double from, int n) {
  for (int i = 0; i < n; ++i) {
    const double s = core::at(stretch.s, static_cast<double>(i) / (n - 1));
    const double t = i == 0       ? stretch.t.low
                     : i + 1 == n ? std::nextafter(stretch.t.high, 0.0)
                                  : table.parameter_at(s);
    const curve::Jet2 jet = view.jet_at(t);
    add(curve, from + s, jet.point, curve::tangent_angle(jet), curve::curvature(jet));
  }
}

double length_of(const fairing::FairCurve& member) {
  if (const auto* chain = std::get_if<lac::Chain>(&member)) return lac::arc_length(*chain);
  return curve::arc_length(std::get<curve::BSpline2>(member));
}

double whole_length(const fairing::FairResult& result) {
  double sum = 0;
  for (const auto& member : result.curves) sum += length_of(member);
  return sum;
}

void add_chain(SampledCurve& curve, const lac::Chain& chain, double from, double whole,
               int& number) {
  const std::vector<lac::Segment> segments = lac::segments(chain);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    start_piece(curve, std::to_string(number++));
    add_segment(curve, segments[i], from, whole, i + 1 == segments.size());
    from += segments[i].length;
  }
}

}  // namespace

SampledCurve faired_samples(const fairing::FairResult& result) {
  SampledCurve curve;
  curve.name = "faired curve";
  const double whole = whole_length(result);
  double from = 0;
  int number = 0;
  for (const auto& member : result.curves) {
    const double length = length_of(member);
    if (const auto* chain = std::get_if<lac::Chain>(&member)) {
      add_chain(curve, *chain, from, whole, number);
    } else {
      const auto& spline = std::get<curve::BSpline2>(member);
      const analysis::CurveView view = analysis::view(spline);
      start_piece(curve, "kept");
      const int n = std::max(kPieceSamples, static_cast<int>(kSamples * length / whole));
      add_view(curve, view, analysis::ArcLengthTable(view), {{0, 1}, {0, length}}, from, n + 1);
    }
    from += length;
  }
  return curve;
}

namespace {

/// A closed curve's samples begin anew at the one nearest to `start`.
void rotate_to(SampledCurve& curve, Point2 start) {
  const auto near = std::min_element(
      curve.points.begin(), curve.points.end(),
      [start](Point2 a, Point2 b) { return core::distance(a, start) < core::distance(b, start); });
  const auto base = static_cast<std::ptrdiff_t>(near - curve.points.begin());
  if (base == 0 || base + 1 == static_cast<std::ptrdiff_t>(curve.points.size())) return;
  const auto turn = [base](auto& list) {
    list.pop_back();  // the end is the start
    std::rotate(list.begin(), list.begin() + base, list.end());
    list.push_back(list.front());
  };
  turn(curve.points);
  turn(curve.tangent_angle);
  turn(curve.curvature);
}

}  // namespace

SampledCurve spline_samples(const fairing::FairResult& result) {
  SampledCurve all;
  all.name = "spline through the points";
  double from = 0;
  std::size_t index = 0;
  for (const auto& member : result.curves) {
    const double length = length_of(member);
    const auto* chain = std::get_if<lac::Chain>(&member);
    if (chain && index < result.splines.size()) {
      SampledCurve one;
      const analysis::CurveView view = analysis::view(result.splines[index++]);
      const analysis::ArcLengthTable table(view);
      add_view(one, view, table, {{0, 1}, {0, table.length()}}, 0, kSplineSamples);
      if (chain->closed) rotate_to(one, chain->start.position);
      const double stretch = table.length() > 0 ? length / table.length() : 1;
      for (std::size_t i = 0; i < one.points.size(); ++i)
        add(all, from + stretch * one.arc_length[i], one.points[i], one.tangent_angle[i],
            one.curvature[i]);
      add(all, from + length, {NAN, NAN}, NAN, NAN);  // the line breaks between runs
    }
    from += length;
  }
  return all;
}

analysis::CurvatureProfile profile_between(const SampledCurve& curve, double from, double to) {
  analysis::CurvatureProfile profile;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const double s = curve.arc_length[i];
    if (s < from || s > to || !std::isfinite(curve.curvature[i])) continue;
    profile.arc_length.push_back(s);
    profile.curvature.push_back(curve.curvature[i]);
  }
  return profile;
}

SampledCurve path_samples(const document::Path& path,
                          const std::vector<analysis::MonotonePiece>& pieces) {
  SampledCurve curve;
  curve.name = "curve";
  const analysis::CurveView view = analysis::view(path);
  const analysis::ArcLengthTable table(view);
  int number = 0;
  for (const analysis::MonotonePiece& piece : pieces) {
    const double share = core::length(piece.arc_length) / table.length();
    const int n = std::max(kPieceSamples, static_cast<int>(kSamples * share));
    start_piece(curve, std::to_string(number++));
    add_view(curve, view, table, {piece.t, piece.arc_length}, 0, n + 1);
  }
  return curve;
}

namespace {

Point2 foot_of(Point2 p, double offset, const SampledCurve& curve) {
  Point2 best = p;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const core::Vector2 away = p - curve.points[i];
    const double along = std::abs(away.x) + std::abs(away.y);
    if (along - 1.5 * std::abs(offset) >= 1.5 * least) continue;
    const double angle = curve.tangent_angle[i];
    const Point2 foot = p - offset * core::Vector2{-std::sin(angle), std::cos(angle)};
    const double d = core::distance(foot, curve.points[i]);
    if (d >= least) continue;
    least = d;
    best = foot;
  }
  return best;
}

}  // namespace

figure::Overlay deviations(const std::vector<Point2>& points, const std::vector<double>& offsets,
                           const SampledCurve& curve, std::size_t most) {
  figure::Overlay overlay;
  const std::size_t n = points.size();
  const std::size_t groups = std::min(n, most);
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t end = (g + 1) * n / groups;
    std::size_t worst = g * n / groups;
    for (std::size_t i = worst + 1; i < end; ++i)
      if (!(std::abs(offsets[i]) <= std::abs(offsets[worst])) && !std::isnan(offsets[i])) worst = i;
    if (std::isnan(offsets[worst])) continue;  // outside what was faired
    overlay.points.push_back(points[worst]);
    overlay.feet.push_back(foot_of(points[worst], offsets[worst], curve));
  }
  overlay.curve = curve;
  return overlay;
}

}  // namespace keyline::presentation::detail

#include "keyline/lac/quasi/quasi_hermite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/segment/deviation.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac {

using core::ErrorCode;
using core::Point2;
using core::Result;
using core::Vector2;
using detail::ControlPolygon;
using detail::UnitPiece;

namespace {

/// The two unknowns: ln(rho1 / rho0) and the turning.
struct Unknowns {
  double log_ratio = 0;
  double turning = 0;
};

UnitPiece piece_from(double alpha, const Unknowns& x) {
  const double end = std::exp(-x.log_ratio);
  const double start_curvature = x.turning / numeric::power_mean_integral(1, end, -alpha, 1);
  return detail::unit_piece({alpha, 1, start_curvature, start_curvature * end});
}

/// How far a Bézier misses the wanted turning and chord angle.
struct Miss {
  double turning = 0;
  double chord_angle = 0;
  double size() const { return std::max(std::abs(turning), std::abs(chord_angle)); }
};

bool is_discrete(QuasiForm f) {
  return f == QuasiForm::discrete_angle || f == QuasiForm::discrete_arc;
}

class Hermite {
 public:
  Hermite(const HandleAngles& angles, double alpha, const QuasiOptions& options)
      : turning_(std::abs(angles.turning)),
        chord_angle_(std::abs(angles.chord_angle)),
        alpha_(alpha),
        options_(options) {}

  /// Newton's method with steps halved until they help.
  bool solve(Unknowns& x) {
    std::optional<Miss> miss = at(x);
    if (!miss) return false;
    for (iterations = 0; iterations < 60 && miss->size() > 2e-16 * (1 + turning_); ++iterations) {
      const std::optional<Unknowns> step = newton_step(x, *miss);
      if (!step) return false;
      double factor = 1;
      std::optional<Miss> next;
      for (; factor > 1e-3; factor /= 2) {
        next = at({x.log_ratio + factor * step->log_ratio, x.turning + factor * step->turning});
        if (next && next->size() < miss->size()) break;
      }
      if (!(factor > 1e-3)) break;  // as good as rounding lets it be, or stuck
      x = {x.log_ratio + factor * step->log_ratio, x.turning + factor * step->turning};
      miss = next;
    }
    return miss->size() < kMet;
  }

  /// Every solution found, each once.
  std::vector<Unknowns> scan() { return is_discrete(options_.form) ? polygons() : series(); }

  int iterations = 0;

 private:
  static constexpr std::size_t kTried = 40;
  static constexpr double kMet = 1e-11;         ///< radians
  static constexpr double kMostTurning = 1e30;  ///< of a polygon's piece
  static constexpr double kFarthest = 350;      ///< log of the ratio of polygons' radii

  /// Of a polygon the turning of its edges is in proportion to that of the piece, so only the ratio
  /// of the radii is looked for, by sign: the piece itself may turn many times round within half an
  /// edge.
  std::vector<Unknowns> polygons() const {
    std::vector<Unknowns> found;
    std::optional<Miss> before;
    double last = 0;
    for (double log_ratio = -kFarthest; log_ratio <= kFarthest;
         log_ratio += std::max(1.0, 0.1 * std::abs(log_ratio))) {
      const auto now = at(turning_rightly(log_ratio));
      if (before && now && before->chord_angle * now->chord_angle <= 0) {
        const Unknowns x = between(last, log_ratio, before->chord_angle);
        const auto miss = at(x);
        if (miss && miss->size() < kMet) found.push_back(x);
      }
      before = now;
      last = log_ratio;
    }
    return found;
  }

  /// Where the chord angle is met between two ratios, halved down; `off` is the miss at the first.
  Unknowns between(double low, double high, double off) const {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      const auto miss = at(turning_rightly(middle));
      if (!miss) break;
      (miss->chord_angle * off > 0 ? low : high) = middle;
    }
    return turning_rightly(0.5 * (low + high));
  }

  /// The piece of a ratio whose polygon turns as wanted from its first edge to its last.
  Unknowns turning_rightly(double log_ratio) const {
    const double n = options_.degree;
    if (options_.form == QuasiForm::discrete_angle) return {log_ratio, turning_ * n / (n - 1)};
    const Piece whole = piece_from(alpha_, {log_ratio, 1}).piece;
    return {log_ratio, turning_ / total_turning(part(whole, 0.5 / n, 1 - 0.5 / n))};
  }

  /// The paper's scan for Lambda ([QLAC] §4) in both unknowns, from the places that miss least.
  std::vector<Unknowns> series() {
    struct Place {
      Unknowns x;
      double miss = 0;
    };
    std::vector<Place> places;
    for (double log_ratio = -12; log_ratio <= 12; log_ratio += 0.5)
      for (double log_share = -1.2; log_share <= 0.95; log_share += 0.1) {
        const Unknowns x{log_ratio, turning_ * std::exp(log_share)};
        if (const auto miss = at(x)) places.push_back({x, miss->size()});
      }
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b) { return a.miss < b.miss; });
    if (places.size() > kTried) places.resize(kTried);
    std::vector<Unknowns> found;
    for (const Place& place : places) {
      Unknowns x = place.x;
      if (!solve(x)) continue;
      const bool known = std::any_of(found.begin(), found.end(), [&](const Unknowns& y) {
        return std::abs(y.log_ratio - x.log_ratio) + std::abs(y.turning - x.turning) < 1e-7;
      });
      if (!known) found.push_back(x);
    }
    return found;
  }

  std::optional<Miss> at(const Unknowns& x) const {
    const bool discrete = is_discrete(options_.form);
    if (!(x.turning > 1e-3 * turning_ && x.turning < (discrete ? kMostTurning : 6.2)) ||
        !(std::abs(x.log_ratio) <= kFarthest))
      return std::nullopt;
    const ControlPolygon b = draw_form(piece_from(alpha_, x), options_).polygon;
    const std::size_t n = b.size() - 1;
    const Vector2 first = b[1] - b[0];
    const Vector2 last = b[n] - b[n - 1];
    const double turned = core::angle_between(first, last) - turning_;
    const double chord = core::angle_between(first, b[n] - b[0]) - chord_angle_;
    if (!std::isfinite(turned) || !std::isfinite(chord)) return std::nullopt;
    return Miss{core::wrap_angle(turned), chord};
  }

  /// By central differences of the two angles: the step's accuracy is no matter of the result's.
  std::optional<Unknowns> newton_step(const Unknowns& x, const Miss& miss) const {
    const double h = 1e-5;
    const double k = 1e-5 * x.turning;
    const auto a0 = at({x.log_ratio - h, x.turning});
    const auto a1 = at({x.log_ratio + h, x.turning});
    const auto b0 = at({x.log_ratio, x.turning - k});
    const auto b1 = at({x.log_ratio, x.turning + k});
    if (!a0 || !a1 || !b0 || !b1) return std::nullopt;
    const double tq = (a1->turning - a0->turning) / (2 * h);
    const double cq = (a1->chord_angle - a0->chord_angle) / (2 * h);
    const double tt = (b1->turning - b0->turning) / (2 * k);
    const double ct = (b1->chord_angle - b0->chord_angle) / (2 * k);
    const double determinant = tq * ct - cq * tt;
    if (!(std::abs(determinant) > 0)) return std::nullopt;
    const double dq = -(ct * miss.turning - tt * miss.chord_angle) / determinant;
    const double dt = -(tq * miss.chord_angle - cq * miss.turning) / determinant;
    return Unknowns{std::clamp(dq, -1.5, 1.5), std::clamp(dt, -0.5 * x.turning, 0.5 * x.turning)};
  }

  double turning_, chord_angle_, alpha_;
  QuasiOptions options_;
};

/// Ends and end tangents, off by rounding, put exactly in place.
void settle_ends(curve::Bezier2& c, Point2 p0, Point2 p1, Point2 p2) {
  const std::size_t n = c.control.size() - 1;
  const Vector2 first = (p1 - p0) / distance(p0, p1);
  const Vector2 last = (p2 - p1) / distance(p1, p2);
  c.control[0] = p0;
  c.control[1] = p0 + dot(c.control[1] - p0, first) * first;
  c.control[n] = p2;
  c.control[n - 1] = p2 - dot(p2 - c.control[n - 1], last) * last;
}

/// The polygon laid over the handles.
curve::Bezier2 laid_over(const detail::Drawn& drawn, Point2 p0, Point2 p1, Point2 p2,
                         double mirror) {
  const ControlPolygon& b = drawn.polygon;
  const std::size_t n = b.size() - 1;
  const Vector2 chord = b[n] - b[0];
  const double scale = distance(p0, p2) / norm(chord);
  const double rotation = core::direction_of(p2 - p0) - mirror * core::direction_of(chord);
  curve::Bezier2 c;
  for (const Vector2 v : b)
    c.control.push_back(
        p0 + scale * core::rotate_ccw({v.x - b[0].x, mirror * (v.y - b[0].y)}, rotation));
  c.weights = drawn.weights;
  settle_ends(c, p0, p1, p2);
  return c;
}

/// The forms over three handles.
class OverHandles {
 public:
  OverHandles(const Segment& target, double alpha, const std::array<Point2, 3>& handles)
      : target_(target),
        unit_(detail::unit_piece(piece_of(target))),
        angles_(*handle_angles(handles[0], handles[1], handles[2])),
        alpha_(alpha),
        handles_(handles) {}

  Result<QuasiOptions> settled(const QuasiOptions& options) const {
    return detail::settled(unit_, options);
  }

  /// Of the curves of settled options the closest to the target; nothing where there is none.
  std::optional<QuasiResult> closest(const QuasiOptions& settled) const {
    Unknowns x{numeric::log_ratio(unit_.piece.curvature_end, unit_.piece.curvature_start),
               unit_.turning};
    Hermite hermite(angles_, alpha_, settled);
    if (hermite.solve(x)) {
      QuasiResult r = laid(x, settled);
      r.iterations = hermite.iterations;
      if (holds_tangents(r.curve)) return r;
    }
    std::optional<QuasiResult> closest;
    for (const Unknowns& found : hermite.scan()) {
      QuasiResult r = laid(found, settled);
      if (!holds_tangents(r.curve)) continue;
      if (!closest || r.deviation < closest->deviation) closest = std::move(r);
    }
    return closest;
  }

  /// Of all forms that give up end curvatures.
  std::optional<detail::Approximation> closest_form(int degree) const {
    std::optional<detail::Approximation> all;
    for (const QuasiForm form : {QuasiForm::taylor_angle, QuasiForm::taylor_arc,
                                 QuasiForm::discrete_angle, QuasiForm::discrete_arc}) {
      const auto options = settled({form, degree, {}, false});
      if (!options) continue;
      auto r = closest(*options);
      if (r && !(all && all->deviation <= r->deviation))
        all = {std::move(r->curve), r->deviation, false};
    }
    return all;
  }

 private:
  /// Whether the end edges are long enough for their directions to outlast the coordinates'
  /// rounding.
  bool holds_tangents(const curve::Bezier2& c) const {
    double extent = distance(handles_[0], handles_[2]);
    for (const Point2& p : handles_) extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
    const std::size_t n = c.control.size() - 1;
    const double edge =
        std::min(distance(c.control[0], c.control[1]), distance(c.control[n - 1], c.control[n]));
    return edge > detail::kShortestHandle * extent;
  }

  /// The curve of solved unknowns, with its deviation and nothing else measured.
  QuasiResult laid(const Unknowns& x, const QuasiOptions& settled) const {
    const UnitPiece solved = piece_from(alpha_, x);
    const detail::Drawn drawn = detail::draw_form(solved, settled);
    QuasiResult r;
    r.target = target_;
    r.form = settled.form;
    r.about = settled.about.value_or(0);
    r.lambda = lambda_of(solved.piece);
    r.curve = laid_over(drawn, handles_[0], handles_[1], handles_[2], unit_.mirror);
    const double chord = norm(drawn.polygon.back() - drawn.polygon.front());
    r.series_bound = distance(handles_[0], handles_[2]) / chord * drawn.series_bound;
    r.deviation = deviation_bound(target_, r.curve);
    return r;
  }

  const Segment& target_;
  UnitPiece unit_;
  HandleAngles angles_;
  double alpha_;
  std::array<Point2, 3> handles_;
};

/// Those of the forms that are fitted to the target, whose ends are those of the handles.
Result<QuasiResult> fitted(const OverHandles& forms, const Segment& target,
                           const QuasiOptions& options) {
  if (options.form != QuasiForm::best) return quasi_log_aesthetic(target, options);
  if (auto checked = forms.settled(options); !checked) return std::unexpected(checked.error());
  return detail::best_result(target, options.degree,
                             [&](int degree) { return forms.closest_form(degree); });
}

bool keeps_ends(QuasiForm f) { return f == QuasiForm::rational_cubic || f == QuasiForm::best; }

}  // namespace

Result<QuasiResult> quasi_log_aesthetic(Point2 p0, Point2 p1, Point2 p2, double alpha,
                                        const QuasiOptions& options) {
  const auto solution = solve_g1(p0, p1, p2, alpha);
  if (!solution) return std::unexpected(solution.error());
  if (solution->turning == 0) return quasi_log_aesthetic(solution->segment, options);
  const OverHandles forms(solution->segment, alpha, {p0, p1, p2});
  if (keeps_ends(options.form)) {
    auto result = fitted(forms, solution->segment, options);
    if (result) settle_ends(result->curve, p0, p1, p2);
    return result;
  }
  const auto settled = forms.settled(options);
  if (!settled) return std::unexpected(settled.error());
  auto closest = forms.closest(*settled);
  if (!closest)
    return core::fail(ErrorCode::undrawable,
                      "no Lambda gives a curve of this form and degree with these end tangents "
                      "whose end edges outlast rounding",
                      "raise the degree, or take the form best or rational-cubic");
  detail::measure(*closest);
  return *std::move(closest);
}

}  // namespace keyline::lac

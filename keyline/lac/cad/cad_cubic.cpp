#include "keyline/lac/cad/cad_cubic.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/angle.h"

namespace keyline::lac::detail {

using core::Vector2;

Frame exact_frame(const UnitPiece& unit, double v) {
  return {displacement(unit.piece, v), core::unit_vector(turning(unit.piece, v))};
}

// ---- Table --------------------------------------------------------------------------------

SeriesTable::SeriesTable(const UnitPiece& unit, double allowed) { cut(unit, 0, 1, allowed, 0); }

void SeriesTable::cut(const UnitPiece& unit, double from, double to, double allowed, int depth) {
  const double middle = 0.5 * (from + to);
  TaylorSeries series = taylor_series(unit, SeriesVariable::arc_length, middle, kDegree);
  const double reach = 0.5 * (to - from);
  double remainder = remainder_bound(series, reach);
  if (!(remainder <= allowed)) {
    const double width = to - from;
    const double bend = width > 0.01
                            ? HUGE_VAL
                            : width * std::abs(turning(unit.piece, to) - turning(unit.piece, from));
    if (!(bend <= allowed) && depth < 60) {
      // The remainder falls with the power kDegree + 1 of the width.
      const double wanted =
          std::isfinite(remainder) ? std::pow(remainder / allowed, 1.0 / (kDegree + 1)) : 2.0;
      const int parts = static_cast<int>(std::clamp(std::ceil(wanted), 2.0, 4.0));
      for (int i = 0; i < parts; ++i) {
        const double end = i + 1 == parts ? to : from + (i + 1) * width / parts;
        cut(unit, from + i * width / parts, end, allowed, depth + 1);
      }
      return;
    }
    series.coefficient.fill({});
    series.coefficient[1] = {1, 0};
    remainder = bend;
  }
  add_stretch(unit, {from, to, middle, remainder, 0, kDegree, {}, {}}, series, allowed);
}

/// Takes the series into the frame of its middle and leaves out its terms too small to matter.
void SeriesTable::add_stretch(const UnitPiece& unit, Stretch s, const TaylorSeries& series,
                              double allowed) {
  const Frame frame = exact_frame(unit, s.middle);
  s.curvature = std::max(curvature(unit.piece, s.from), curvature(unit.piece, s.to));
  s.x[0] = frame.point.x;
  s.y[0] = frame.point.y;
  for (int k = 1; k <= kDegree; ++k) {
    const Vector2 c = series.coefficient[k];
    s.x[k] = frame.tangent.x * c.x - frame.tangent.y * c.y;
    s.y[k] = frame.tangent.y * c.x + frame.tangent.x * c.y;
  }
  const double half_width = 0.5 * (s.to - s.from);
  double power = std::pow(half_width, kDegree);
  while (s.degree > 2) {
    const double term = power * std::hypot(s.x[s.degree], s.y[s.degree]);
    if (s.remainder + term > allowed) break;
    s.remainder += term;
    power /= half_width;
    --s.degree;
  }
  stretches_.push_back(s);
}

const SeriesTable::Stretch& SeriesTable::at(double v) const {
  std::size_t i = 0;
  while (i + 1 < stretches_.size() && stretches_[i].to < v) ++i;
  return stretches_[i];
}

Vector2 SeriesTable::point(double v) const {
  const Stretch& s = at(v);
  const double u = v - s.middle;
  double x = s.x[s.degree], y = s.y[s.degree];
  for (int k = s.degree - 1; k >= 0; --k) {
    x = s.x[k] + u * x;
    y = s.y[k] + u * y;
  }
  return {x, y};
}

Vector2 SeriesTable::velocity(double v) const {
  const Stretch& s = at(v);
  const double u = v - s.middle;
  double x = s.degree * s.x[s.degree], y = s.degree * s.y[s.degree];
  for (int k = s.degree - 1; k > 0; --k) {
    x = k * s.x[k] + u * x;
    y = k * s.y[k] + u * y;
  }
  return {x, y};
}

// ---- One cubic ----------------------------------------------------------------------------

namespace {

constexpr double kInner = 0.337;  ///< the error is to vanish here and at the complement
constexpr std::array kTops{0.15, 0.24, 0.5, 0.76, 0.85};

/// Handle lengths (p + d) / 2 and (p - d) / 2, in lengths of the stretch.
///
/// The sum of the normal distances at the inner places is nearly linear in p and decides it well;
/// their difference, with p so chosen, is a smooth function of d alone, flat where the turning is
/// small: a root of that is looked for by secants from a guess, and by a scan where these fail.
class HandleSolve {
 public:
  HandleSolve(const SeriesTable& table, double v0, double v1, const Frame& start, const Frame& end)
      : table_(table), v0_(v0), width_(v1 - v0), start_(start), end_(end) {
    for (int i = 0; i < 2; ++i) {
      const double v = v0 + t_[i] * width_;
      const Vector2 d = table.velocity(v);
      inner_[i] = {table.point(v), d / norm(d)};
      unknown_ += table.remainder(v);
    }
  }

  CubicTry run(const HandleGuess& guess) {
    negligible_ = 1e-3 * guess.fine;
    const double d = solve(std::clamp(guess.tilt, -kMost, kMost), guess.fine);
    CubicTry c = measured(d);
    if (met_ || c.error > guess.hopeful) return c;
    const double scanned = scan(guess.fine);
    odd(scanned);
    return measured(scanned);
  }

 private:
  static constexpr double kMost = 0.4;

  Cubic cubic(double d) const {
    const double a = 0.5 * (p_ + d) * width_;
    const double b = 0.5 * (p_ - d) * width_;
    return {{start_.point, start_.point + a * start_.tangent, end_.point - b * end_.tangent,
             end_.point}};
  }

  /// Difference of the normal distances at the inner places where their sum is 0.
  double odd(double d) {
    // Below it the table does not tell p to a quarter, nor does p matter.
    const double straight = std::max(1e-14 * width_, 4 * unknown_);
    double difference = 0;
    for (int round = 0; round < 6; ++round) {
      const Cubic c = cubic(d);
      double sum = 0, pace = 0;
      difference = 0;
      for (int i = 0; i < 2; ++i) {
        const Frame& f = inner_[i];
        const double t = t_[i] = std::clamp(step_foot(c, f.point, f.tangent, t_[i]), 0.02, 0.98);
        const Vector2 velocity = slope(c, t);
        const double lean = cross(f.tangent, velocity) / dot(velocity, f.tangent);
        const Vector2 across = core::perpendicular_left(f.tangent) - lean * f.tangent;
        const double r = dot(value(c, t) - f.point, across);
        const double s = 1 - t;
        sum += r;
        difference += i == 0 ? r : -r;
        pace += 1.5 * width_ * s * t *
                (s * dot(start_.tangent, across) - t * dot(end_.tangent, across));
      }
      if (!(std::abs(pace) > straight)) break;
      if (std::abs(sum) < negligible_ && round == 0) break;  // nearly so
      const double change = std::clamp(sum / pace, -0.3, 0.3);
      p_ -= change;
      if (std::abs(change) < 1e-3 && round > 0) break;
    }
    return difference;
  }

  /// Of the d that was tried last.
  CubicTry measured(double d) {
    CubicTry c{cubic(d), p_ > 0.3 && p_ < 1.6, d, 0};
    for (const double f : kTops) {
      const Vector2 p = table_.point(v0_ + f * width_);
      const Vector2 tangent = table_.velocity(v0_ + f * width_);
      double t = f + (f < 0.5 ? t_[0] - kInner : t_[1] + kInner - 1);
      t = step_foot(c.cubic, p, tangent, t);
      c.error = std::max(c.error, std::abs(cross(tangent, value(c.cubic, t) - p)));
    }
    if (!std::isfinite(c.error)) c.sound = false;
    return c;
  }

  double solve(double guess, double fine) {
    double d0 = guess, d1 = guess + 0.02;
    double f0 = odd(d0);
    met_ = true;
    if (std::abs(f0) <= fine) return d0;
    double f1 = odd(d1);
    for (int step = 0; step < 5; ++step) {
      if (std::abs(f1) <= fine) return d1;
      const double next = d1 - f1 * (d1 - d0) / (f1 - f0);
      if (!(std::abs(next) < kMost)) break;
      d0 = d1;
      f0 = f1;
      d1 = next;
      f1 = odd(d1);
    }
    met_ = std::abs(f1) <= fine;
    return d1;
  }

  /// The root nearest to 0 among changes of sign, else the least difference.
  double scan(double fine) {
    constexpr int kSteps = 16;
    double best = 0, least = std::numeric_limits<double>::infinity();
    double low = 0, high = 0, nearest = 2 * kMost;
    double before = 0, d_before = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double d = kMost * (2.0 * i / kSteps - 1);
      const double f = odd(d);
      if (std::abs(f) < least) {
        least = std::abs(f);
        best = d;
      }
      const bool change = i > 0 && before * f < 0;
      if (change && std::abs(d + d_before) < nearest) {
        nearest = std::abs(d + d_before);
        low = d_before;
        high = d;
      }
      before = f;
      d_before = d;
    }
    if (!(low < high)) return best;
    const double sign = odd(low) > 0 ? 1 : -1;
    for (int i = 0; i < 30; ++i) {
      best = 0.5 * (low + high);
      const double f = sign * odd(best);
      if (std::abs(f) <= fine) break;
      (f > 0 ? low : high) = best;
    }
    return best;
  }

  const SeriesTable& table_;
  double v0_, width_;
  Frame start_, end_;
  std::array<double, 2> t_{kInner, 1 - kInner};
  std::array<Frame, 2> inner_;
  double p_ = 2.0 / 3;
  double negligible_ = 0;
  double unknown_ = 0;  ///< bound of the error of the inner places together
  bool met_ = false;
};

}  // namespace

CubicTry try_cubic(const SeriesTable& table, double v0, double v1, const Frame& start,
                   const Frame& end, const HandleGuess& guess) {
  return HandleSolve(table, v0, v1, start, end).run(guess);
}

}  // namespace keyline::lac::detail

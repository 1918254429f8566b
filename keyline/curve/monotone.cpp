#include "keyline/curve/monotone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <boost/multiprecision/cpp_int.hpp>

#include "keyline/core/polygon.h"
#include "keyline/curve/arriving.h"
#include "keyline/curve/bezier_ends.h"
#include "keyline/curve/bounded.h"
#include "keyline/curve/curvature_numerator.h"

namespace keyline::curve {

using detail::Bounded;
using detail::Coefficients;
using detail::PlanarForm;
using detail::RateForm;
using detail::Sign;

namespace {

using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                              boost::multiprecision::et_off>;

Sign sign_of(const Integer& a) {
  return a > 0 ? Sign::positive : a < 0 ? Sign::negative : Sign::zero;
}

// ---- The curve in either arithmetic -------------------------------------------------------

/// Power of two that brings the largest of the values near 1.
double unit_scale(const std::vector<double>& values) {
  double size = 0;
  for (const double v : values) size = std::max(size, std::abs(v));
  return size > 0 && std::isfinite(size)
             ? std::ldexp(1.0, -std::clamp(std::ilogb(size), -1000, 1000))
             : 1.0;
}

PlanarForm<Bounded> bounded_form(const Bezier2& c) {
  std::vector<double> x, y, all;
  for (const core::Point2& p : c.control) {
    x.push_back(p.x - c.control.front().x);
    y.push_back(p.y - c.control.front().y);
    all.insert(all.end(), {x.back(), y.back()});
  }
  const double scale = unit_scale(all);
  const double weight_scale = unit_scale(c.weights);
  PlanarForm<Bounded> form;
  const auto lift = [&](double v, std::size_t i) {
    const Bounded b(v * scale, detail::kRounding * std::abs(v * scale));
    return is_rational(c) ? b * Bounded(c.weights[i] * weight_scale) : b;
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    form.x.push_back(lift(x[i], i));
    form.y.push_back(lift(y[i], i));
    if (is_rational(c)) form.w.push_back(Bounded(c.weights[i] * weight_scale));
  }
  return form;
}

/// Integers proportional to the doubles, exactly.
std::vector<Integer> to_integers(const std::vector<double>& values) {
  int lowest = std::numeric_limits<int>::max();
  for (const double v : values)
    if (v != 0) lowest = std::min(lowest, std::ilogb(v) - 52);
  std::vector<Integer> r;
  for (const double v : values) {
    if (v == 0) {
      r.emplace_back(0);
      continue;
    }
    const int exponent = std::ilogb(v) - 52;
    r.push_back(Integer(static_cast<long long>(std::scalbn(v, -exponent))) << (exponent - lowest));
  }
  return r;
}

PlanarForm<Integer> exact_form(const Bezier2& c) {
  std::vector<double> all;
  for (const core::Point2& p : c.control) all.push_back(p.x);
  for (const core::Point2& p : c.control) all.push_back(p.y);
  const auto xy = to_integers(all);
  const auto middle = xy.begin() + static_cast<std::ptrdiff_t>(c.control.size());
  PlanarForm<Integer> form{{xy.begin(), middle}, {middle, xy.end()}, to_integers(c.weights)};
  for (std::size_t i = 0; i < form.w.size(); ++i) {
    form.x[i] *= form.w[i];
    form.y[i] *= form.w[i];
  }
  return form;
}

template <class T>
RateForm<T> plain_rate_form(PlanarForm<T> form) {
  form.x = detail::scaled(form.x);
  form.y = detail::scaled(form.y);
  if (!form.w.empty()) form.w = detail::scaled(form.w);
  return detail::rate_form(form);
}

// ---- Plain coefficients and subdivision ---------------------------------------------------

Coefficients<Bounded> plain(Coefficients<Bounded> a) {
  const auto c = detail::binomials<Bounded>(a.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] / c[i];
  return a;
}

/// Plain up to a common positive factor.
Coefficients<Integer> plain(Coefficients<Integer> a) {
  const auto c = detail::binomials<Integer>(a.size() - 1);
  Integer common = 1;
  for (const Integer& x : c) common = boost::multiprecision::lcm(common, x);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] *= common / c[i];
  return a;
}

template <class T>
struct Halves {
  Coefficients<T> left, right;
};

Halves<Bounded> halve(Coefficients<Bounded> b) {
  const std::size_t n = b.size() - 1;
  Halves<Bounded> h{b, b};
  for (std::size_t level = 0; level <= n; ++level) {
    h.left[level] = b[0];
    h.right[n - level] = b[n - level];
    for (std::size_t i = 0; i + level < n; ++i) b[i] = half_sum(b[i], b[i + 1]);
  }
  return h;
}

/// Both halves up to the same positive factor, 2^degree.
Halves<Integer> halve(Coefficients<Integer> b) {
  const std::size_t n = b.size() - 1;
  Halves<Integer> h{b, b};
  for (std::size_t level = 0; level <= n; ++level) {
    h.left[level] = b[0] << (n - level);
    h.right[n - level] = b[n - level] << (n - level);
    for (std::size_t i = 0; i + level < n; ++i) b[i] += b[i + 1];
  }
  return h;
}

/// Common sign of all coefficients, zeros apart; unknown if they differ or one is unknown.
template <class T>
Sign common_sign(const Coefficients<T>& b) {
  Sign common = Sign::zero;
  for (const T& x : b) {
    const Sign s = sign_of(x);
    if (s == Sign::unknown) return s;
    if (s == Sign::zero) continue;
    if (common != Sign::zero && common != s) return Sign::unknown;
    common = s;
  }
  return common;
}

// ---- Stretches of one sign ----------------------------------------------------------------

struct Stretch {
  double low, high;
  Sign sign;  ///< of dkappa/ds; unknown: could not be decided
};

struct Stretches {
  std::vector<Stretch> list;
  std::optional<double> cusp;
  bool complete = true;  ///< false: the budget of parts ran out
};

template <class T>
class Search {
 public:
  Search(const RateForm<T>& form, int depth, int budget) : depth_(depth), budget_(budget) {
    visit(plain(form.rate), plain(form.speed), 0, 1, 0);
  }
  Stretches take() { return std::move(found_); }

 private:
  void visit(const Coefficients<T>& rate, const Coefficients<T>& speed, double low, double high,
             int depth) {
    if (low > 0 && sign_of(speed.front()) == Sign::zero) found_.cusp = low;
    const Sign sign = moves(speed, low, high) ? common_sign(rate) : Sign::unknown;
    if (sign != Sign::unknown || depth >= depth_ || --budget_ < 0) {
      if (budget_ < 0) found_.complete = false;
      add(low, high, sign);
      return;
    }
    const double middle = 0.5 * (low + high);
    const auto r = halve(rate);
    const auto s = halve(speed);
    visit(r.left, s.left, low, middle, depth + 1);
    visit(r.right, s.right, middle, high, depth + 1);
  }

  /// Whether the speed is certainly not zero between the ends of the curve.
  static bool moves(const Coefficients<T>& speed, double low, double high) {
    return common_sign(speed) == Sign::positive &&
           (low == 0 || sign_of(speed.front()) == Sign::positive) &&
           (high == 1 || sign_of(speed.back()) == Sign::positive);
  }

  void add(double low, double high, Sign sign) {
    if (!found_.list.empty() && found_.list.back().sign == sign)
      found_.list.back().high = high;
    else
      found_.list.push_back({low, high, sign});
  }

  int depth_;
  int budget_;
  Stretches found_;
};

// ---- The verdict --------------------------------------------------------------------------

/// |b - a| as a fraction of the larger of the two or of 1/length.
double relative_change(double a, double b, double length) {
  if (!std::isfinite(a) || !std::isfinite(b)) return a == b ? 0 : 1;
  return std::abs(b - a) / std::max({std::abs(a), std::abs(b), 1 / length});
}

/// What has been seen of a curve so far.
class Tally {
 public:
  void change(Sign sign, double size, double total, double t) {
    Side& side = sign == Sign::positive ? rise_ : fall_;
    side.seen = true;
    side.total += total;
    if (size >= side.largest) {
      side.largest = size;
      side.t = t;
    }
  }
  void doubt(double t) { doubt_ = t; }
  void refute(double t) { refuted_ = t; }

  MonotoneVerdict verdict(double tolerance) const {
    const bool mainly_rising = rise_.seen && (!fall_.seen || rise_.total >= fall_.total);
    const Side& back = mainly_rising ? fall_ : rise_;
    MonotoneVerdict v;
    v.direction = mainly_rising ? 1 : fall_.seen ? -1 : 0;
    v.backward = back.seen && (rise_.seen && fall_.seen) ? back.largest : 0;
    if (refuted_) {
      v.answer = MonotoneVerdict::no;
      v.witness = *refuted_;
    } else if (rise_.seen && fall_.seen) {
      v.answer = v.backward > tolerance ? MonotoneVerdict::no : MonotoneVerdict::undecided;
      v.witness = back.t;
    } else if (doubt_) {
      v.witness = *doubt_;
    } else {
      v.answer = MonotoneVerdict::yes;
    }
    return v;
  }

 private:
  struct Side {
    bool seen = false;
    double total = 0;    ///< sum of the relative changes
    double largest = 0;  ///< of them
    double t = 0;        ///< middle of the stretch with the largest
  };
  Side rise_, fall_;
  std::optional<double> doubt_, refuted_;
};

/// Piece of a longer curve: its parameter range there, and the longer curve's length.
struct Frame {
  double low = 0;
  double high = 1;
  double length = 1;
  double outer(double t) const { return (1 - t) * low + t * high; }
};

void count(const Bezier2& c, const Stretches& s, const Frame& frame, Tally& tally) {
  if (s.cusp) tally.refute(frame.outer(*s.cusp));
  for (const Stretch& part : s.list) {
    const double middle = frame.outer(0.5 * (part.low + part.high));
    if (part.sign == Sign::unknown) tally.doubt(middle);
    if (part.sign == Sign::unknown || part.sign == Sign::zero) continue;
    const double size =
        relative_change(curvature(c, part.low), curvature(c, part.high), frame.length);
    tally.change(part.sign, size, size, middle);
  }
}

bool settled(const MonotoneVerdict& v, const Stretches& s) {
  return v.answer == MonotoneVerdict::no || (v.answer == MonotoneVerdict::yes && s.complete);
}

/// Stretches of one Bézier curve, in doubles if they settle it, else in integers.
Stretches examine(const Bezier2& c, double length, double tolerance) {
  constexpr int kFilterDepth = 20;
  constexpr int kFilterBudget = 500;
  constexpr int kExactDepth = 32;
  constexpr int kExactBudget = 20000;
  auto filtered =
      Search<Bounded>(plain_rate_form(bounded_form(c)), kFilterDepth, kFilterBudget).take();
  Tally tally;
  count(c, filtered, {0, 1, length}, tally);
  if (settled(tally.verdict(tolerance), filtered)) return filtered;
  return Search<Integer>(plain_rate_form(exact_form(c)), kExactDepth, kExactBudget).take();
}

void require_numbers(const Bezier2& c) {
  if (!validate(c)) throw core::InvalidInput("certify_monotone_curvature: invalid curve");
}

/// Curvature jump and corner between two pieces.
void count_joint(const Bezier2& a, const Bezier2& b, double t, double length, double tolerance,
                 Tally& tally) {
  const Jet2 before = jet(a, 1);
  const Jet2 after = jet(b, 0);
  const double allowed = std::max(tolerance, 1e-12);
  if (distance(before.point, after.point) > allowed * length ||
      std::abs(angle_between(arriving_tangent(before), unit_tangent(after))) > allowed) {
    tally.refute(t);
    return;
  }
  const double k0 = curvature(before);
  const double k1 = curvature(after);
  const double size = relative_change(k0, k1, length);
  if (size > allowed) tally.change(k1 > k0 ? Sign::positive : Sign::negative, size, size, t);
}

}  // namespace

MonotoneVerdict certify_monotone_curvature(const Bezier2& c, double tolerance) {
  require_numbers(c);
  const double length = core::polygon_length(c.control);
  if (!(length > 0)) return {};
  Tally tally;
  count(c, examine(c, length, tolerance), {0, 1, length}, tally);
  return tally.verdict(tolerance);
}

MonotoneVerdict certify_monotone_curvature(const BSpline2& c, double tolerance) {
  const auto pieces = to_beziers(c);
  const auto breaks = bezier_ends(c);
  double length = 0;
  for (const Bezier2& piece : pieces) {
    require_numbers(piece);
    length += core::polygon_length(piece.control);
  }
  if (!(length > 0)) return {};
  Tally tally;
  const Bezier2* before = nullptr;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Frame frame{breaks[i], breaks[i + 1], length};
    if (frame.low == frame.high) continue;  // its points are apart by rounding alone
    count(pieces[i], examine(pieces[i], length, tolerance), frame, tally);
    if (before) count_joint(*before, pieces[i], breaks[i], length, tolerance, tally);
    before = &pieces[i];
  }
  return tally.verdict(tolerance);
}

}  // namespace keyline::curve

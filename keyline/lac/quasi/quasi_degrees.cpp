#include <cmath>
#include <limits>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/lac/quasi/quasi_family.h"
#include "keyline/lac/quasi/quasi_forms.h"
#include "keyline/lac/quasi/quasi_hermite.h"
#include "keyline/lac/segment/deviation.h"

namespace keyline::lac::detail {

using core::Point2;
using core::Vector2;

namespace {

/// A polygon of the piece run through from its other end, in a mirror.
ControlPolygon from_other_end(const ControlPolygon& b, const UnitPiece& unit) {
  const Vector2 end = displacement(unit.piece, 1);
  const Vector2 tangent = core::unit_vector(unit.turning);
  ControlPolygon turned;
  for (auto v = b.rbegin(); v != b.rend(); ++v)
    turned.push_back({dot(end - *v, tangent), cross(tangent, *v - end)});
  return turned;
}

/// Least deviation of each degree in turn: each begins, among others, from the last one raised, so
/// that none is worse than a lower one.
class Degrees {
 public:
  Degrees(const Segment& segment, const OtherForms& others)
      : segment_(segment), unit_(unit_piece(piece_of(segment))), others_(others) {}

  /// Its control is empty where there is none.
  Approximation run(int degree) {
    offer(fitted(degree, {}));
    if (nearer_than(kExact)) return nearest_;
    const Approximation quick = std::exchange(nearest_, none());
    for (int d = kLeast; d <= degree && !nearer_than(kExact); ++d) take(d);
    raise_to(degree);
    offer(quick);
    return nearest_;
  }

 private:
  static constexpr int kLeast = 5;
  static constexpr int kLeastOther = 3;    ///< of the other forms
  static constexpr double kExact = 1e-13;  ///< of the length: nothing to gain
  static constexpr double kGood = 1e-9;    ///< other forms are not looked at for less

  static Approximation none() { return {{}, std::numeric_limits<double>::infinity(), false}; }
  bool found() const { return !nearest_.curve.control.empty(); }
  bool nearer_than(double share) const { return nearest_.deviation <= share * unit_.length; }
  void raise_to(int degree) {
    if (found())
      nearest_.curve =
          curve::elevate_degree(nearest_.curve, degree - curve::degree(nearest_.curve));
  }

  /// The nearest of a degree, from that of the one below.
  void take(int degree) {
    raise_to(degree);
    if (degree == kLeast) offer(rational(degree));
    offer(fitted(degree, {.thorough = true, .from = start(nearest_.curve)}));
    if (nearer_than(kGood)) return;
    others_ ? take_over_handles(degree) : take_drawn(degree);
  }

  void take_over_handles(int degree) {
    for (int d = degree == kLeast ? kLeastOther : degree; d <= degree; ++d) {
      auto other = others_(d);
      if (!other) continue;
      other->curve = curve::elevate_degree(other->curve, degree - d);
      offer(fitted(degree, {.from = start(other->curve)}));
      offer(std::move(other));
    }
    // Where no polynomial was found that holds the end curvatures, or one that does not is nearer,
    // they may as well be given up for the best.
    if (found() && nearest_.curvatures_held && nearest_.curve.weights.empty()) return;
    offer(fitted(degree,
                 {.thorough = true, .curvatures_held = false, .from = start(nearest_.curve)}));
  }

  /// The other forms of the piece miss its ends. Where one is nearer than what holds the end
  /// curvatures, it is begun from and these are given up.
  void take_drawn(int degree) {
    for (const QuasiForm form : {QuasiForm::taylor_angle, QuasiForm::taylor_arc,
                                 QuasiForm::discrete_angle, QuasiForm::discrete_arc}) {
      const auto options = settled(unit_, {form, degree, {}, false});
      if (!options) continue;
      const Approximation drawn =
          measured({in_place(segment_, unit_, draw_form(unit_, *options)), 0, false});
      if (!(drawn.deviation < nearest_.deviation)) continue;
      const BestSearch search{
          .thorough = true, .curvatures_held = false, .from = start(drawn.curve)};
      offer(laid(moved_to_ends(unit_, search.from), search));
      offer(fitted(degree, search));
    }
  }

  void offer(std::optional<Approximation> a) {
    if (!a || !std::isfinite(a->deviation)) return;
    if (a->deviation < nearest_.deviation) nearest_ = *std::move(a);
  }

  /// A curve as a polygon of the unit piece; empty for none and for rational ones.
  ControlPolygon start(const curve::Bezier2& c) const {
    ControlPolygon b;
    if (!c.weights.empty()) return b;
    for (const Point2& p : c.control) {
      const Point2 local = to_local(segment_.start, p);
      b.push_back({local.x / unit_.length, unit_.mirror * local.y / unit_.length});
    }
    return b;
  }

  /// Thorough ones from either end: rounding leads one search astray where it does not the other.
  std::optional<Approximation> fitted(int degree, const BestSearch& search) const {
    auto forwards = laid(best_polygon(unit_, degree, search), search);
    if (!search.thorough || (forwards && forwards->deviation <= kGood * unit_.length))
      return forwards;
    BestSearch from_end = search;
    from_end.from = from_other_end(search.from, unit_);
    const UnitPiece back = unit_piece(mirrored(reversed(unit_.piece)));
    auto backwards = laid(from_other_end(best_polygon(back, degree, from_end), back), search);
    if (!forwards || (backwards && backwards->deviation < forwards->deviation)) return backwards;
    return forwards;
  }

  std::optional<Approximation> laid(const ControlPolygon& b, const BestSearch& search) const {
    if (b.empty()) return std::nullopt;
    return measured({in_place(segment_, unit_, {b, {}, 0}), 0, search.curvatures_held});
  }

  std::optional<Approximation> rational(int degree) const {
    if (!check_form(unit_, {QuasiForm::rational_cubic, 3, {}, false})) return std::nullopt;
    RationalCubic cubic = rational_cubic(unit_);
    if (cubic.polygon.empty()) return std::nullopt;
    const curve::Bezier2 c =
        in_place(segment_, unit_, {std::move(cubic.polygon), std::move(cubic.weights), 0});
    return measured({curve::elevate_degree(c, degree - 3), 0, true});
  }

  Approximation measured(Approximation a) const {
    a.deviation = deviation_bound(segment_, a.curve);
    return a;
  }

  const Segment& segment_;
  UnitPiece unit_;
  const OtherForms& others_;
  Approximation nearest_ = none();
};

}  // namespace

Point2 in_place(const Segment& segment, const UnitPiece& unit, Vector2 v) {
  return from_local(segment.start, {unit.length * v.x, unit.length * unit.mirror * v.y});
}

curve::Bezier2 in_place(const Segment& segment, const UnitPiece& unit, const Drawn& drawn) {
  curve::Bezier2 c;
  for (const Vector2 v : drawn.polygon) c.control.push_back(in_place(segment, unit, v));
  c.weights = drawn.weights;
  return c;
}

std::optional<Approximation> best_of_degrees(const Segment& segment, int degree,
                                             const OtherForms& others) {
  Approximation best = Degrees(segment, others).run(degree);
  if (best.curve.control.empty()) return std::nullopt;
  return best;
}

}  // namespace keyline::lac::detail

#include "keyline/lac/quasi/quasi.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/quasi/quasi_forms.h"
#include "keyline/lac/segment/deviation.h"
#include "keyline/lac/segment/taylor.h"

#include "quasi_samples.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Vector2;
using detail::SeriesVariable;

// From the inflection a clothoid is the sum of (-1)^k terms: x = s - s^5/40 + s^9/3456 - ...,
// y = s^3/6 - s^7/336 + s^11/42240 - ... with theta = s^2/2 (Fresnel's series).
TEST(Taylor, ClothoidHasFresnelsCoefficients) {
  const auto unit = detail::unit_piece({-1, 1, 0, 1});
  const auto s = taylor_series(unit, SeriesVariable::arc_length, 0, 12);
  const Vector2 known[] = {{0, 0}, {1, 0},          {0, 0}, {0, 1.0 / 6},
                           {0, 0}, {-1.0 / 40, 0},  {0, 0}, {0, -1.0 / 336},
                           {0, 0}, {1.0 / 3456, 0}, {0, 0}, {0, 1.0 / 42240},
                           {0, 0}};
  for (int k = 0; k <= 12; ++k) {
    EXPECT_NEAR(s.coefficient[k].x, known[k].x, 1e-17) << k;
    EXPECT_NEAR(s.coefficient[k].y, known[k].y, 1e-17) << k;
  }
}

// The involute of a circle: rho = 1 + theta, P' = (1 + theta) e^{i theta}, coefficients of P by
// hand: (i^k / k! + i^{k-1} / (k-1)!) / (k + 1).
TEST(Taylor, InvoluteInAngleHasItsOwnCoefficients) {
  const Piece involute{2, 1.5, 1, 0.5};  // rho from 1 to 2 over one radian
  const auto unit = detail::unit_piece(involute);
  const auto s = taylor_series(unit, SeriesVariable::tangent_angle, 0, 9);
  const Vector2 powers[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  double factorial = 1;
  for (int k = 0; k < 9; ++k) {
    const Vector2 now = powers[k % 4] / factorial;
    const Vector2 before = k == 0 ? Vector2{} : powers[(k - 1) % 4] * (k / factorial);
    const Vector2 expected = (now + before) / (k + 1) / 1.5;
    EXPECT_NEAR(s.coefficient[k + 1].x, expected.x, 1e-15) << k;
    EXPECT_NEAR(s.coefficient[k + 1].y, expected.y, 1e-15) << k;
    factorial *= k + 1;
  }
}

TEST(Taylor, SumsToTheCurveWithinTheRemainder) {
  EXPECT_TRUE(rc::check([] {
    const double alpha = *rc::gen::inRange(-300, 301) / 100.0;
    const double q = *rc::gen::inRange(-150, 151) / 100.0;
    const double about = *rc::gen::inRange(0, 101) / 100.0;
    const int degree = *rc::gen::inRange(2, 31);
    const auto unit = detail::unit_piece({alpha, 2, 0.5, 0.5 * std::exp(q)});
    for (const auto variable : {SeriesVariable::tangent_angle, SeriesVariable::arc_length}) {
      const auto s = taylor_series(unit, variable, about, degree);
      RC_ASSERT(s.analytic);
      for (const double x : {-0.1, 0.05, 0.2}) {
        const double u = about + x;
        if (u < 0 || u > 1) continue;
        const double arc =
            variable == SeriesVariable::arc_length ? u : fraction_at_turning(unit.piece, u);
        const Vector2 got = displacement(unit.piece, s.arc) +
                            core::rotate_ccw(sum(s, x), turning(unit.piece, s.arc));
        const double error = norm(got - displacement(unit.piece, arc));
        RC_ASSERT(error <= remainder_bound(s, std::abs(x)) + 2e-14);
      }
    }
  }));
}

// The polynomial itself (Horner's rule in long double) against de Casteljau on the converted form.
TEST(Taylor, ConversionLosesNothingAtDegree30) {
  double worst = 0;
  for (const double alpha : {-1.0, -0.5, 0.0, 1.0, 2.0, 3.0})
    for (const double about : {0.0, 0.2, 0.5, 1.0})
      for (const auto variable : {SeriesVariable::tangent_angle, SeriesVariable::arc_length}) {
        const auto unit = detail::unit_piece({alpha, 1, 1.2, 0.7});
        const auto s = taylor_series(unit, variable, about, 30);
        curve::Bezier2 b;
        for (const Vector2 v : taylor_polygon(unit, s)) b.control.push_back({v.x, v.y});
        const Vector2 origin = displacement(unit.piece, s.arc);
        const double direction = turning(unit.piece, s.arc);
        for (int i = 0; i <= 50; ++i) {
          const double t = i / 50.0;
          long double x = 0, y = 0;
          double size = 0;
          for (int k = 30; k > 0; --k) {
            x = (x + s.coefficient[k].x) * (static_cast<long double>(t) - about);
            y = (y + s.coefficient[k].y) * (static_cast<long double>(t) - about);
            size = (size + norm(s.coefficient[k])) * std::max(about, 1 - about);
          }
          const Vector2 v =
              origin +
              core::rotate_ccw({static_cast<double>(x), static_cast<double>(y)}, direction);
          worst = std::max(worst, distance(evaluate(b, t), {v.x, v.y}) / (1 + size));
        }
      }
  EXPECT_LT(worst, 2e-15);
}

TEST(Quasi, StandardSegmentPassesTheOrigin) {
  for (const double alpha : {-1.0, 0.0, 0.7, 1.0, 2.0, 4.0}) {
    SCOPED_TRACE(alpha);
    const auto s = standard_segment(alpha, 0.3, {-0.4, 0.8});
    ASSERT_TRUE(s);
    const double t = fraction_at_turning(piece_of(*s), 1.0 / 3);
    EXPECT_LT(distance(evaluate(*s, t), {0, 0}), 1e-15);
    EXPECT_NEAR(tangent_angle(*s, t), 0, 1e-15);
    EXPECT_NEAR(curvature(*s, t), 1, 1e-14);
    EXPECT_NEAR(total_turning(*s), 1.2, 1e-14);
    // Standard form: Lambda = drho/ds at the reference point.
    EXPECT_NEAR(-curvature_rate(*s, t), 0.3, 1e-13);
    const auto later = standard_segment(alpha, 0.3, {0.2, 0.8});
    ASSERT_TRUE(later);
    EXPECT_LT(distance(evaluate(*later, 0), evaluate(*s, fraction_at_turning(piece_of(*s), 0.5))),
              1e-15);
  }
  EXPECT_EQ(standard_segment(-1, 0.5, {0, 1.1}).error().code, ErrorCode::bad_input);
  EXPECT_EQ(standard_segment(-1, 0.5, {1, 0}).error().code, ErrorCode::bad_input);
  EXPECT_EQ(standard_segment(NAN, 0.5, {0, 1}).error().code, ErrorCode::bad_input);
}

TEST(Quasi, AllFormsConvergeWithDegree) {
  for (const double alpha : {-1.0, 0.0, 1.0, 2.0})
    for (const QuasiForm form : kForms) {
      if (form == QuasiForm::rational_cubic) continue;
      SCOPED_TRACE(alpha);
      double before = std::numeric_limits<double>::infinity();
      for (const int degree : {6, 10, 20, 30}) {
        const auto r = quasi_log_aesthetic(alpha, 0.5, {0, 0.8}, {form, degree, {}, false});
        ASSERT_TRUE(r);
        EXPECT_TRUE(r->deviation < before || r->deviation < 1e-10);
        before = r->deviation;
      }
      EXPECT_LT(before, form == QuasiForm::taylor_angle || form == QuasiForm::taylor_arc ||
                                form == QuasiForm::best
                            ? 2e-4
                            : 2e-2);
    }
}

TEST(Quasi, DeviationBoundIsNeverBelowSamples) {
  EXPECT_TRUE(rc::check([] {
    const double alpha = *rc::gen::inRange(-400, 401) / 100.0;
    const double turning = *rc::gen::inRange(20, 200) / 100.0;
    const double share = *rc::gen::inRange(46, 55) / 100.0;
    const QuasiForm form = kForms[*rc::gen::inRange(0, 6)];
    const int degree = *rc::gen::inRange(5, 15);
    const auto g1 = solve_g1(HandleAngles{turning, share * turning, 1, 0}, alpha);
    RC_PRE(g1.has_value());
    const auto r = quasi_log_aesthetic(g1->segment, {form, degree, {}, false});
    RC_PRE(r.has_value());
    const double sampled = sampled_deviation(r->target, r->curve, 15);
    RC_ASSERT(sampled <= r->deviation);
    if (form != QuasiForm::discrete_arc && form != QuasiForm::discrete_angle) return;
    RC_ASSERT(r->deviation <= 1.2 * sampled_deviation(r->target, r->curve, 60) + 1e-12);
  }));
}

// Next to a corner weights run over four decades; a bound taken with the least of them on a whole
// stretch was up to four million times too large.
TEST(Quasi, DeviationBoundIsCloseNextToCorners) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0, 1);
  int checked = 0;
  double worst = 0;
  while (checked < 40) {
    const double alpha = -3 + 6 * unit(random);
    const Piece shape{alpha, 1, 1, std::pow(10, 8 * unit(random) - 4)};
    const double wanted = 0.2 + 2 * unit(random);
    const double turning = total_turning(shape);
    Piece piece = shape;
    piece.curvature_start *= wanted / turning;
    piece.curvature_end *= wanted / turning;
    const auto r = quasi_log_aesthetic(place(piece, {}), {QuasiForm::rational_cubic, 3, {}, false});
    // Far off a curve runs another way, and equal places are no longer the nearest.
    if (!r || r->deviation > 0.2) continue;
    ++checked;
    double sampled = 0;
    for (int i = 0; i <= 400; ++i) {  // ever closer at the ends
      const double t = 0.5 - 0.5 * std::cos(core::kPi * i / 400);
      sampled = std::max(sampled, curve::closest_point(r->target, evaluate(r->curve, t)).distance);
      sampled = std::max(sampled, curve::closest_point(r->curve, evaluate(r->target, t)).distance);
    }
    ASSERT_LE(sampled, r->deviation) << alpha << ' ' << piece.curvature_end;
    worst = std::max(worst, r->deviation / (sampled + 1e-12));
  }
  EXPECT_LT(worst, 1.3);
}

TEST(Quasi, RationalCubicAndBestKeepTheirEnds) {
  for (const double alpha : {-2.0, -1.0, 0.0, 0.5, 1.0, 2.0})
    for (const QuasiForm form : {QuasiForm::rational_cubic, QuasiForm::best})
      for (const int degree : {5, 8}) {
        SCOPED_TRACE(alpha);
        const Segment s{{{3, -2}, 0.7}, alpha, 1.5, -0.8, -0.3};
        const auto r = quasi_log_aesthetic(s, {form, degree, {}, false});
        ASSERT_TRUE(r);
        for (const double t : {0.0, 1.0}) {
          const auto got = jet(r->curve, t);
          EXPECT_LT(distance(got.point, evaluate(s, t)), 2e-15 * 4);
          EXPECT_NEAR(core::wrap_angle(curve::tangent_angle(got) - tangent_angle(s, t)), 0, 1e-14);
          EXPECT_NEAR(curve::curvature(got), curvature(s, t), 1e-12);
        }
        EXPECT_LT(r->deviation, 1e-4);
        EXPECT_NEAR(r->lcg_slope, alpha, 1e-2);
        EXPECT_EQ(r->monotone.answer, curve::MonotoneVerdict::yes);
      }
}

TEST(Quasi, RationalCubicOfAnArcIsTheArc) {
  const Segment arc{{{1, 1}, 0.3}, -1, 2, 0.6, 0.6};
  const auto r = quasi_log_aesthetic(arc, {QuasiForm::rational_cubic, 3, {}, false});
  ASSERT_TRUE(r);
  EXPECT_LT(r->deviation, 1e-13);
  EXPECT_FALSE(r->lcg_defined);
}

TEST(Quasi, HandlesAreMetByTheBezierItself) {
  const core::Point2 p0{1, 1}, p1{3, 1}, p2{4, 2.4};
  for (const double alpha : {-1.0, 0.0, 1.0, 2.0})
    for (const QuasiForm form : kForms)
      for (const int degree : {5, 8, 20}) {
        SCOPED_TRACE(testing::Message() << alpha << " form " << static_cast<int>(form));
        const auto r = quasi_log_aesthetic(p0, p1, p2, alpha, {form, degree, {}, false});
        ASSERT_TRUE(r) << r.error().message;
        EXPECT_EQ(r->curve.control.front(), p0);
        EXPECT_EQ(r->curve.control.back(), p2);
        const auto& b = r->curve.control;
        EXPECT_NEAR(core::angle_between(b[1] - b[0], p1 - p0), 0, 1e-15 * 4);
        EXPECT_NEAR(core::angle_between(b.back() - b[b.size() - 2], p2 - p1), 0, 1e-15 * 4);
        EXPECT_LT(r->deviation, degree == 20 ? 1e-2 : 1e-1);
      }
}

TEST(Quasi, TurningRightMirrorsTurningLeft) {
  const QuasiOptions options{QuasiForm::taylor_angle, 7, {}, false};
  const auto left = quasi_log_aesthetic({0, 0}, {2, 0}, {3, 1.5}, 0.3, options);
  const auto right = quasi_log_aesthetic({0, 0}, {2, 0}, {3, -1.5}, 0.3, options);
  ASSERT_TRUE(left && right);
  EXPECT_NEAR(left->lambda, right->lambda, 1e-12);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(left->curve.control[i].x, right->curve.control[i].x, 1e-13);
    EXPECT_NEAR(left->curve.control[i].y, -right->curve.control[i].y, 1e-13);
  }
}

TEST(Quasi, AutomaticExpansionBeatsTheRule) {
  for (const double alpha : {-1.0, 0.0, 1.0, 2.0}) {
    const auto ruled = quasi_log_aesthetic(alpha, 0.5, {0, 0.8}, {QuasiForm::taylor_angle, 8});
    const auto chosen =
        quasi_log_aesthetic(alpha, 0.5, {0, 0.8}, {QuasiForm::taylor_angle, 8, {}, true});
    ASSERT_TRUE(ruled && chosen);
    EXPECT_LT(chosen->deviation, 0.2 * ruled->deviation) << alpha;
    EXPECT_GE(chosen->series_bound, chosen->deviation * 0.9) << alpha;
  }
}

TEST(Quasi, RuleExpandsAwayFromTheSingularity) {
  const auto about = [](double alpha, QuasiForm form) {
    return quasi_log_aesthetic(alpha, 0.4, {0, 1}, {form, 6})->about;
  };
  EXPECT_EQ(about(0.9, QuasiForm::taylor_angle), 0);
  EXPECT_EQ(about(1, QuasiForm::taylor_angle), 1);
  EXPECT_EQ(about(-0.1, QuasiForm::taylor_arc), 0);
  EXPECT_EQ(about(0, QuasiForm::taylor_arc), 1);
}

TEST(Quasi, RefusesWhatThereIsNot) {
  const Segment plain{{}, -1, 1, 0.2, 1};
  const Segment s_shaped{{}, -1, 1, -0.5, 1};
  const Segment cusp{{}, 2, 1, std::numeric_limits<double>::infinity(), 1};
  const auto code = [](const Segment& s, const QuasiOptions& o) {
    const auto r = quasi_log_aesthetic(s, o);
    return r ? ErrorCode::internal : r.error().code;
  };
  EXPECT_EQ(code(plain, {QuasiForm::taylor_angle, 2}), ErrorCode::bad_input);
  EXPECT_EQ(code(plain, {QuasiForm::taylor_angle, 31}), ErrorCode::bad_input);
  EXPECT_EQ(code(plain, {QuasiForm::best, 4}), ErrorCode::bad_input);
  EXPECT_EQ(code(plain, {QuasiForm::taylor_arc, 6, 1.5}), ErrorCode::bad_input);
  EXPECT_EQ(code(plain, {QuasiForm::taylor_arc, 6, NAN}), ErrorCode::bad_input);
  EXPECT_EQ(code(s_shaped, {QuasiForm::taylor_angle, 6}), ErrorCode::unsupported);
  EXPECT_EQ(code(s_shaped, {QuasiForm::rational_cubic}), ErrorCode::unsupported);
  EXPECT_EQ(code(cusp, {QuasiForm::taylor_angle, 6, 0.0}), ErrorCode::unsupported);
  EXPECT_EQ(code(s_shaped, {QuasiForm::taylor_arc, 9}), ErrorCode::internal);
  EXPECT_EQ(code(s_shaped, {QuasiForm::best, 9}), ErrorCode::internal);
  const auto region = quasi_log_aesthetic({0, 0}, {1, 0}, {1.05, 3}, -1, {});
  ASSERT_FALSE(region);
  EXPECT_EQ(region.error().code, ErrorCode::undrawable);
}

// At a cusp the curvature to hold is infinite, beside one it asks for a handle that rounding loses.
TEST(Quasi, BestServesAtACuspNoWorseThanAnyForm) {
  struct Case {
    double alpha, lambda, beside, turning;
    int degree;
  };
  for (const Case& c : {Case{3, 1, 0, 0.74, 10}, Case{4, 0.5, 0, 2.5, 6}, Case{2, 0.35, 1e-9, 2, 6},
                        Case{1.5, 1.9, 1e-6, 1.7, 10}, Case{1.2, 1.02, 0, 0.45, 5}}) {
    const double cusp = -1 / ((c.alpha - 1) * c.lambda);
    const core::Interval angles{cusp + c.beside, cusp + c.turning};
    SCOPED_TRACE(c.alpha);
    const auto best = quasi_log_aesthetic(c.alpha, c.lambda, angles, {QuasiForm::best, c.degree});
    ASSERT_TRUE(best) << best.error().message;
    int others = 0;
    for (const QuasiForm form : kForms) {
      const auto other = quasi_log_aesthetic(c.alpha, c.lambda, angles, {form, c.degree});
      if (!other) continue;
      ++others;
      EXPECT_LE(best->deviation, other->deviation * (1 + 1e-9));
    }
    EXPECT_GE(others, 4);
    const auto& control = best->curve.control;
    const Segment& target = best->target;
    const core::Pose2 end = end_pose(target);
    EXPECT_LT(distance(control.front(), target.start.position), 1e-14 * target.length);
    EXPECT_LT(distance(control.back(), end.position), 1e-14 * target.length);
    const auto expect_direction = [&](const core::Point2& from, const core::Point2& to, double d) {
      const double rounding = 1e-15 * (std::abs(to.x) + std::abs(to.y)) / distance(from, to);
      EXPECT_NEAR(core::wrap_angle(core::direction_of(to - from) - d), 0, 1e-14 + rounding);
    };
    expect_direction(control[0], control[1], angles.low);
    expect_direction(control[c.degree - 1], control[c.degree], angles.high);
    if (c.beside == 0 && c.alpha > 2) {
      EXPECT_NEAR(curvature(jet(best->curve, 1.0)) / target.curvature_end, 1, 1e-11);
    }
  }
}

TEST(Quasi, BestServesBeyondAFullTurn) {
  const auto best = quasi_log_aesthetic(-1, 0.02, {0, 7}, {QuasiForm::best, 10});
  ASSERT_TRUE(best);
  EXPECT_LT(best->deviation,
            0.1 * quasi_log_aesthetic(-1, 0.02, {0, 7}, {QuasiForm::discrete_arc, 10})->deviation);
}

TEST(Quasi, StraightLinesAndScales) {
  for (const QuasiForm form : kForms) {
    const auto line = quasi_log_aesthetic({0, 0}, {1, 1}, {2, 2}, -1, {form, 6});
    ASSERT_TRUE(line);
    EXPECT_LT(line->deviation, 1e-13);
    for (const double size : {1e-150, 1e150}) {
      const auto r =
          quasi_log_aesthetic({0, 0}, {2 * size, 0}, {3 * size, 1.5 * size}, -1, {form, 6});
      ASSERT_TRUE(r);
      EXPECT_LT(r->deviation, 1e-2 * size);
    }
  }
}

}  // namespace
}  // namespace keyline::lac

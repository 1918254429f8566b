#include "keyline/classa/edit.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keyline/classa/free_form.h"
#include "keyline/classa/nearest_space.h"
#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"
#include "keyline/curve/polyline.h"
#include "keyline/numeric/random.h"

namespace keyline::classa {
namespace {

using core::kPi;
using core::Point2;

const MatrixCurve kOya{{0, 0}, {1, 2}, 1, {kPi / 4, 1.05}, 3};

double start_direction(const curve::Bezier2& c) {
  return core::direction_of(c.control[1] - c.control[0]);
}

TEST(Edit, ExampleOfThePaper) {  // [Oya] section 4.1, Figs. 7 and 8
  EditOptions options;
  options.cav.end_tolerance = 0.01;
  const auto edited = edit(to_bezier(kOya), options);
  ASSERT_TRUE(edited) << edited.error().message;
  EXPECT_EQ(edited->before.type, 3);
  EXPECT_EQ(edited->after.type, 1);
  EXPECT_EQ(edited->after.cav, 0);
  EXPECT_NEAR(edited->before.energy, 0.3925, 5e-5);
  EXPECT_NEAR(edited->after.energy, 0.3287, 5e-5);
  EXPECT_NEAR(edited->after.matrix->alpha, 0.6474, 5e-5);
  EXPECT_NEAR(edited->after.matrix->s, 1.4404, 5e-5);
  const auto& before = to_bezier(kOya);
  EXPECT_NEAR(core::distance(edited->curve.control[0], edited->curve.control[1]) / std::sqrt(5),
              0.6435, 5e-5);
  EXPECT_NEAR(core::distance(edited->curve.control.back(), before.control.back()), 0.01, 1e-12);
  EXPECT_NEAR(start_direction(edited->curve), std::atan2(2, 1), 1e-12);
  EXPECT_EQ(edited->after.monotone.answer, curve::MonotoneVerdict::yes);
}

/// Ends and start tangent stay at every amount, and the curve moves continuously.
TEST(Edit, SlidesContinuously) {
  numeric::Random random(5);
  for (int i = 0; i < 40; ++i) {
    MatrixCurve c{{2, 1}, core::unit_vector(random.uniform(-3, 3)), 2, {}, 3};
    c.matrix = {random.uniform(-0.9, 0.9), random.uniform(0.6, 1.8)};
    c.degree = 3 + static_cast<int>(random.index(2));
    curve::Bezier2 given = to_bezier(c);
    if (i % 2 == 0) given.control[1] = given.control[1] + 0.1 * c.tangent;  // type 4
    EditOptions options;
    options.cav.end_tolerance = i % 3 == 0 ? 0.02 : 0.0;
    curve::Bezier2 last = given;
    for (const double amount : {0.0, 0.01, 0.02, 0.5, 0.51, 0.99, 1.0}) {
      options.amount = amount;
      const auto edited = edit(given, options);
      ASSERT_TRUE(edited) << edited.error().message;
      const bool reversed = edited->before.reversed;
      const auto kept = reversed ? reverse(edited->curve) : edited->curve;
      const auto original = reversed ? reverse(given) : given;
      EXPECT_NEAR(core::wrap_angle(start_direction(kept) - start_direction(original)), 0, 1e-9);
      EXPECT_EQ(kept.control.front(), original.control.front());
      EXPECT_LE(core::distance(kept.control.back(), original.control.back()),
                *options.cav.end_tolerance + 1e-12);
      if (amount == 0) {
        EXPECT_EQ(edited->curve, given);
      }
      if (edited->before.type <= 3) {
        EXPECT_LE(edited->after.type, 3);
      }
      for (std::size_t k = 0; k < given.control.size(); ++k) {
        const double step = core::distance(edited->curve.control[k], last.control[k]);
        EXPECT_LE(step, amount == 0.5 || amount == 0.99 ? 10 : 0.3) << amount;
      }
      last = edited->curve;
    }
  }
}

TEST(Edit, TargetsByHand) {
  EditOptions options;
  options.cav.end_tolerance = 0;
  options.target = ControlMatrix{0.7, 1.5};
  const auto given = to_bezier(kOya);
  const auto nearest = edit(given, options);
  ASSERT_TRUE(nearest) << nearest.error().message;
  EXPECT_LE(core::distance(nearest->curve.control.back(), given.control.back()), 1e-12);
  EXPECT_NEAR(start_direction(nearest->curve), std::atan2(2, 1), 1e-9);
  EXPECT_LT(plane_distance(nearest->target, *options.target), 0.3);
  EXPECT_NEAR(nearest->after.matrix->s, nearest->target.s, 1e-9);

  options.hold = Hold::ends;
  const auto ends = edit(given, options);
  ASSERT_TRUE(ends);
  EXPECT_EQ(ends->target, *options.target);
  EXPECT_LE(core::distance(ends->curve.control.back(), given.control.back()), 1e-12);
  EXPECT_NEAR(ends->after.matrix->alpha, 0.7, 1e-12);

  options.hold = Hold::start;
  const auto start = edit(given, options);
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->after.matrix->s, 1.5, 1e-12);
  EXPECT_NEAR(start_direction(start->curve), std::atan2(2, 1), 1e-12);
}

// A place whose curve misses the end by no more than the tolerance is taken as it is, its end the
// nearest on its ray; any other turns the ray as far as the tolerance allows, by asin of it.
TEST(Edit, EndsTurnTowardsTheTargetAsFarAsTheyMay) {
  const auto given = to_bezier(kOya);
  const core::Vector2 chord = given.control.back() - given.control.front();
  constexpr double kSlack = 0.02;
  for (const double off : {-0.05, -0.015, 0.0, 0.015, 0.05}) {
    SCOPED_TRACE(off);
    EditOptions options;
    options.cav.end_tolerance = kSlack * norm(chord);
    const double middle = end_angle(kOya.matrix, 3);
    const double s = scale_at_end_angle(0.7, middle + off, 3, {1e-3, 1e3});
    options.target = ControlMatrix{0.7, s};
    const auto edited = edit(given, options);
    ASSERT_TRUE(edited) << edited.error().message;
    const core::Vector2 reached = edited->curve.control.back() - given.control.front();
    const double most = std::asin(kSlack);
    const double turn = std::clamp(off, -most, most);
    EXPECT_NEAR(core::angle_between(chord, reached), turn, 1e-9);
    EXPECT_NEAR(norm(reached), norm(chord) * std::cos(turn), 1e-9);
    if (turn == off)
      EXPECT_EQ(edited->target, *options.target);
    else
      EXPECT_GT(plane_distance(edited->target, *options.target), 1e-3);
  }
}

// By hand the end moves only by a tolerance that is given, in whichever direction the curve is
// read.
TEST(Edit, KeepsTheEndUnlessATargetMayMoveIt) {
  const curve::Bezier2 given{{{0, 0}, {1, 0.1}, {2, 0.6}, {2.8, 1.5}}, {}};
  EditOptions options;
  options.target = ControlMatrix{0.3, 1.2};
  for (const curve::Bezier2& c : {given, reverse(given)}) {
    const auto edited = edit(c, options);
    ASSERT_TRUE(edited) << edited.error().message;
    EXPECT_LE(core::distance(edited->curve.control.front(), c.control.front()), 1e-12);
    EXPECT_LE(core::distance(edited->curve.control.back(), c.control.back()), 1e-12);
  }
}

TEST(Edit, FreeFormReachesItsMinimum) {
  const curve::Bezier2 s_shaped{{{0, 0}, {1, 0.2}, {2, 0.1}, {3, 1.5}}, {}};
  const auto edited = edit(s_shaped);
  ASSERT_TRUE(edited) << edited.error().message;
  EXPECT_GE(edited->before.type, 4);
  EXPECT_EQ(edited->after.type, 1);
}

TEST(Edit, CurvesInSpaceBecomeThePlaneCurveOfLeastEnergyWithTheirEnds) {
  const auto flat = to_bezier(kOya);
  curve::Bezier3 tilted;
  for (const Point2& p : flat.control) tilted.control.push_back({p.x + 3, 0.6 * p.y, 0.8 * p.y});
  EditOptions options;
  options.cav.end_tolerance = 0;
  const auto plane = edit(flat, options);
  const auto space = edit(tilted, options);
  ASSERT_TRUE(plane && space) << space.error().message;
  EXPECT_EQ(space->curve.control.front(), tilted.control.front());
  for (std::size_t i = 0; i < flat.control.size(); ++i) {
    const Point2 p = plane->curve.control[i];
    EXPECT_LE(core::distance(space->curve.control[i], {p.x + 3, 0.6 * p.y, 0.8 * p.y}), 1e-7);
  }
  tilted.control[2].x += 0.1;
  tilted.control[2].z += 0.1;
  // In no plane: to the plane curve of least energy with its start, tangent and end.
  const auto twisted = edit(tilted, options);
  ASSERT_TRUE(twisted) << twisted.error().message;
  const auto& points = twisted->curve.control;
  EXPECT_EQ(twisted->flat.after.type, 1);
  EXPECT_LT(twisted->flat.after.energy, twisted->flat.before.energy);
  EXPECT_LE(core::distance(points.front(), tilted.control.front()), 1e-12);
  EXPECT_LE(core::distance(points.back(), tilted.control.back()), 1e-9);
  const core::Vector3 tangent = tilted.control[1] - tilted.control[0];
  EXPECT_LE(norm(cross(points[1] - points[0], tangent)), 1e-9);
  options.amount = 0;
  const auto still = edit(tilted, options);
  ASSERT_TRUE(still);
  EXPECT_EQ(still->curve, tilted);
}

TEST(Edit, BadInput) {
  EditOptions options;
  options.amount = 1.5;
  EXPECT_FALSE(edit(to_bezier(kOya), options));
  options = {};
  options.target = ControlMatrix{1.2, 1.5};
  EXPECT_FALSE(edit(to_bezier(kOya), options));
  options.target = ControlMatrix{0.2, 1000};
  EXPECT_FALSE(edit(to_bezier(kOya), options));
  EXPECT_TRUE(edit(curve::Bezier2{{{0, 0}, {1, 1}}, {}}));
}

TEST(Nearest, FindsTheMatrixOfAMatrixCurve) {
  numeric::Random random(21);
  for (int i = 0; i < 20; ++i) {
    MatrixCurve c{{2, 1}, core::unit_vector(random.uniform(-3, 3)), 2, {}, 3};
    c.matrix = {random.uniform(-1, 1), random.uniform(0.5, 2)};
    c.degree = 3 + static_cast<int>(random.index(4));
    const auto nearest = nearest_matrix_curve(to_bezier(c));
    ASSERT_TRUE(nearest);
    EXPECT_NEAR(nearest->matrix.alpha, c.matrix.alpha, 1e-5);
    EXPECT_NEAR(nearest->matrix.s, c.matrix.s, 1e-5);
    EXPECT_LE(nearest->distance, 1e-6);
  }
}

TEST(Nearest, ReversingChangesNothing) {
  const curve::Bezier2 c{{{0, 0}, {1, 0}, {2.2, 0.4}, {2.5, 2}}, {}};
  const auto nearest = nearest_matrix_curve(c);
  const auto back = nearest_matrix_curve(reverse(c));
  ASSERT_TRUE(nearest && back);
  EXPECT_NEAR(nearest->matrix.alpha, -back->matrix.alpha, 1e-6);
  EXPECT_NEAR(nearest->matrix.s, 1 / back->matrix.s, 1e-6);
  EXPECT_NEAR(nearest->distance, back->distance, 1e-7);
  EXPECT_FALSE(nearest_matrix_curve(curve::Bezier2{{{0, 0}, {1, 0}, {1, 1}, {0, 0}}, {}}));
}

TEST(Nearest, ATurnedPlaneCurveHasThePlanesATwistedOneTheSameFromEitherEnd) {
  const curve::Bezier2 flat{{{0, 0}, {1, 0}, {2.2, 0.4}, {2.5, 2}}, {}};
  curve::Bezier3 tilted;
  for (const Point2& p : flat.control) tilted.control.push_back({p.x + 3, 0.6 * p.y, 0.8 * p.y});
  const auto plane = nearest_matrix_curve(flat);
  const auto space = nearest_matrix_curve(tilted);
  ASSERT_TRUE(plane && space);
  EXPECT_NEAR(std::abs(space->flat.matrix.alpha), std::abs(plane->matrix.alpha), 1e-6);
  EXPECT_NEAR(space->flat.matrix.s, plane->matrix.s, 1e-6);
  EXPECT_NEAR(space->distance, plane->distance, 1e-6);
  EXPECT_LT(core::distance(space->curve.control.back(), tilted.control.back()), 1e-12);

  tilted.control[2].x += 0.1;
  tilted.control[2].z += 0.1;
  const auto twisted = nearest_matrix_curve(tilted);
  const auto back = nearest_matrix_curve(reverse(tilted));
  ASSERT_TRUE(twisted && back);
  EXPECT_GT(twisted->distance, space->distance);
  EXPECT_NEAR(twisted->distance, back->distance, 1e-6);
  EXPECT_NEAR(twisted->flat.matrix.s, 1 / back->flat.matrix.s, 1e-5);
}

/// Whatever the points: finite, and the same from either end.
TEST(FreeForm, AnyPointsAtAll) {
  numeric::Random random(5);
  int placed = 0;
  int changed = 0;
  for (int i = 0; i < 40; ++i) {
    curve::Bezier2 c;
    const std::size_t count = 3 + random.index(6);
    for (std::size_t k = 0; k < count; ++k)
      c.control.push_back({std::round(random.uniform(-3, 3)), random.uniform(-2, 2)});
    const auto one = evaluate_curve({c, true}, {});
    const auto two = evaluate_curve({reverse(c), true}, {});
    ASSERT_EQ(one.has_value(), two.has_value());
    if (!one) continue;
    ASSERT_EQ(one->nearest.has_value(), two->nearest.has_value());
    if (!one->nearest) continue;
    ++placed;
    EXPECT_TRUE(std::isfinite(one->nearest->distance));
    EXPECT_NEAR(one->nearest->rms, two->nearest->rms, 1e-9) << i;
    const auto edited = edit(c);
    if (edited) {
      ++changed;
      EXPECT_LE(edited->after.cav, edited->before.cav + 1e-9) << i;
    }
  }
  EXPECT_GT(placed, 20);
  EXPECT_GT(changed, 20);
}

/// A logarithmic spiral turns into a polynomial of several matrices that lies beside one.
TEST(FreeForm, SpiralHasANearCurve) {
  std::vector<Point2> points;
  for (int i = 0; i <= 100; ++i) {
    const double a = 0.012 * i;
    points.push_back({std::exp(0.5 * a) * std::cos(a), std::exp(0.5 * a) * std::sin(a)});
  }
  const curve::Polyline2 spiral{points};
  const auto approximation = approximate(curve::PlanarView(spiral), 1e-4);
  ASSERT_TRUE(approximation) << approximation.error().message;
  EXPECT_FALSE(approximation->exact);
  EXPECT_LE(approximation->deviation, 1e-4);
  EXPECT_EQ(approximation->curve.control.front(), points.front());
  const auto plain = approximate(curve::PlanarView(spiral));  // a thousandth of the size
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_LE(plain->deviation, 1e-3 * distance(points.front(), points.back()));
  const auto evaluation = evaluate_curve(*approximation, {});
  ASSERT_TRUE(evaluation) << evaluation.error().message;
  EXPECT_GE(evaluation->value.type, 4);
  ASSERT_TRUE(evaluation->nearest && evaluation->nearest_value);
  EXPECT_LE(evaluation->nearest->distance, 0.01);
  EXPECT_LE(evaluation->nearest_value->type, 3);
  EXPECT_LT(evaluation->nearest_value->cav, evaluation->value.cav);
}

TEST(FreeForm, SaysWhenDegreeEightIsNotEnough) {
  std::vector<Point2> wave;
  for (int i = 0; i <= 400; ++i) wave.push_back({0.05 * i, std::sin(0.25 * i)});
  const curve::Polyline2 line{wave};
  const auto none = approximate(curve::PlanarView(line), 1e-3);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, core::ErrorCode::not_converged);
  EXPECT_FALSE(approximate(curve::PlanarView(line), -1.0));
  const curve::Polyline2 point{{{1, 1}, {1, 1}}};
  EXPECT_FALSE(approximate(curve::PlanarView(point)));
}

}  // namespace
}  // namespace keyline::classa

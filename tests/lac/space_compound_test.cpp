#include "keyline/lac/space/space_compound.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/lac/chain/extend.h"

namespace keyline::lac {
namespace {

const SpaceHermite kData{{0, 0, 0}, {3, 1, 0.5}, {1, 0, 0}, {1, 1, 0.6}};

/// Of a law whose power -slope runs linearly from `from` to `to`, at the share v of the length.
double law_at(double slope, double from, double to, double v) {
  return std::pow((1 - v) * std::pow(from, -slope) + v * std::pow(to, -slope), -1 / slope);
}
/// Its rate at either end, by the same closed form.
double law_rate(double slope, double from, double to, double length, double at) {
  return std::pow(at, 1 + slope) * (std::pow(to, -slope) - std::pow(from, -slope)) /
         (-slope * length);
}

TEST(SolveCompoundSpace, OfEqualSlopesIsTheCurveOfOne) {
  const auto one = solve_g1_space(kData, -1, 0.5, 0.1);
  const auto two = solve_compound_space(
      kData, {.alpha = {-1, -1}, .beta = {0.5, 0.5}, .omega = 0.1, .length_share = 0.4});
  ASSERT_TRUE(one && two);
  EXPECT_NEAR(two->lambda, one->lambda, 1e-9);
  EXPECT_NEAR(two->nu, one->nu, 1e-9);
  EXPECT_NEAR(two->length, one->length, 1e-9);
  const SpacePiece& p = one->chain.pieces[0];
  ASSERT_EQ(two->chain.pieces.size(), 2U);
  const SpacePiece& first = two->chain.pieces[0];
  EXPECT_NEAR(first.length, 0.4 * p.length, 1e-9);
  EXPECT_NEAR(first.curvature_end, law_at(-1, p.curvature_start, p.curvature_end, 0.4), 1e-9);
}

TEST(SolveCompoundSpace, RatesAgreeAtTheJointAndWithTheStandardForm) {
  const auto r = solve_compound_space(
      kData, {.alpha = {-1, 0.5}, .beta = {-1, -1}, .omega = 0.1, .length_share = 0.35});
  ASSERT_TRUE(r) << r.error().hint;
  const SpacePiece& a = r->chain.pieces[0];
  const SpacePiece& b = r->chain.pieces[1];
  EXPECT_NEAR(a.length / (a.length + b.length), 0.35, 1e-12);
  const double before =
      law_rate(a.alpha, a.curvature_start, a.curvature_end, a.length, a.curvature_end);
  const double after =
      law_rate(b.alpha, b.curvature_start, b.curvature_end, b.length, b.curvature_start);
  EXPECT_NEAR(after, before, 1e-9 * std::abs(before));
  // lambda is drho/ds at the start, of whichever unit.
  const double start =
      law_rate(a.alpha, a.curvature_start, a.curvature_end, a.length, a.curvature_start);
  EXPECT_NEAR(r->lambda, -start / (a.curvature_start * a.curvature_start), 1e-9);
  EXPECT_NEAR(r->length, (a.length + b.length) * a.curvature_start, 1e-9);
  const SpaceFrame end = frame_at(r->chain, 1);
  EXPECT_LT(distance(end.position, kData.end), 1e-10);
  EXPECT_LT(norm(cross(end.tangent, kData.end_tangent)), 1e-10);
}

// Its first way led to a spiral of a dozen turns.
TEST(SolveCompoundSpace, WindsNoMoreThanAFamilyOfOneSlope) {
  const SpaceHermite data{{0, 0, 0}, {3, 0, 1.5}, {1, 1, 0}, {1, 1, 0.3}};
  const auto r = solve_compound_space(
      data, {.alpha = {-1, 0.5}, .beta = {-1, -1}, .omega = 0.1, .length_share = 0.5});
  ASSERT_TRUE(r) << r.error().hint;
  double turned = 0;
  constexpr int kPlaces = 1000;
  const double length = arc_length(r->chain);
  for (int i = 0; i < kPlaces; ++i)
    turned += std::abs(curvature(r->chain, (i + 0.5) / kPlaces)) * length / kPlaces;
  EXPECT_LT(turned, 3 * std::numbers::pi);
  EXPECT_LT(distance(frame_at(r->chain, 1).position, data.end), 1e-10);
}

// Where torsion changes as fast as here no curve of one slope has so large an omega.
TEST(SolveCompoundSpace, IsFoundWhereNoCurveOfOneSlopeIs) {
  const double share = 0.43, length = 0.66, nu = 9.8, joint = 0.19 * nu;
  SpacePiece a{2.4, -1.06, share * length, 1, 0.26, nu, joint};
  SpacePiece b{2.5, 0.86, (1 - share) * length, 0.26, 0, joint, 0};
  const auto continued = [&](double slope, const Piece& before, double from) {
    return *detail::curvature_continued(slope, from, curvature_rate(before, 1), b.length);
  };
  b.curvature_end = continued(b.alpha, curvature_law(a), 0.26);
  b.torsion_end = continued(b.beta, torsion_law(a), joint);
  const SpaceFrame end = frame_at({{}, {a, b}}, 1);
  const double omega = (std::pow(joint, 1.06) - std::pow(nu, 1.06)) / -1.06 / a.length;
  const auto solved =
      solve_compound_space({{}, end.position, {1, 0, 0}, end.tangent}, {.alpha = {a.alpha, b.alpha},
                                                                        .beta = {a.beta, b.beta},
                                                                        .omega = omega,
                                                                        .length_share = share});
  ASSERT_TRUE(solved) << solved.error().hint;
  const SpaceFrame there = frame_at(solved->chain, 1);
  EXPECT_LT(distance(there.position, end.position), 1e-11);
  EXPECT_LT(norm(there.tangent - end.tangent), 1e-11);
}

// A curve of these slopes integrated by another program (eighth order, to 1e-11): no way from a
// curve of one slope leads there.
TEST(SolveCompoundSpace, IsLookedForAllOverTheFamily) {
  const core::Point3 end{0.845994147439427, 0.36063432214006913, 5.0312732051032764e-05};
  const core::Vector3 tangent{0.054025525705283975, 0.9985395119143586, 0.0002927768894877365};
  const auto solved = solve_compound_space({{}, end, {1, 0, 0}, tangent},
                                           {.alpha = {-0.41582527928236246, 0.0},
                                            .beta = {2.6759229450637836, -1.2887893537678954},
                                            .omega = -11253827953.617676,
                                            .length_share = 0.2824846050892298});
  ASSERT_TRUE(solved) << solved.error().hint;
  EXPECT_LT(distance(frame_at(solved->chain, 1).position, end), 1e-10);
  EXPECT_NEAR(arc_length(solved->chain), 1, 1e-6);  // of the curve meant
}

struct Known {
  core::Point3 end;
  core::Vector3 tangent;
  SpaceRhythm rhythm;
};

// Curves of length 1 by scipy (DOP853, 1e-11). Their torsion is small beside the rate that omega
// gives it, next to where it would be infinite, so that steps in torsion itself led nowhere.
TEST(SolveCompoundSpace, IsFoundWhereTorsionIsSmallBesideItsRate) {
  const std::array<Known, 2> all{
      {{{0.9780412781878557, 0.1743312049923727, 0.00036515859583354193},
        {0.9235187152244164, 0.38355319218488565, 0.0003624845205892353},
        {{1.987506651811687, -2}, {1, -2}, 397.6087759371874, 0.2014517986858677}},
       {{0.99271477553997, 0.10753014164202336, 6.409572567806464e-06},
        {0.9816587866017562, 0.1906463391160765, 8.32111454060011e-06},
        {{3, 1.2338936242859937},
         {1, -1.003538828249052},
         22744.486248734258,
         0.16245968802446945}}}};
  for (const Known& known : all) {
    SCOPED_TRACE(known.rhythm.omega);
    const auto solved =
        solve_compound_space({{}, known.end, {1, 0, 0}, known.tangent}, known.rhythm);
    ASSERT_TRUE(solved) << solved.error().hint;
    const SpaceFrame end = frame_at(solved->chain, 1);
    EXPECT_LT(distance(end.position, known.end), 1e-11);
    EXPECT_LT(norm(end.tangent - known.tangent), 1e-11);
    EXPECT_NEAR(arc_length(solved->chain), 1, 1e-6);
    EXPECT_LT(largest_joint_gap(solved->chain).torsion, 1e-15);
  }
}

TEST(SolveCompoundSpace, MistakesAreNamed) {
  const auto path = [](SpaceRhythm rhythm) {
    return solve_compound_space(kData, rhythm).error().path;
  };
  EXPECT_EQ(path({.alpha = {-1, 101}}), "alpha[1]");
  EXPECT_EQ(path({.beta = {-200, 0}}), "beta[0]");
  EXPECT_EQ(path({.alpha = {101, 101}}), "alpha");
  EXPECT_EQ(path({.length_share = 1}), "ratio");
}

}  // namespace
}  // namespace keyline::lac

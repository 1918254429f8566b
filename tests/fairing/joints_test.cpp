#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/rate_joints.h"
#include "keyline/fairing/run.h"
#include "keyline/fairing/runs.h"
#include "keyline/fit/fit_spline.h"

/// Joints of one rate of curvature, asked for with --joints G3. Rates are worked out here from the
/// pieces' own numbers, without the solver.
namespace keyline::fairing {
namespace {

using Formula = core::Point2 (*)(double);

acquire::KeyLine measured(Formula at, int n) {
  std::mt19937 random(5);
  std::normal_distribution<double> error(0, 1e-4);
  acquire::RawCurve raw;
  for (int i = 0; i < n; ++i) {
    const core::Point2 p = at(i / (n - 1.0));
    raw.points.push_back({p.x + error(random), p.y + error(random), 0});
  }
  return acquire::acquire_key_line(raw).value();
}

core::Point2 half_ellipse(double u) {
  return {3 * std::cos(3.14159265358979 * u), std::sin(3.14159265358979 * u)};
}
core::Point2 sine(double u) { return {6 * u, std::sin(6 * u)}; }
core::Point2 cubic(double u) { return {2 * u - 1, std::pow(2 * u - 1, 3)}; }

/// d curvature / ds at an end: with p = -alpha curvature^p (with its sign) is linear in arc length.
double rate(const lac::Piece& piece, bool at_end) {
  const double p = -piece.alpha;
  const auto power = [p](double k) { return std::copysign(std::pow(std::abs(k), p), k); };
  const double k = at_end ? piece.curvature_end : piece.curvature_start;
  if (p == 0) return k * std::log(piece.curvature_end / piece.curvature_start) / piece.length;
  const double rise = (power(piece.curvature_end) - power(piece.curvature_start)) / piece.length;
  return rise / p * std::pow(std::abs(k), 1 - p);
}

JointRates counted(const lac::Chain& chain) {
  JointRates count;
  for (std::size_t i = 0; i + 1 < chain.pieces.size(); ++i) {
    const double before = rate(chain.pieces[i], true);
    const double after = rate(chain.pieces[i + 1], false);
    const double larger = std::max(std::abs(before), std::abs(after));
    if (std::abs(after - before) <= 1e-4 * larger)
      ++count.g3;
    else
      ++(before * after < 0 ? count.turns : count.jumps);
  }
  return count;
}

class JointsOfOneRate : public ::testing::TestWithParam<Formula> {};

TEST_P(JointsOfOneRate, AreAllWhereCurvatureDoesNotTurn) {
  const acquire::KeyLine line = measured(GetParam(), 161);
  FairOptions options;
  const FairResult plain = fair(line, options).value();
  options.joints = JointOrder::g3;
  const FairResult smooth = fair(line, options).value();
  const auto& before = std::get<lac::Chain>(plain.curves.at(0));
  const auto& after = std::get<lac::Chain>(smooth.curves.at(0));
  EXPECT_GT(counted(before).jumps, 0);
  const JointRates count = counted(after);
  EXPECT_EQ(count.jumps, 0);
  EXPECT_GT(count.g3, 0);
  EXPECT_EQ(smooth.joint_rates.g3, count.g3);
  EXPECT_EQ(smooth.joint_rates.turns, count.turns);
  EXPECT_EQ(smooth.joint_rates.jumps, 0);
  EXPECT_TRUE(smooth.within_tolerance);
  EXPECT_LT(lac::largest_joint_gap(after).curvature, 1e-9);
}

// A function is printed as its address, another in each run.
std::string formula_name(const ::testing::TestParamInfo<Formula>& at) {
  return std::vector<std::string>{"half_ellipse", "sine", "cubic"}.at(at.index);
}

INSTANTIATE_TEST_SUITE_P(Formulas, JointsOfOneRate, ::testing::Values(half_ellipse, sine, cubic),
                         formula_name);

lac::Chain as_chain(const FitChain& fit) {
  lac::Chain chain;
  for (std::size_t p = 0; p < fit.pieces.size(); ++p)
    chain.pieces.push_back({fit.pieces[p].alpha, fit.pieces[p].length, fit.joints[p].curvature,
                            fit.joints[p + 1].curvature});
  return chain;
}

// Where not all joints may be of one rate, those are that may: here any two, by a rule of the
// test's own.
TEST(JointsOfOneRate, AreAsManyAsMayBe) {
  const acquire::KeyLine line = measured(half_ellipse, 161);
  const detail::Run run = detail::run_between(line, 0, line.points.size() - 1);
  const auto spline = fit::fit_spline(run.points, {}, {}).value();
  detail::RunOptions options;
  options.tolerance = 4e-4;
  options.noise = 1e-4;
  detail::RunResult solved = detail::fair_run(run, spline.curve, options);
  const auto two = [](const FitChain& fit) -> std::optional<detail::RateLoss> {
    if (counted(as_chain(fit)).g3 > 2) return detail::RateLoss::waves;
    return std::nullopt;
  };
  ASSERT_GT(counted(as_chain(solved.fit)).jumps, 3);
  detail::RateOptions rates;
  rates.tolerance = solved.accept.tolerance;
  rates.loses = two;
  const detail::RateReport report = detail::join_rates(solved.fit, solved.points, rates);
  EXPECT_TRUE(report.within);
  const JointRates count = counted(as_chain(solved.fit));
  EXPECT_EQ(count.g3, 2);
  EXPECT_EQ(count.jumps, report.missed);
  EXPECT_EQ(report.missed, report.joints - 2);
  ASSERT_EQ(report.stay.size(), static_cast<std::size_t>(report.missed));
  int refused = 0;  // by the rule; others leave the tolerance
  for (const auto& [piece, loss] : report.stay) {
    refused += loss == detail::RateLoss::waves;
    const auto chain = as_chain(solved.fit);
    const double before = rate(chain.pieces[piece - 1], true);
    EXPECT_GT(std::abs(rate(chain.pieces[piece], false) - before), 1e-4 * std::abs(before));
  }
  EXPECT_GT(refused, 0);
}

core::Point2 limacon(double u) {
  const double t = 2 * 3.14159265358979 * u;
  return {(1 - 0.6 * std::cos(t)) * std::cos(t), (1 - 0.6 * std::cos(t)) * std::sin(t)};
}

TEST(JointsOfOneRate, AreToldWhereTheyAreMissed) {
  FairOptions options;
  options.joints = JointOrder::g3;
  const FairResult answer = fair(measured(limacon, 161), options).value();
  int told = 0;
  for (const std::string& note : answer.notes)
    if (note.find("G2 stays at") != std::string::npos)
      told += 1 + static_cast<int>(std::ranges::count(note, ','));
  EXPECT_GT(answer.joint_rates.jumps, 0);
  EXPECT_EQ(told, answer.joint_rates.jumps);
}

TEST(JointsOfOneRate, AreToldWhereTheyAreNotAskedFor) {
  const FairResult plain = fair(measured(sine, 161)).value();
  const JointRates count = counted(std::get<lac::Chain>(plain.curves.at(0)));
  EXPECT_EQ(plain.joint_rates.turns, count.turns);
  EXPECT_EQ(plain.joint_rates.jumps, count.jumps);
  EXPECT_THAT(plain.notes, ::testing::Not(::testing::Contains(::testing::HasSubstr("G3"))));
}

TEST(JointsOfOneRate, DoNotGoWithOtherSolversChains) {
  const acquire::KeyLine line = measured(sine, 161);
  const auto path = [&](auto change) {
    FairOptions options;
    options.joints = JointOrder::g3;
    change(options);
    const auto answer = fair(line, options);
    return answer ? std::string() : answer.error().path;
  };
  EXPECT_EQ(path([](FairOptions& o) { o.pieces = 4; }), "joints");
  EXPECT_EQ(path([](FairOptions& o) { o.criterion = Criterion::fewest_pieces; }), "joints");
  EXPECT_EQ(path([](FairOptions& o) { o.max_rate = 1e3; }), "joints");
  EXPECT_EQ(path([](FairOptions& o) { o.symmetric.mode = SymmetricMode::found; }), "joints");
  EXPECT_EQ(path([](FairOptions& o) { o.interpretations = {{0, analysis::Rhythm::plus, {}}}; }),
            "joints");
}

}  // namespace
}  // namespace keyline::fairing

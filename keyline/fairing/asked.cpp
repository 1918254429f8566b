#include "keyline/fairing/asked.h"

#include <cmath>

#include <fmt/format.h>

namespace keyline::fairing::detail {

using core::ErrorCode;
using core::fail;
using core::Result;

namespace {

bool is_shortest(const FairOptions& options) {
  return options.pieces > 0 || options.criterion != Criterion::least_variation;
}

/// What G3 joints do not go with: other solvers make those chains, or change them afterwards.
Result<void> check_joints(const FairOptions& options) {
  if (options.joints == JointOrder::g2) return {};
  std::string against;
  if (is_shortest(options))
    against = "the shortest chain";
  else if (options.max_rate)
    against = "a limit on curvature's rate";
  else if (options.symmetric.mode != SymmetricMode::off)
    against = "a symmetric answer";
  else if (!options.interpretations.empty())
    against = "readings asked for";
  if (against.empty()) return {};
  return fail(ErrorCode::bad_input, "G3 joints do not go with " + against, "leave one of them out",
              "joints");
}

/// What only the calmest chain heeds.
Result<void> check_shortest(const FairOptions& options) {
  if (!is_shortest(options)) return {};
  const core::Interval usual = FairOptions{}.slopes;
  const auto against = [](const char* what, const char* field) {
    return fail(ErrorCode::bad_input, fmt::format("{} does not go with the shortest chain", what),
                "leave one of them out", field);
  };
  if (options.max_rate) return against("a limit on curvature's rate", "max_rate");
  if (options.waves) return against("a number of waves", "waves");
  if (options.slopes.low != usual.low || options.slopes.high != usual.high)
    return against("a range of slopes", "slopes");
  return {};
}

/// Only a closed line goes on before its start and behind its end.
Result<void> check_region(bool closed, const std::optional<core::Interval>& region) {
  if (!region) return {};
  const core::Interval& r = *region;
  const bool within = r.low >= 0 && r.high <= 1;
  const bool around = closed && r.low >= -1 && r.high <= 2 && r.high - r.low <= 1;
  if (r.low < r.high && (within || around)) return {};
  return fail(ErrorCode::bad_input, "the region is not a part of the key-line",
              closed ? "give a:b with a < b <= a + 1; -0.1:0.2 runs over the start"
                     : "give a:b with 0 <= a < b <= 1",
              "region");
}

}  // namespace

Result<void> check(const acquire::KeyLine& line, const FairOptions& options) {
  if (line.points.size() < 2)
    return fail(ErrorCode::bad_input, "a key-line needs at least two points", "give more points");
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    return fail(ErrorCode::bad_input, "the tolerance is not a length",
                "give a number greater than 0", "tolerance");
  if (options.sigmas && options.tolerance > 0)
    return fail(ErrorCode::bad_input, "the tolerance is given twice",
                "give either \"tolerance\" or \"sigmas\"", "sigmas");
  if (options.sigmas && !(line.noise > 0))
    return fail(ErrorCode::bad_input, "these points have no noise to count the tolerance in",
                "give \"tolerance\", or the \"noise\"", "sigmas");
  if (options.spline.order < 4 || options.spline.order > 6)
    return fail(ErrorCode::bad_input, "the order of the spline is out of range", "give 4, 5 or 6",
                "order");
  if (options.waves && *options.waves < 0)
    return fail(ErrorCode::bad_input, "the number of waves is negative", "give 0 or more", "waves");
  if (options.pieces < 0)
    return fail(ErrorCode::bad_input, "the number of pieces is negative", "give 1 or more",
                "pieces");
  if (auto sound = check_shortest(options); !sound) return sound;
  if (auto sound = check_joints(options); !sound) return sound;
  for (const std::size_t index : options.must_pass)
    if (index >= line.points.size())
      return fail(ErrorCode::bad_input, "a point to be passed does not exist",
                  fmt::format("give indices below {}", line.points.size()), "must_pass");
  return check_region(line.closed, options.region);
}

}  // namespace keyline::fairing::detail

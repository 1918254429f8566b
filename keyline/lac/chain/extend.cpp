#include "keyline/lac/chain/extend.h"

#include <cmath>
#include <limits>
#include <string>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Pose2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Length beyond the end of the piece.
double bound_after(const Piece& p) {
  if (std::isinf(p.curvature_end)) return 0;
  const double rate = curvature_rate(p, 1);
  const double grows = rate * p.curvature_end;
  if (!(p.alpha > 0) || !(grows > 0)) return kInfinity;
  return p.curvature_end / (p.alpha * rate);
}

/// Curvature at fraction t > 1 or t < 0 of the length; inside the natural bounds.
double curvature_outside(const Piece& p, double t) {
  const double k0 = p.curvature_start;
  const double k1 = p.curvature_end;
  if (k0 == k1) return k0;
  if (p.alpha < 0) {
    const double size = std::fmax(std::abs(k0), std::abs(k1));
    const double z = (1 - t) * numeric::signed_power(k0 / size, -p.alpha) +
                     t * numeric::signed_power(k1 / size, -p.alpha);
    return size * numeric::signed_power(z, -1 / p.alpha);
  }
  if (std::isinf(k0)) return k1 * std::pow(t, -1 / p.alpha);
  if (std::isinf(k1)) return k0 * std::pow(1 - t, -1 / p.alpha);
  const double q = numeric::log_ratio(std::abs(k0), std::abs(k1));
  const double x = -p.alpha * q;
  if (std::abs(x) < 1e-300) return k0 * std::exp(t * q);
  return k0 * std::exp(-std::log1p(t * std::expm1(x)) / p.alpha);
}

/// The piece over [-before, length + after] of its own arc length.
Piece stretched(const Piece& p, double before, double after) {
  Piece longer = p;
  longer.length += before + after;
  if (before > 0) longer.curvature_start = curvature_outside(p, -before / p.length);
  if (after > 0) longer.curvature_end = curvature_outside(p, 1 + after / p.length);
  return longer;
}

std::unexpected<core::Failure> past_bound(const char* which, double bound) {
  return core::fail(ErrorCode::undrawable,
                    "curvature becomes infinite before the curve is so much longer",
                    which + (" less than " + core::number_text(bound, 9)));
}

core::Result<void> check(const Piece& first, const Piece& last, double before, double after) {
  if (!(before >= 0) || !(after >= 0) || std::isinf(before) || std::isinf(after)) {
    return core::fail(ErrorCode::bad_input, "the lengths to add must be finite and not negative");
  }
  const double free_before = natural_bounds(first).before;
  const double free_after = natural_bounds(last).after;
  if (before > 0 && before >= free_before) return past_bound("add before the start", free_before);
  if (after > 0 && after >= free_after) return past_bound("add after the end", free_after);
  return {};
}

core::Result<void> still_valid(const Piece& piece) {
  const auto ok = validate(piece);
  if (ok) return {};
  return core::fail(ErrorCode::undrawable,
                    "the longer curve is out of range: " + ok.error().message, "add less");
}

}  // namespace

namespace detail {

std::optional<double> curvature_continued(double alpha, double curvature, double rate, double s) {
  if (alpha == -1) return curvature + rate * s;
  if (curvature == 0) return std::nullopt;
  const double r = rate / curvature * s;
  if (std::abs(alpha) * std::abs(r) < 1e-300) return curvature * std::exp(r);
  const double y = -alpha * r;
  if (y > -1) return curvature * std::exp(-std::log1p(y) / alpha);
  if (alpha > 0) return std::nullopt;
  return -curvature * std::pow(-(1 + y), -1 / alpha);
}

}  // namespace detail

NaturalBounds natural_bounds(const Piece& piece) {
  return {bound_after(reversed(piece)), bound_after(piece)};
}

core::Result<Segment> extend(const Segment& segment, double before, double after) {
  const Piece piece = piece_of(segment);
  if (const auto ok = check(piece, piece, before, after); !ok) return std::unexpected(ok.error());
  const Piece longer = stretched(piece, before, after);
  if (const auto ok = still_valid(longer); !ok) return std::unexpected(ok.error());
  if (before == 0) return place(longer, segment.start);
  // The new part, run backwards from the old start.
  const Piece added{piece.alpha, before, longer.curvature_start, piece.curvature_start};
  const Pose2 there = end_pose(
      place(reversed(added), {segment.start.position, segment.start.direction + core::kPi}));
  return place(longer, {there.position, there.direction - core::kPi});
}

core::Result<Chain> extend(const Chain& chain, double before, double after) {
  if (chain.closed || chain.pieces.empty()) {
    return core::fail(ErrorCode::bad_input, "a closed curve has no ends to extend");
  }
  const Piece last = chain.pieces.back();
  if (const auto ok = check(chain.pieces.front(), last, before, after); !ok) {
    return std::unexpected(ok.error());
  }
  const auto first = extend(place(chain.pieces.front(), chain.start), before, 0);
  if (!first) return std::unexpected(first.error());
  Chain longer = chain;
  longer.start = first->start;
  longer.pieces.front() = piece_of(*first);
  longer.pieces.back() = stretched(longer.pieces.back(), 0, after);
  if (const auto ok = still_valid(longer.pieces.back()); !ok) return std::unexpected(ok.error());
  return longer;
}

namespace {

Pose2 mirrored_pose(const Pose2& pose, const Pose2& line) {
  const Point2 local = to_local(line, pose.position);
  return {from_local(line, {local.x, -local.y}), 2 * line.direction - pose.direction};
}

}  // namespace

Segment mirrored(const Segment& segment, const Pose2& line) {
  return place(mirrored(piece_of(segment)), mirrored_pose(segment.start, line));
}

Chain mirrored(const Chain& chain, const Pose2& line) {
  Chain image = chain;
  image.start = mirrored_pose(chain.start, line);
  for (Piece& piece : image.pieces) piece = mirrored(piece);
  return image;
}

}  // namespace keyline::lac

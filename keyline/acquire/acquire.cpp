#include "keyline/acquire/acquire.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "keyline/acquire/band.h"
#include "keyline/acquire/clean.h"
#include "keyline/acquire/corners.h"
#include "keyline/acquire/ends.h"
#include "keyline/acquire/noise.h"
#include "keyline/acquire/outliers.h"
#include "keyline/acquire/sort_out.h"
#include "keyline/acquire/statistics.h"
#include "keyline/core/polygon.h"
#include "keyline/core/text.h"

namespace keyline::acquire {
namespace {

using core::ErrorCode;
using detail::Working;

core::Result<Working> flatten(const RawCurve& raw, const AcquireOptions& options, KeyLine& line) {
  const std::vector<std::size_t> kept = detail::finite_points(raw);
  line.report.points_read = raw.points.size();
  line.report.non_finite = raw.points.size() - kept.size();
  if (line.report.non_finite > 0) {
    line.report.notes.push_back(
        core::counted(line.report.non_finite, "point") +
        " dropped: a coordinate or weight is missing, not a number or infinite");
  }
  if (kept.empty())
    return core::fail(ErrorCode::bad_input, "no point has finite coordinates",
                      "check which columns are x and y");
  std::vector<core::Point3> points;
  for (const std::size_t i : kept) points.push_back(raw.points[i]);
  if (options.plane) {
    line.plane = *options.plane;
  } else if (raw.has_z) {
    line.plane = fit_plane(points).plane;
  }
  Working work;
  work.scattered = raw.scattered;
  double sum = 0;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    work.points.push_back(to_plane(line.plane, points[k]));
    work.sources.push_back(kept[k]);
    if (!raw.weights.empty()) work.weights.push_back(raw.weights[kept[k]]);
    const double off = std::abs(distance_from_plane(line.plane, points[k]));
    line.report.plane_departure = std::max(line.report.plane_departure, off);
    sum += off * off;
  }
  line.report.plane_departure_rms = std::sqrt(sum / static_cast<double>(kept.size()));
  return work;
}

void note_plane(KeyLine& line, double extent) {
  if (line.report.plane_departure <= 1e-9 * extent) return;
  line.report.notes.push_back("points projected on a plane; largest distance from it " +
                              core::number_text(line.report.plane_departure, 3));
}

void merge(Working& work, KeyLine& line) {
  const std::size_t merged = detail::merge_repeated(work);
  line.report.duplicates += merged;
  if (merged > 0) {
    line.report.notes.push_back(core::counted(merged, "repeated point") + " merged");
  }
}

/// A closed polyline of two places is the line between them, there and back; false where there are
/// more.
bool settle_line(Working& work, const AcquireOptions& options, KeyLine& line) {
  const std::size_t n = work.points.size();
  if (!options.closed.value_or(false) || n < 2 || n > 3) return false;
  if (n == 3 && work.points[2] != work.points[0]) return false;
  if (n == 3) detail::remove_points(work, {2});
  line.report.notes.emplace_back("closed, but of two points: taken for the line between them");
  return true;
}

/// Points and what is kept of each of them, where it is kept.
template <class Change>
void for_each_list(Working& work, const Change& change) {
  change(work.points);
  if (!work.sources.empty()) change(work.sources);
  if (!work.weights.empty()) change(work.weights);
}

/// Closes the outline as its ends ask for: drops the repeated first point, or adds it at a corner.
void settle_ends(Working& work, std::size_t stride, double noise, const AcquireOptions& options,
                 KeyLine& line) {
  if (settle_line(work, options, line)) return;
  Ends ends = recognise_ends(work.points, stride, line.report.reordered || work.scattered, noise);
  if (options.closed) {
    const bool repeated = ends == Ends::closed_repeated || ends == Ends::corner_repeated;
    ends = *options.closed ? (repeated ? Ends::closed_repeated : Ends::closed) : Ends::apart;
  }
  const auto note = [&](const char* text) { line.report.notes.emplace_back(text); };
  switch (ends) {
    case Ends::apart:
      break;
    case Ends::closed_repeated:
      detail::remove_points(work, {work.points.size() - 1});
      [[fallthrough]];
    case Ends::closed:
      line.closed = true;
      note("recognised as a closed outline");
      break;
    case Ends::corner_repeated:
      line.ends_meet = true;
      note("the ends meet in a corner: kept as an open curve from corner to corner");
      break;
    case Ends::corner_at_last:
      for_each_list(work,
                    [](auto& list) { std::rotate(list.rbegin(), list.rbegin() + 1, list.rend()); });
      [[fallthrough]];
    case Ends::corner_at_first:
      for_each_list(work, [](auto& list) { list.push_back(list.front()); });
      line.ends_meet = true;
      note("closed outline that starts at a corner: kept as an open curve from corner to corner");
      break;
    case Ends::blunt:
      note("the ends face each other across a blunt edge: kept as an open curve");
      break;
  }
}

void drop_outliers(Working& work, double noise, std::size_t stride, KeyLine& line) {
  for (int pass = 0; pass < 3; ++pass) {
    const auto strays = find_outliers(work.points, line.closed, noise, stride);
    if (strays.empty() || work.points.size() < strays.size() + 4) break;
    for (const std::size_t i : strays) {
      if (!work.sources.empty()) line.report.outlier_sources.push_back(work.sources[i]);
    }
    line.report.outliers += strays.size();
    detail::remove_points(work, strays);
    merge(work, line);  // those that had a stray between them
  }
  std::sort(line.report.outlier_sources.begin(), line.report.outlier_sources.end());
  if (line.report.outliers > 0) {
    line.report.notes.push_back(core::counted(line.report.outliers, "stray point") + " removed");
  }
}

/// Length of the curve behind the points: the polygon of means where steps are noise.
double curve_length(const Working& work, bool closed, std::size_t stride) {
  if (stride <= 1) return core::polygon_length(work.points, closed);
  const std::size_t groups = work.points.size() / (2 * stride);
  return core::polygon_length(average_runs(work.points, {}, {}, groups).points, closed);
}

/// Fewer points than these cannot tell noise from bends: what windows leave is mostly shape.
constexpr std::size_t kTelling = 16;
constexpr double kMostUntold = 3e-4;  // of the length: noise that may as well be bends

/// Of the errors of rounding: residuals of that many show that there are such errors.
constexpr double kRoundingShows = 0.25;

/// Waves of so many strides are the longest that count as noise.
constexpr double kStridesPerWave = 10;

/// Noise at the scale asked for, or where its texture shows whole.
Texture texture_of(const Working& work, bool closed, const AcquireOptions& options) {
  if (!options.detail) return estimate_texture(work.points, closed);
  const double length = core::polygon_length(work.points, closed);
  const double step = length / static_cast<double>(work.points.size());
  const double stride = std::round(*options.detail / (kStridesPerWave * step));
  const double most = static_cast<double>(work.points.size()) / kStridesPerWave;
  const auto apart = static_cast<std::size_t>(std::max(1.0, std::min(stride, most)));
  return {estimate_noise(work.points, closed, apart), apart, noise_stride(work.points, closed)};
}

/// Says where waves that one could see are taken for noise, and what a detail asked for shows.
void note_texture(const Working& work, const Texture& texture, bool asked, KeyLine& line) {
  if (!asked && texture.stride <= texture.nearest) return;
  const double length = core::polygon_length(work.points, line.closed);
  const std::string wave = core::number_text(kStridesPerWave * static_cast<double>(texture.stride) *
                                                 length / static_cast<double>(work.points.size()),
                                             3);
  const std::string noise = core::number_text(texture.noise, 3);
  if (!asked) {
    line.report.notes.push_back("waves shorter than " + wave +
                                " are taken for the surface's texture, of " + noise +
                                "; \"detail\" sets that length");
    return;
  }
  const double beside = estimate_noise(work.points, line.closed, texture.nearest);
  line.report.notes.push_back("noise measured on waves shorter than " + wave + ": " + noise +
                              (texture.noise <= beside
                                   ? ", no more than neighbouring points show"
                                   : ", where neighbouring points show " +
                                         core::number_text(beside, 3) + "; higher waves stay"));
}

/// Steps that the coordinates are multiples of.
struct Steps {
  double decimal;
  double common;
};

/// Whether the residuals are of the order of a rounding's errors: there are such errors then. Those
/// of rounding are less than its errors, for along an outline's flat parts these are alike.
bool shows(const Working& work, const Texture& texture, double rounding) {
  return work.points.size() >= kTelling &&
         texture.noise >= kRoundingShows * rounding / std::sqrt(12.0);
}

/// What the coordinates were rounded to. A common step may also be one of exact coordinates, and
/// counts only where it shows.
double rounding_of(const Working& work, const Texture& texture, const Steps& steps) {
  return shows(work, texture, steps.common) ? std::max(steps.common, steps.decimal) : steps.decimal;
}

/// Noise from the residuals, of which little may be bends, and at least that of the rounding where
/// there is one. Integers may also be exact coordinates of a small figure.
double noise_of(const Working& work, bool closed, const Texture& texture, double rounding) {
  const double most = kMostUntold * core::polygon_length(work.points, closed);
  double estimate = std::min(texture.noise, most);
  if (work.points.size() >= kTelling && texture.noise > most) {
    estimate =
        std::max(estimate, noise_beyond_bends(work.points, closed, texture.stride, texture.noise));
  }
  if (work.points.size() < 8) return estimate;
  const double of_rounding = rounding / std::sqrt(12.0);
  return std::max(estimate,
                  shows(work, texture, rounding) ? of_rounding : std::min(of_rounding, most));
}

/// The different points in the curve's plane, in their order.
core::Result<Working> in_order(const RawCurve& raw, const AcquireOptions& options, KeyLine& line) {
  auto work = flatten(raw, options, line);
  if (!work) return work;
  note_plane(line, detail::extent_of(work->points));
  merge(*work, line);
  detail::put_in_order(*work, options, line);
  if (options.cancellation.stop_requested()) return core::fail(ErrorCode::cancelled, "cancelled");
  if (work->points.size() >= 2) return work;
  const bool one = raw.points.size() == 1;
  return core::fail(ErrorCode::bad_input,
                    one ? "a single point is no curve" : "all points are at the same place",
                    "give at least two different points");
}

}  // namespace

core::Result<KeyLine> acquire_key_line(const RawCurve& raw, const AcquireOptions& options) {
  if (const auto checked = detail::check_input(raw); !checked) {
    return std::unexpected(checked.error());
  }
  if (options.detail && !(*options.detail > 0 && std::isfinite(*options.detail)))
    return core::fail(ErrorCode::bad_input, "the detail is not a length",
                      "give a number greater than 0", "detail");
  KeyLine line;
  line.id = raw.id;
  line.report.notes = raw.notes;
  for (const std::string& what : raw.left_out) line.report.notes.push_back("left out: " + what);
  auto found = in_order(raw, options, line);
  if (!found) return std::unexpected(found.error());
  Working& work = *found;
  const Steps steps{estimate_rounding(raw), estimate_common_step(raw)};
  const std::size_t stride = noise_stride(work.points, false);
  const auto noise_now = [&](const Texture& texture) {
    line.rounding = rounding_of(work, texture, steps);
    return options.noise.value_or(noise_of(work, line.closed, texture, line.rounding));
  };
  const auto texture_now = [&] {
    return options.noise ? Texture{} : texture_of(work, line.closed, options);
  };
  const double noise = noise_now(texture_now());
  if (options.remove_outliers) drop_outliers(work, noise, stride, line);
  settle_ends(work, stride, noise, options, line);
  const Texture texture = texture_now();
  line.noise = noise_now(texture);
  if (!options.noise) note_texture(work, texture, options.detail.has_value(), line);
  if (options.find_corners) {
    line.corners = find_corners(work.points, line.closed, line.noise, options.corner_angle);
  }
  line.length = curve_length(work, line.closed, stride);
  line.points = std::move(work.points);
  line.weights = std::move(work.weights);
  line.sources = std::move(work.sources);
  return line;
}

}  // namespace keyline::acquire

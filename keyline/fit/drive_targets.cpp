#include "keyline/fit/drive_targets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "keyline/core/coordinate.h"
#include "keyline/curve/jet.h"
#include "keyline/numeric/monotone_cubic.h"
#include "keyline/numeric/roots.h"

namespace keyline::fit::detail {
namespace {

using core::cross;
using core::ErrorCode;
using core::Result;
using curve::Bezier2;
using curve::PiecewiseBezier;

constexpr int kFewTargets = 8;  ///< fewer than this in a piece are interpolated
constexpr int kAdded = 16;      ///< targets a piece then gets

/// Parameters inside a quintic where its curvature changes sign.
std::vector<double> inflections(const Bezier2& piece) {
  const auto bend = [&](double t) {
    const auto j = jet(piece, t);
    return cross(j.first, j.second);
  };
  double size = 0;
  for (std::size_t k = 1; k < piece.control.size(); ++k)
    size += core::distance(piece.control[k - 1], piece.control[k]);
  constexpr int kSteps = 64;
  const double flat = 1e-9 * size * size;
  std::vector<double> found;
  double last_t = 0;
  double last = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const double here = bend(t);
    if (std::abs(here) <= flat) continue;  // an inflection in an end is none inside
    if (last != 0 && (last < 0) != (here < 0)) {
      const auto root = numeric::bracketed_root(bend, last_t, t, 0);
      if (root && *root > 1e-6 && *root < 1 - 1e-6) found.push_back(*root);
    }
    last = here;
    last_t = t;
  }
  return found;
}

/// Whether the part from `from` to `to` still has the curvature of its piece: of one too short the
/// rounding of its control points hides it.
bool holds_curvature(const Bezier2& piece, double from, double to) {
  constexpr double kLost = 1e-3;  // of the largest: joints are held as G2 up to this
  const Bezier2 part = subcurve(piece, from, to);
  double most = 0;
  double off = 0;
  for (const double u : {0.0, 0.5, 1.0}) {
    const double kappa = curvature(jet(piece, from + u * (to - from)));
    most = std::max(most, std::abs(kappa));
    off = std::max(off, std::abs(curvature(jet(part, u)) - kappa));
  }
  return off <= kLost * most;
}

/// Where a piece is split, 0 and 1 included: at its inflections, but for those that would leave a
/// part too short. Of one beside an end the end alone is left, of two beside each other none.
std::vector<double> cuts_of(const Bezier2& piece) {
  std::vector<double> cuts = inflections(piece);
  cuts.insert(cuts.begin(), 0);
  cuts.push_back(1);
  for (std::size_t k = 0; cuts.size() > 2 && k + 1 < cuts.size();) {
    if (holds_curvature(piece, cuts[k], cuts[k + 1])) {
      ++k;
      continue;
    }
    if (k + 2 < cuts.size()) cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    if (k > 0) cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(k));
    k = 0;
  }
  return cuts;
}

}  // namespace

PiecewiseBezier split_pieces(const PiecewiseBezier& chain, std::vector<LocalTarget>& targets,
                             int& splits) {
  PiecewiseBezier out;
  std::vector<LocalTarget> moved;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const std::vector<double> cuts = cuts_of(chain.pieces[i]);
    splits += static_cast<int>(cuts.size()) - 2;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const bool last = k + 2 == cuts.size();
      for (const LocalTarget& t : targets)
        if (t.piece == i && t.u >= cuts[k] && (t.u < cuts[k + 1] || last))
          moved.push_back(
              {out.pieces.size(), (t.u - cuts[k]) / (cuts[k + 1] - cuts[k]), t.curvature});
      out.pieces.push_back(cuts.size() == 2 ? chain.pieces[i]
                                            : subcurve(chain.pieces[i], cuts[k], cuts[k + 1]));
    }
  }
  targets = std::move(moved);
  return out;
}

Result<std::vector<LocalTarget>> local_targets(std::vector<CurvatureTarget> targets,
                                               std::size_t pieces) {
  const auto bad = [](const std::string& what) {
    return core::fail(ErrorCode::bad_input, what, "give t from 0 to 1 and finite curvatures",
                      "target");
  };
  for (const CurvatureTarget& t : targets)
    if (!(t.t >= 0 && t.t <= 1) || !std::isfinite(t.curvature))
      return bad("a target lies outside the curve");
  for (const CurvatureTarget& t : targets)
    if (core::is_too_large(t.curvature)) return bad("a curvature is larger than 1e100");
  std::sort(targets.begin(), targets.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  const auto same = [](const auto& a, const auto& b) { return a.t == b.t; };
  if (std::adjacent_find(targets.begin(), targets.end(), same) != targets.end())
    return bad("two targets lie in one place");
  if (targets.size() < 2) return bad("there are fewer than two targets");
  std::vector<double> at;
  std::vector<double> wanted;
  for (const CurvatureTarget& t : targets) {
    at.push_back(t.t);
    wanted.push_back(t.curvature);
  }
  const double n = static_cast<double>(pieces);
  std::vector<LocalTarget> local;
  std::vector<int> count(pieces, 0);
  const auto add = [&](double t, double value) {
    const auto piece = std::min(static_cast<std::size_t>(t * n), pieces - 1);
    local.push_back({piece, t * n - static_cast<double>(piece), value});
    ++count[piece];
  };
  for (const CurvatureTarget& t : targets) add(t.t, t.curvature);
  for (std::size_t k = 0; k < pieces; ++k) {
    if (count[k] >= kFewTargets) continue;
    for (int i = 0; i < kAdded; ++i) {
      const double t = (static_cast<double>(k) + (i + 0.5) / kAdded) / n;
      if (t > targets.front().t && t < targets.back().t)
        add(t, numeric::monotone_cubic(at, wanted, t));
    }
  }
  return local;
}

std::vector<CurvatureTarget> over_all(const std::vector<LocalTarget>& targets, std::size_t pieces) {
  std::vector<CurvatureTarget> all;
  for (const LocalTarget& t : targets)
    all.push_back(
        {(static_cast<double>(t.piece) + t.u) / static_cast<double>(pieces), t.curvature});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  return all;
}

}  // namespace keyline::fit::detail

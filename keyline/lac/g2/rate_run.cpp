#include "keyline/lac/g2/rate_run.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/QR>

namespace keyline::lac::detail {
namespace {

using core::Vector2;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSteepest = 200;  ///< slopes beyond it are no curves anyone wants

/// How the slope of a part follows from its unknown: a part that begins, ends or inflects at
/// curvature 0 has one below 0, and -1 where its rate there counts.
enum class SlopeKind { any, negative, clothoid };

/// A row of pieces between two ends that stay, as parts that may change. Unknowns: a slope and the
/// logarithm of a length for each part, and for each joint between them its curvature, as the logit
/// of its share of what is left to the last curvature. Slopes are measured by what they do to the
/// part's rates, whose logarithms differ by (1 + alpha) ln(k1 / k0): of a part whose curvature
/// hardly grows the slope changes as readily as its length.
class Row {
 public:
  /// Which of the ends lie at a joint whose rate counts, and the curvature that the first joint may
  /// not pass.
  struct Ends {
    bool joined_before = false;
    bool joined_after = false;
    double low = 0;
    double high = 0;
  };
  Row(const Parts& start, const Ends& ends);

  Index unknowns() const { return 3 * parts_ - 1; }
  Index equations() const { return 3 + parts_ - 1; }
  VectorXd start() const { return start_; }
  bool is_held(Index unknown) const {
    return unknown < parts_ && kind_[static_cast<std::size_t>(unknown)] == SlopeKind::clothoid;
  }
  Parts parts(const VectorXd& x) const;

  /// Misses of end and direction, differences of the logarithms of the rates at the inner joints;
  /// then those of the rates at both ends.
  VectorXd values(const VectorXd& x) const;

 private:
  Ends ends_;
  double first_ = 0, last_ = 0;  ///< curvatures
  double length_ = 0;
  Vector2 chord_;
  double turning_ = 0;
  Index parts_ = 0;
  std::vector<SlopeKind> kind_;
  std::vector<double> growth_;  ///< what slopes are multiplied by
  VectorXd start_;
};

struct End {
  Vector2 chord;
  double turning = 0;
};
End end_of(const Parts& parts) {
  End end;
  for (const Piece& p : parts) {
    end.chord = end.chord + core::rotate_ccw(displacement(p, 1), end.turning);
    end.turning += total_turning(p);
  }
  return end;
}

Row::Row(const Parts& start, const Ends& ends)
    : ends_(ends),
      first_(start.front().curvature_start),
      last_(start.back().curvature_end),
      parts_(static_cast<Index>(start.size())) {
  const End end = end_of(start);
  chord_ = end.chord;
  turning_ = end.turning;
  start_ = VectorXd::Zero(unknowns());
  double low = ends.low;
  for (Index i = 0; i < parts_; ++i) {
    const Piece& p = start[static_cast<std::size_t>(i)];
    const bool zero = p.curvature_start * p.curvature_end <= 0;
    const bool held = (i == 0 && ends.joined_before && first_ == 0) ||
                      (i + 1 == parts_ && ends.joined_after && last_ == 0);
    kind_.push_back(held ? SlopeKind::clothoid : zero ? SlopeKind::negative : SlopeKind::any);
    const double growth = zero ? 1 : std::abs(std::log(p.curvature_end / p.curvature_start));
    growth_.push_back(std::max(growth, 1 / kSteepest));
    start_[i] = zero && !held ? std::log(-p.alpha) : p.alpha * growth_.back();
    start_[parts_ + i] = std::log(p.length);
    length_ += p.length;
    if (i == 0) continue;
    const double share = (p.curvature_start - low) / (ends.high - low);
    start_[2 * parts_ + i - 1] = std::log(share / (1 - share));
    low = p.curvature_start;
  }
}

Parts Row::parts(const VectorXd& x) const {
  Parts all(kind_.size());
  double before = first_;
  double low = ends_.low;
  for (Index i = 0; i < parts_; ++i) {
    Piece& p = all[static_cast<std::size_t>(i)];
    const SlopeKind kind = kind_[static_cast<std::size_t>(i)];
    const double slope = x[i] / growth_[static_cast<std::size_t>(i)];
    p.alpha = kind == SlopeKind::any ? slope : kind == SlopeKind::negative ? -std::exp(x[i]) : -1;
    p.length = std::exp(x[parts_ + i]);
    p.curvature_start = before;
    p.curvature_end = last_;
    if (i + 1 < parts_)
      p.curvature_end = low + (ends_.high - low) / (1 + std::exp(-x[2 * parts_ + i]));
    before = low = p.curvature_end;
  }
  return all;
}

double log_rate(const Piece& p, double t) { return std::log(std::abs(curvature_rate(p, t))); }

VectorXd Row::values(const VectorXd& x) const {
  const Parts all = parts(x);
  VectorXd v(equations() + 2);
  const End end = end_of(all);
  const Vector2 miss = (end.chord - chord_) / length_;
  v[0] = miss.x;
  v[1] = miss.y;
  v[2] = end.turning - turning_;
  for (std::size_t i = 1; i < all.size(); ++i)
    v[2 + static_cast<Index>(i)] = log_rate(all[i - 1], 1) - log_rate(all[i], 0);
  v[equations()] = log_rate(all.front(), 0);
  v[equations() + 1] = log_rate(all.back(), 1);
  return v;
}

/// A piece cut into parts to start from: joint j of n at (j / n)^skew of the length; an inflection
/// inside stays in the part with the end of smaller curvature.
Row cut_row(const Piece& given, const Cut& cut, bool joined_before, bool joined_after) {
  Row::Ends ends{joined_before, joined_after, given.curvature_start, given.curvature_end};
  const bool held =
      (joined_before && given.curvature_start == 0) || (joined_after && given.curvature_end == 0);
  const int n = cut.parts + (held ? 1 : 0);
  double from = 0, to = 1;
  if (given.curvature_start * given.curvature_end < 0) {
    const bool more_at_end = std::abs(given.curvature_end) >= std::abs(given.curvature_start);
    (more_at_end ? from : to) = inflection(given);
    (more_at_end ? ends.low : ends.high) = 0;
  }
  Parts parts;
  double before = 0;
  for (int j = 1; j <= n; ++j) {
    const double at =
        j == n ? 1 : std::lerp(from, to, std::pow(static_cast<double>(j) / n, cut.skew));
    parts.push_back(part(given, before, at));
    before = at;
  }
  for (std::size_t j = 1; j < parts.size(); ++j)
    parts[j].curvature_start = parts[j - 1].curvature_end;
  parts.front().curvature_start = given.curvature_start;
  parts.back().curvature_end = given.curvature_end;
  return Row(parts, ends);
}

/// All rows: what each misses, then the differences of the rates at the joints between them.
class RateRun {
 public:
  explicit RateRun(std::vector<Row> rows) : rows_(std::move(rows)) {
    for (const Row& row : rows_) {
      first_.push_back(unknowns_);
      unknowns_ += row.unknowns();
      equations_ += row.equations();
    }
    joints_ = equations_;
    equations_ += static_cast<Index>(rows_.size()) - 1;
  }

  VectorXd start() const {
    VectorXd x(unknowns_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      x.segment(first_[i], rows_[i].unknowns()) = rows_[i].start();
    return x;
  }

  VectorXd misses(const VectorXd& x) const {
    VectorXd all(equations_);
    Index row = 0;
    double rate_before = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Index n = rows_[i].equations();
      const VectorXd v = rows_[i].values(of_row(x, i));
      all.segment(row, n) = v.head(n);
      if (i > 0) all[joints_ + static_cast<Index>(i) - 1] = rate_before - v[n];
      rate_before = v[n + 1];
      row += n;
    }
    return all;
  }

  MatrixXd derivatives(const VectorXd& x) const {
    MatrixXd j = MatrixXd::Zero(equations_, unknowns_);
    Index row = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Index n = rows_[i].equations();
      for (Index k = 0; k < rows_[i].unknowns(); ++k) {
        if (rows_[i].is_held(k)) continue;
        const VectorXd by = derivative(i, of_row(x, i), k);
        const auto at = static_cast<Index>(i);
        j.col(first_[i] + k).segment(row, n) = by.head(n);
        if (i > 0) j(joints_ + at - 1, first_[i] + k) = -by[n];
        if (i + 1 < rows_.size()) j(joints_ + at, first_[i] + k) = by[n + 1];
      }
      row += n;
    }
    return j;
  }

  std::vector<Parts> parts(const VectorXd& x) const {
    std::vector<Parts> all;
    for (std::size_t i = 0; i < rows_.size(); ++i) all.push_back(rows_[i].parts(of_row(x, i)));
    return all;
  }

 private:
  VectorXd of_row(const VectorXd& x, std::size_t i) const {
    return x.segment(first_[i], rows_[i].unknowns());
  }
  VectorXd derivative(std::size_t i, VectorXd x, Index k) const {
    constexpr double kStep = 1e-5;
    const double at = x[k];
    x[k] = at + kStep;
    const VectorXd after = rows_[i].values(x);
    x[k] = at - kStep;
    return (after - rows_[i].values(x)) / (2 * kStep);
  }

  std::vector<Row> rows_;
  std::vector<Index> first_;
  Index unknowns_ = 0;
  Index equations_ = 0;
  Index joints_ = 0;  ///< first equation of the joints between rows
};

/// Of the steps with derivatives * step = miss the shortest. (Of nearly straight pieces the three
/// equations of the end are nearly one: normal equations would not do.)
VectorXd shortest(const MatrixXd& derivatives, const VectorXd& miss) {
  const Eigen::HouseholderQR<MatrixXd> qr(derivatives.transpose());
  const Index n = miss.size();
  VectorXd step = VectorXd::Zero(derivatives.cols());
  step.head(n) = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>().transpose().solve(miss);
  return qr.householderQ() * step;
}

constexpr double kNear = 1e-7;  ///< misses from which Newton's next step is exact to rounding
constexpr double kMet = 1e-9;   ///< what rounding may leave of the misses

/// Newton's method from x to near where the misses are `wanted`; of the steps that serve the
/// shortest, so that nothing moves without need. There are more unknowns than equations. Whether
/// it arrives is asked far above rounding: which way is gone must not hang on a last digit.
bool settle(const RateRun& run, const VectorXd& wanted, VectorXd& x) {
  double last = HUGE_VAL;
  for (int round = 0; round < 12; ++round) {
    const VectorXd miss = run.misses(x) - wanted;
    const double size = miss.cwiseAbs().maxCoeff();
    if (!miss.allFinite()) return false;
    if (size < kNear) return true;
    if (round > 4 && size > last) return false;
    last = size;
    const VectorXd step = shortest(run.derivatives(x), miss);
    const double longest = step.cwiseAbs().maxCoeff();
    if (!std::isfinite(longest) || longest > 20) return false;
    x -= std::min(1.0, 1.5 / longest) * step;
  }
  return false;
}

/// From near to exact.
bool polish(const RateRun& run, VectorXd& x) {
  for (int round = 0; round < 3; ++round) x -= shortest(run.derivatives(x), run.misses(x));
  const VectorXd miss = run.misses(x);
  return miss.allFinite() && miss.cwiseAbs().maxCoeff() < kMet;
}

bool is_sound(const std::vector<Parts>& all) {
  return std::all_of(all.begin(), all.end(), [](const Parts& parts) {
    return std::all_of(parts.begin(), parts.end(), [](const Piece& p) {
      return validate(p).has_value() && std::abs(p.alpha) <= kSteepest;
    });
  });
}

}  // namespace

namespace {

std::optional<std::vector<Parts>> solved(const RateRun& problem) {
  VectorXd x = problem.start();
  const VectorXd given = problem.misses(x);
  if (!given.allFinite()) return std::nullopt;
  // What is amiss at the start goes little by little: the rates at the joints draw near.
  double left = 1;
  for (double step = 0.5; left > 0;) {
    const double next = std::max(0.0, left - step);
    VectorXd moved = x;
    const bool met = settle(problem, next * given, moved);
    step *= met ? 1.6 : 0.4;
    if (step < 0.004) return std::nullopt;
    if (!met) continue;
    x = moved;
    left = next;
  }
  if (!polish(problem, x)) return std::nullopt;
  auto parts = problem.parts(x);
  if (!is_sound(parts)) return std::nullopt;
  return parts;
}

}  // namespace

std::optional<std::vector<Parts>> solve_rate_run(std::span<const Piece> run, const Cut& cut) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < run.size(); ++i)
    rows.push_back(cut_row(run[i], cut, i > 0, i + 1 < run.size()));
  return solved(RateRun(std::move(rows)));
}

std::optional<Parts> solve_free_run(std::span<const Piece> run) {
  const Parts start(run.begin(), run.end());
  const Row::Ends ends{false, false, run.front().curvature_start, run.back().curvature_end};
  auto parts = solved(RateRun({Row(start, ends)}));
  if (!parts) return std::nullopt;
  return std::move(parts->front());
}

}  // namespace keyline::lac::detail

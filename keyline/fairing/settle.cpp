#include "keyline/fairing/settle.h"

#include <algorithm>
#include <cmath>

#include "keyline/fairing/chain_weights.h"
#include "keyline/fairing/meet.h"

namespace keyline::fairing::detail {
namespace {

double cost_of(const std::vector<FitPoint>& points, const std::vector<double>& offsets) {
  double sum = 0;
  for (std::size_t j = 0; j < points.size(); ++j) sum += points[j].weight * offsets[j] * offsets[j];
  return sum;
}

/// The chain with one piece made a line or an arc; its neighbours are told they meet one.
FitChain with_kind(const FitChain& chain, int at, PieceKind kind) {
  FitChain next = chain;
  FitPiece& piece = next.pieces[at];
  piece.kind = kind;
  piece.alpha = -1;
  const auto set = [&](int joint, double curvature) {
    const int last = static_cast<int>(next.pieces.size());
    next.joints[joint].curvature = curvature;
    if (next.closed && joint == 0) next.joints[last].curvature = curvature;
    if (next.closed && joint == last) next.joints[0].curvature = curvature;
  };
  const double mean = 0.5 * (chain.joints[at].curvature + chain.joints[at + 1].curvature);
  set(at, kind == PieceKind::line ? 0 : mean);
  set(at + 1, kind == PieceKind::line ? 0 : mean);
  if (kind != PieceKind::line) return next;
  for (const int side : {at - 1, at + 1}) {
    const int n = static_cast<int>(next.pieces.size());
    if (!next.closed && (side < 0 || side >= n)) continue;
    FitPiece& neighbour = next.pieces[(side + n) % n];
    if (neighbour.kind == PieceKind::curve && !slope_held(neighbour))
      neighbour.alpha = std::clamp(neighbour.alpha, -3.0, -1.0);
  }
  return next;
}

bool touches_line(const FitChain& chain, int at) {
  const int n = static_cast<int>(chain.pieces.size());
  for (const int side : {at - 1, at + 1}) {
    if (!chain.closed && (side < 0 || side >= n)) continue;
    if (chain.pieces[(side + n) % n].kind != PieceKind::curve) return true;
  }
  return false;
}

/// About how far a piece departs from its chord, or from the arc of its length and turning.
double departure(const FitChain& chain, int at, PieceKind kind) {
  const double a = chain.joints[at].curvature;
  const double b = chain.joints[at + 1].curvature;
  const double length = chain.pieces[at].length;
  if (kind == PieceKind::arc) return std::abs(b - a) / 32 * length * length;
  // Not by its end curvatures: an S of slope near 0 loses them at once.
  const double alpha = chain.pieces[at].alpha;
  const lac::Piece piece{a * b <= 0 && alpha >= 0 ? -1 : alpha, length, a, b};
  const core::Vector2 chord = lac::displacement(piece, 1);
  double most = 0;
  for (const double t : {0.15, 0.3, 0.5, 0.7, 0.85})
    most = std::max(most, std::abs(core::cross(chord, lac::displacement(piece, t))));
  return most / std::max(core::norm(chord), 1e-3 * length);
}

/// Curves that a kind could stand in for at all: the departure is a few tolerances at most.
bool worth_trying(const FitChain& chain, int at, PieceKind kind, double tolerance) {
  return !touches_line(chain, at) && departure(chain, at, kind) < 3 * tolerance;
}

/// The chain with its pieces made lines or arcs, one after another.
class Straightener {
 public:
  Straightener(FitChain& chain, const std::vector<FitPoint>& points, const Acceptance& accept)
      : chain_(chain), points_(points), accept_(accept) {
    fit_.iterations = 25;
    fit_.gradient_tolerance = 1e-4;
    fit_.scale = accept.tolerance;
    cost_ = cost_of(points, offsets(chain, points));
  }

  int run() {
    int changed = 0;
    const int count = static_cast<int>(chain_.pieces.size());
    for (int at = 0; at < count; ++at) {
      if (become(at, PieceKind::line) || become(at, PieceKind::arc)) ++changed;
    }
    // An arc beside a piece that has since found its place may be a line after all.
    for (int at = 0; at < count; ++at)
      if (chain_.pieces[at].kind == PieceKind::arc) become(at, PieceKind::line);
    return changed;
  }

 private:
  bool become(int at, PieceKind kind) {
    if (!worth_trying(chain_, at, kind, accept_.tolerance)) return false;
    double here = 0;
    for (std::size_t j = 0; j < points_.size(); ++j)
      if (chain_.feet[j].piece == at) here += points_[j].weight;
    FitChain trial = with_kind(chain_, at, kind);
    const ChainFitReport report = fit_chain(trial, points_, fit_);
    const std::vector<double> found = offsets(trial, points_);
    const double after = cost_of(points_, found);
    const double allowed = 12 * accept_.noise * accept_.noise +
                           here * std::pow(0.05 * accept_.tolerance, 2) + 0.02 * cost_;
    if (after - cost_ > allowed || !accepts(accept_, report, points_, found)) return false;
    chain_ = std::move(trial);
    cost_ = after;
    return true;
  }

  FitChain& chain_;
  const std::vector<FitPoint>& points_;
  const Acceptance& accept_;
  ChainFitOptions fit_;
  double cost_ = 0;
};

}  // namespace

int straighten(FitChain& chain, const std::vector<FitPoint>& points, const Acceptance& accept) {
  if (chain.pieces.size() == 1 && chain.closed) return 0;
  return Straightener(chain, points, accept).run();
}

void flatten(FitChain& chain) {
  const std::size_t n = chain.pieces.size();
  const auto set = [&](std::size_t joint, double curvature) {
    chain.joints[joint].curvature = curvature;
    if (chain.closed && joint == 0) chain.joints[n].curvature = curvature;
    if (chain.closed && joint == n) chain.joints[0].curvature = curvature;
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (chain.pieces[i].kind == PieceKind::curve) continue;
    const double mean = 0.5 * (chain.joints[i].curvature + chain.joints[i + 1].curvature);
    const double curvature = chain.pieces[i].kind == PieceKind::line ? 0 : mean;
    set(i, curvature);
    set(i + 1, curvature);
    chain.pieces[i].alpha = -1;
  }
}

namespace {

/// Makes a chain fit for laying out: refined, then without gaps.
class Polisher {
 public:
  Polisher(FitChain& chain, std::vector<FitPoint>& points, const Acceptance& accept, bool exact)
      : chain_(chain), points_(points), accept_(accept), exact_(exact), best_(chain) {
    fit_.fine = true;
    fit_.scale = accept.tolerance;
  }

  bool run() {
    const FitChain rough = chain_;
    fit_.slope_prior = std::max(accept_.noise, 0.05 * accept_.tolerance) / (3 * accept_.tolerance);
    if (!exact_ && refine(60, 1e-9)) return true;
    fit_.slope_prior = 1e-5;
    for (const int iterations : {60, 6, 0}) {
      chain_ = rough;
      if (refine(iterations, iterations > 6 ? 1e-9 : 1e-3)) return true;
    }
    chain_ = rough;
    hold_loose_slopes();
    if (refine(60, 1e-9)) return true;
    chain_ = rough;
    const std::vector<FitPoint> original = points_;
    for (int round = 0; round < kPolishSqueezes; ++round) {
      weigh_up(points_, original, offsets(chain_, points_), accept_.tolerance, kPush);
      if (refine(10, 1e-3)) return true;
    }
    chain_ = best_;
    return false;
  }

 private:
  bool refine(int iterations, double gradient) {
    fit_.iterations = iterations;
    fit_.gradient_tolerance = gradient;
    fit_.close_gaps = false;
    if (iterations > 0) fit_chain(chain_, points_, fit_);
    fit_.close_gaps = true;
    fit_.iterations = 20;
    const ChainFitReport report = fit_chain(chain_, points_, fit_);
    if (report.max_gap < kClosedGap && report.max_offset < least_) {
      best_ = chain_;
      least_ = report.max_offset;
    }
    return report.max_gap < kClosedGap &&
           accepts(accept_, report, points_, offsets(chain_, points_));
  }

  /// Slopes beside an inflection or a straight to -1: others bend at the far end alone and leave
  /// the rest of the piece without a say in where it ends.
  void hold_loose_slopes() {
    for (std::size_t i = 0; i < chain_.pieces.size(); ++i) {
      FitPiece& piece = chain_.pieces[i];
      const double a = chain_.joints[i].curvature;
      const double b = chain_.joints[i + 1].curvature;
      const bool loose =
          std::min(std::abs(a), std::abs(b)) <= kLoose * std::max(std::abs(a), std::abs(b));
      if (piece.kind == PieceKind::curve && !slope_held(piece) && (a * b <= 0 || loose))
        hold_slope(piece, -1);
    }
  }

  static constexpr double kClosedGap = 1e-9;  // of the length: gaps that count as closed
  // Rounds of Lawson's weights, where points leave the tolerance.
  static constexpr int kPolishSqueezes = 8;
  // A point at the tolerance weighs twice as much after a round, one at 0.6 of it as much as
  // before.
  static constexpr numeric::Push kPush{0.4, 1.6};
  static constexpr double kLoose = 0.05;  // smaller over larger curvature

  FitChain& chain_;
  std::vector<FitPoint>& points_;
  const Acceptance& accept_;
  bool exact_;
  ChainFitOptions fit_;
  FitChain best_;
  double least_ = HUGE_VAL;
};

/// The chain laid out from its start, without regard to where it should end.
lac::Chain laid_forward(FitChain chain) {
  flatten(chain);
  lac::Chain out;
  out.start = {chain.joints.front().position, chain.joints.front().direction};
  out.closed = chain.closed;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const FitPiece& piece = chain.pieces[i];
    out.pieces.push_back(
        {piece.alpha, piece.length, chain.joints[i].curvature, chain.joints[i + 1].curvature});
  }
  if (out.closed) out.pieces.back().curvature_end = out.pieces.front().curvature_start;
  for (lac::Piece& piece : out.pieces) {
    const bool crosses = piece.curvature_start * piece.curvature_end <= 0;
    if (crosses && piece.alpha >= 0) piece.alpha = -1;
    if (piece.curvature_start == piece.curvature_end) piece.alpha = -1;
  }
  return out;
}

}  // namespace

bool polish(FitChain& chain, std::vector<FitPoint>& points, const Acceptance& accept, bool exact) {
  return Polisher(chain, points, accept, exact).run();
}

double turned(const FitChain& chain) {
  double sum = 0;
  for (const lac::Piece& piece : laid_forward(chain).pieces)
    sum += std::abs(lac::total_turning(piece));
  return sum;
}

lac::Chain lay_out(const FitChain& chain, const core::Similarity2& to_canonical, bool reversed) {
  lac::Chain out = laid_forward(chain);
  const FitJoint& last = chain.joints.back();
  if (out.closed) {
    meet_target(out, {out.start, true});
  } else if (chain.hold_end != Hold::free) {
    meet_target(out, {.pose = {last.position, last.direction},
                      .direction = chain.hold_end >= Hold::direction,
                      .start_direction_free = chain.hold_start < Hold::direction,
                      .start_curvature_free = chain.hold_start < Hold::curvature,
                      .end_curvature_free = chain.hold_end < Hold::curvature});
  }
  lac::Chain placed = transform(out, core::inverse(to_canonical));
  return reversed ? reverse(placed) : placed;
}

}  // namespace keyline::fairing::detail

#include <algorithm>
#include <cmath>

#include "keyline/analysis/rhythm.h"
#include "keyline/fairing/chain_edit.h"
#include "keyline/fairing/run.h"
#include "keyline/fairing/settle.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kZeroBand = analysis::RhythmOptions{}.zero_band;  // slopes nearer 0 read as zero

std::string piece_name(int piece) { return "piece " + std::to_string(piece); }

void limit_slope(FitPiece& piece, double low, double high) {
  piece.alpha_low = low;
  piece.alpha_high = high;
  const double start = std::clamp(piece.alpha, std::max(low, -3.0), std::min(high, 3.0));
  piece.alpha = low == high ? low : std::clamp(start, low, high);
}

/// Two slopes in one piece, plus or minus first along growing radius.
void make_compound(FitChain& chain, int at, bool plus_first) {
  chain.pieces[at].kind = PieceKind::curve;
  chain = with_joint(chain, at, 0.5);
  const bool radius_grows =
      std::abs(chain.joints[at].curvature) > std::abs(chain.joints[at + 2].curvature);
  const int plus = (plus_first == radius_grows) ? at : at + 1;
  limit_slope(chain.pieces[plus], kZeroBand, kSteepestSlope);
  limit_slope(chain.pieces[plus == at ? at + 1 : at], -kSteepestSlope, -kZeroBand);
}

bool touches_inflection(const FitChain& chain, int at) {
  const double a = chain.joints[at].curvature;
  const double b = chain.joints[at + 1].curvature;
  if (a * b <= 0) return true;
  const auto near = [](double x, double y) { return std::abs(x) < 1e-3 * std::abs(y); };
  return near(a, b) || near(b, a);
}

void make_kind(FitChain& chain, int at, PieceKind kind) {
  FitPiece& piece = chain.pieces[at];
  piece.kind = kind;
  piece.alpha = -1;
  const double mean = 0.5 * (chain.joints[at].curvature + chain.joints[at + 1].curvature);
  const double value = kind == PieceKind::line ? 0 : mean;
  chain.joints[at].curvature = value;
  chain.joints[at + 1].curvature = value;
  if (chain.closed && at == 0) chain.joints.back().curvature = value;
  if (chain.closed && at + 1 == static_cast<int>(chain.pieces.size()))
    chain.joints.front().curvature = value;
}

/// False, and a note, where it cannot be.
bool apply(FitChain& chain, const PieceWish& wish, int at, std::vector<std::string>& notes) {
  if (wish.kind) {
    make_kind(chain, at, *wish.kind);
    return true;
  }
  FitPiece& piece = chain.pieces[at];
  if (piece.kind != PieceKind::curve) piece.kind = PieceKind::curve;
  if (touches_inflection(chain, at) && (wish.compound || wish.alpha_low > -0.25)) {
    notes.push_back(piece_name(wish.piece) +
                    ": it meets an inflection or a straight line, which needs a slope below 0; "
                    "the reading asked for was not used");
    return false;
  }
  if (wish.compound) {
    make_compound(chain, at, wish.plus_first);
    return true;
  }
  limit_slope(piece, wish.alpha_low, wish.alpha_high);
  return true;
}

/// The wishes' pieces in the chain that follows them.
std::vector<int> pieces_after(std::vector<PieceWish> followed) {
  std::ranges::sort(followed, {}, &PieceWish::piece);
  std::vector<int> pieces;
  int more = 0;
  for (const PieceWish& wish : followed) {
    pieces.push_back(wish.piece + more);
    if (!wish.compound) continue;
    ++more;
    pieces.push_back(wish.piece + more);
  }
  return pieces;
}

}  // namespace

std::vector<int> apply_wishes(RunResult& result, const Run& run, std::vector<PieceWish> wishes,
                              const RunOptions& options, std::vector<std::string>& notes) {
  std::sort(wishes.begin(), wishes.end(),
            [](const PieceWish& a, const PieceWish& b) { return a.piece > b.piece; });
  const int n = static_cast<int>(result.fit.pieces.size());
  // Later pieces first, so that a split piece does not move the others' indices; a run laid out
  // backwards counts from the other end.
  if (result.reversed) std::reverse(wishes.begin(), wishes.end());
  std::vector<PieceWish> followed;
  for (const PieceWish& wish : wishes)
    if (apply(result.fit, wish, result.reversed ? n - 1 - wish.piece : wish.piece, notes))
      followed.push_back(wish);
  result.accept = {options.tolerance / run.length, options.noise / run.length};
  const Acceptance& accept = result.accept;
  ChainFitOptions fit;
  fit.scale = accept.tolerance;
  fit.iterations = 80;
  fit.gradient_tolerance = 1e-6;
  fit_chain(result.fit, result.points, fit);
  result.within_tolerance = polish(result.fit, result.points, accept, result.exact);
  result.chain = lay_out(result.fit, result.to_canonical, result.reversed);
  return pieces_after(std::move(followed));
}

}  // namespace keyline::fairing::detail

#include "keyline/fairing/reading.h"

#include <algorithm>
#include <cmath>

#include "keyline/analysis/rhythm.h"
#include "keyline/analysis/volume.h"
#include "keyline/numeric/parallel.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kZeroBand = analysis::RhythmOptions{}.zero_band;  // slopes nearer 0 read as zero
constexpr int kTelling = 5;       // points: as many as a reading of two lines has parameters
constexpr double kToldSlope = 1;  // standard deviation: a slope less known might be any of the five
constexpr double kSeen = 0.02;    // of the whole: a centimetre of a drawing half a metre long
constexpr int kProfileSamples = 101;  // of a piece at equal steps of its length

bool is_flat(const lac::Piece& p) { return p.curvature_start == p.curvature_end; }
bool is_s(const lac::Piece& p) { return p.curvature_start * p.curvature_end < 0; }

/// The most plausible reading is the piece's: its own slope where that is the same rhythm. Points
/// that a line or an arc would do for do not tell how a piece bends that its neighbours make bend.
void take_reading(FairPiece& piece) {
  const analysis::Interpretation& best = piece.interpretations.front();
  const auto sure = [](double error) { return error <= kToldSlope; };
  piece.told = !best.slopes.empty() && std::ranges::all_of(best.slope_errors, sure);
  if (best.slopes.empty() || (best.rhythm == piece.rhythm && best.slopes.size() == 1)) return;
  piece.rhythm = best.rhythm;
  piece.slopes = best.slopes;
}

void read_piece(FairPiece& piece, const lac::Piece& shape, const lac::Segment& segment) {
  if (is_s(shape) || piece.points < kTelling) return;
  analysis::RhythmOptions options;
  options.noise = piece.noise;
  options.observations = piece.points;
  const auto profile = analysis::curvature_profile(lac::chain_of(segment), kProfileSamples);
  const auto reading = analysis::classify_rhythm(profile, options);
  if (!reading) return;
  piece.interpretations = reading->interpretations;
  if (!piece.overridden && !is_flat(shape)) take_reading(piece);
}

}  // namespace

analysis::Rhythm rhythm_of(const lac::Piece& piece) {
  using analysis::Rhythm;
  if (piece.curvature_start == 0 && piece.curvature_end == 0) return Rhythm::straight;
  if (piece.curvature_start == piece.curvature_end) return Rhythm::arc;
  if (std::abs(piece.alpha) <= kZeroBand) return Rhythm::zero;
  return piece.alpha < 0 ? Rhythm::minus : Rhythm::plus;
}

std::vector<FairPiece> pieces_of(const lac::Chain& chain, double noise,
                                 const std::vector<int>& points_per_piece,
                                 const std::vector<int>& asked) {
  std::vector<FairPiece> pieces;
  double start = 0;
  const std::vector<lac::Segment> segments = lac::segments(chain);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    FairPiece piece;
    piece.piece = static_cast<int>(i);
    piece.start = start;
    piece.length = segments[i].length;
    piece.rhythm = rhythm_of(chain.pieces[i]);
    if (piece.rhythm != analysis::Rhythm::straight && piece.rhythm != analysis::Rhythm::arc)
      piece.slopes = {segments[i].alpha};
    piece.volume = analysis::volume(lac::chain_of(segments[i]));
    piece.points = points_per_piece[i];
    piece.noise = noise;
    piece.overridden = std::ranges::count(asked, piece.piece) > 0;
    piece.told = piece.overridden || is_flat(chain.pieces[i]) || piece.points >= kTelling;
    start += piece.length;
    pieces.push_back(std::move(piece));
  }
  for (FairPiece& piece : pieces) piece.seen = piece.length >= kSeen * start;
  return pieces;
}

void read_pieces(std::span<FairPiece> pieces, const lac::Chain& chain, int threads,
                 const core::Progress& progress) {
  const std::vector<lac::Segment> segments = lac::segments(chain);
  numeric::parallel_for(pieces.size(), threads, [&](std::size_t i) {
    if (!progress.stop_requested()) read_piece(pieces[i], chain.pieces[i], segments[i]);
  });
}

void read_pieces(FairResult& result, int threads, const core::Progress& progress) {
  for (std::span<FairPiece> rest = result.pieces; !rest.empty();) {
    const int curve = rest.front().curve;
    const auto last = std::find_if(rest.begin(), rest.end(),
                                   [&](const FairPiece& p) { return p.curve != curve; });
    const auto count = static_cast<std::size_t>(last - rest.begin());
    read_pieces(rest.first(count),
                std::get<lac::Chain>(result.curves[static_cast<std::size_t>(curve)]), threads,
                progress);
    rest = rest.subspan(count);
  }
}

core::Result<PieceWish> wish_for(const InterpretationOverride& asked, int piece_in_chain) {
  using analysis::Rhythm;
  PieceWish wish;
  wish.piece = piece_in_chain;
  if (asked.slope) {
    if (!(std::abs(*asked.slope) <= kSteepestSlope))
      return core::fail(core::ErrorCode::bad_input, "the slope is out of range",
                        "give a slope between -12 and 12", "interpretation");
    wish.alpha_low = wish.alpha_high = *asked.slope;
    return wish;
  }
  switch (*asked.rhythm) {
    case Rhythm::straight:
      wish.kind = PieceKind::line;
      break;
    case Rhythm::arc:
      wish.kind = PieceKind::arc;
      break;
    case Rhythm::minus:
      wish.alpha_high = -kZeroBand;
      break;
    case Rhythm::zero:
      wish.alpha_low = wish.alpha_high = 0;
      break;
    case Rhythm::plus:
      wish.alpha_low = kZeroBand;
      break;
    case Rhythm::plus_minus:
    case Rhythm::minus_plus:
      wish.compound = true;
      wish.plus_first = *asked.rhythm == Rhythm::plus_minus;
      break;
    case Rhythm::arcs:
      return core::fail(core::ErrorCode::unsupported,
                        "arcs joined end to end are not G2 and no chain can be made of them",
                        "ask for arc, minus, zero, plus, plus+minus or minus+plus",
                        "interpretation");
  }
  return wish;
}

}  // namespace keyline::fairing::detail

#include "keyline/presentation/fair_marks.h"

#include <algorithm>
#include <cmath>

#include "keyline/fairing/fairness.h"

namespace keyline::presentation::detail {
namespace {

constexpr double kSameSlope = 1e-6;

bool is_limit(double slope, core::Interval slopes) {
  return slope <= slopes.low + kSameSlope || slope >= slopes.high - kSameSlope;
}

/// Whether the chain's own slope is a limit; arcs and lines have none.
bool at_limit(const fairing::FairResult& result, const fairing::FairPiece& piece,
              core::Interval slopes) {
  const auto* chain =
      std::get_if<lac::Chain>(&result.curves[static_cast<std::size_t>(piece.curve)]);
  if (!chain || piece.overridden) return false;
  const lac::Piece& shape = chain->pieces[static_cast<std::size_t>(piece.piece)];
  return shape.curvature_start != shape.curvature_end && is_limit(shape.alpha, slopes);
}

std::size_t sample_at(const figure::SampledCurve& sampled, double s) {
  const auto& at = sampled.arc_length;
  const auto found = std::lower_bound(at.begin(), at.end(), s);
  return found == at.end() ? at.size() - 1 : static_cast<std::size_t>(found - at.begin());
}

}  // namespace

std::vector<PieceMarks> piece_marks(const fairing::FairResult& result, core::Interval slopes) {
  std::vector<PieceMarks> marks;
  for (const fairing::FairPiece& piece : result.pieces)
    marks.push_back({0, 0, !piece.seen, at_limit(result, piece, slopes)});
  for (const analysis::CombMark& mark : fairing::comb_marks(result)) {
    const auto after = std::find_if(result.pieces.begin(), result.pieces.end(),
                                    [&](const auto& piece) { return piece.start > mark.at; });
    if (after == result.pieces.begin()) continue;
    PieceMarks& of = marks[static_cast<std::size_t>(after - result.pieces.begin()) - 1];
    ++(mark.needle ? of.needles : of.near_steps);
  }
  return marks;
}

std::string marks_text(const PieceMarks& marks) {
  std::string text;
  const auto add = [&text](bool is, const std::string& what) {
    if (is) text += (text.empty() ? "" : ", ") + what;
  };
  const auto counted = [](int n, const std::string& what) {
    return n == 1 ? what : std::to_string(n) + " " + what + "s";
  };
  add(marks.needles > 0, counted(marks.needles, "needle"));
  add(marks.near_steps > 0, counted(marks.near_steps, "near-step"));
  add(marks.too_short, "too short to see");
  add(marks.at_limit, "slope at its limit");
  return text;
}

void add_marks(figure::SampledCurve& sampled, const fairing::FairResult& result,
               core::Interval slopes) {
  if (sampled.points.empty()) return;
  for (const analysis::CombMark& mark : fairing::comb_marks(result))
    sampled.marks.push_back({sample_at(sampled, mark.at), mark.needle ? "n" : "s"});
  const std::vector<PieceMarks> pieces = piece_marks(result, slopes);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::size_t middle =
        sample_at(sampled, result.pieces[i].start + 0.5 * result.pieces[i].length);
    if (pieces[i].too_short) sampled.marks.push_back({middle, "t"});
    if (pieces[i].at_limit) sampled.marks.push_back({middle, "l"});
  }
}

}  // namespace keyline::presentation::detail

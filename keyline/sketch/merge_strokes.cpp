#include "keyline/sketch/merge_strokes.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "keyline/sketch/polyline_tools.h"
#include "keyline/sketch/stroke_grid.h"
#include "keyline/sketch/turn_backs.h"

namespace keyline::sketch {
namespace {

constexpr double kBeside = 1.5;  ///< widths: a line farther off does not explain a pass's ink

/// A line of several strokes, as wide as they are on average.
FineStroke line_of(const MeantLine& line, const std::vector<FineStroke>& strokes, double width) {
  FineStroke fine;
  fine.closed = line.closed;
  for (const std::size_t m : line.members) {
    fine.width += strokes[m].width / static_cast<double>(line.members.size());
    if (fine.members.empty() || fine.members.back() != strokes[m].members.front())
      fine.members.push_back(strokes[m].members.front());
  }
  resample(line.points, std::vector<double>(line.points.size(), fine.width), kStrokeStep * width,
           line.closed, fine.points, fine.widths);
  return fine;
}

/// By stroke, where it is cut: points at which the hand turned back along the same line.
using Cuts = std::vector<std::vector<std::size_t>>;

Cuts cuts_of(const std::vector<FineStroke>& strokes, const ConsolidateOptions& passes,
             const GroupWishes& wishes) {
  Cuts cuts(strokes.size());
  if (passes.measured) return cuts;  // of a picture: shapes have narrow tips, the pen may be lifted
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const FineStroke& s = strokes[i];
    if (s.closed || std::ranges::find(wishes.keep, s.members.front()) != wishes.keep.end())
      continue;
    cuts[i] = turn_backs(s.points, {passes.width, passes.apart, passes.hand, passes.angle});
  }
  return cuts;
}

std::vector<FineStroke> pieces_of(const std::vector<FineStroke>& strokes, const Cuts& cuts) {
  std::vector<FineStroke> pieces;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    std::size_t from = 0;
    for (std::size_t k = 0; k <= cuts[i].size(); ++k) {
      const bool last = k == cuts[i].size();
      const std::size_t to = last ? strokes[i].points.size() - 1 : cuts[i][k];
      const auto part = [from, to](const auto& all) {
        return std::decay_t<decltype(all)>(all.begin() + static_cast<std::ptrdiff_t>(from),
                                           all.begin() + static_cast<std::ptrdiff_t>(to) + 1);
      };
      FineStroke piece = strokes[i];
      piece.points = part(strokes[i].points);
      piece.widths = part(strokes[i].widths);
      pieces.push_back(std::move(piece));
      from = to;
    }
  }
  return pieces;
}

/// Takes cuts back of which the two sides did not become one line; true if there were some.
bool take_back(Cuts& cuts, const std::vector<MeantLine>& lines) {
  std::size_t pieces = 0;
  for (const auto& of_stroke : cuts) pieces += of_stroke.size() + 1;
  std::vector<std::size_t> line_of_piece(pieces, lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (const std::size_t piece : lines[l].members) line_of_piece[piece] = l;
  bool any = false;
  std::size_t piece = 0;
  for (auto& of_stroke : cuts) {
    const std::size_t first = piece;
    piece += of_stroke.size() + 1;
    std::vector<std::size_t> good;
    for (std::size_t k = 0; k < of_stroke.size(); ++k)
      if (line_of_piece[first + k] == line_of_piece[first + k + 1]) good.push_back(of_stroke[k]);
    any |= good.size() < of_stroke.size();
    of_stroke = std::move(good);
  }
  return any;
}

/// The lines of strokes, which are cut into their passes for that.
std::vector<MeantLine> lines_of_passes(std::vector<FineStroke>& strokes, ConsolidateOptions passes,
                                       const GroupWishes& wishes) {
  Cuts cuts = cuts_of(strokes, passes, wishes);
  while (true) {
    std::vector<FineStroke> pieces = pieces_of(strokes, cuts);
    std::vector<DrawnStroke> drawn;
    std::vector<std::size_t> numbers;
    for (const FineStroke& s : pieces) {
      drawn.push_back({s.points, s.closed});
      numbers.push_back(s.members.front());
    }
    passes.wishes = wishes_among(wishes, numbers);
    std::vector<MeantLine> lines = consolidate(drawn, passes);
    if (take_back(cuts, lines)) continue;
    strokes = std::move(pieces);
    return lines;
  }
}

/// Parts a stroke's points by whether they lie within `near` of a line.
void part_by_distance(const FineStroke& line, const FineStroke& stroke, double near,
                      Merged& merged) {
  FineStroke none = stroke;
  none.points.clear();
  none.widths.clear();
  merged.passes.push_back(none);
  merged.far.push_back(std::move(none));
  const std::vector<SampledStroke> sampled{sample_stroke(line.points, line.closed, near / 4)};
  const StrokeGrid grid(sampled, near);
  for (std::size_t i = 0; i < stroke.points.size(); ++i) {
    bool beside = false;
    grid.visit(stroke.points[i], near, [&](std::size_t, std::size_t) { beside = true; });
    FineStroke& part = beside ? merged.passes.back() : merged.far.back();
    part.points.push_back(stroke.points[i]);
    part.widths.push_back(stroke.widths[i]);
  }
}

}  // namespace

Merged merge(std::vector<FineStroke>& strokes, double width, const ConsolidateOptions& passes,
             const GroupWishes& wishes, std::vector<std::string>& notes) {
  std::vector<FineStroke> lines;
  std::vector<std::vector<std::size_t>> members;
  Merged merged;
  for (const MeantLine& line : lines_of_passes(strokes, passes, wishes)) {
    merged.explained += line.explained;
    const bool alone = line.members.size() == 1;
    lines.push_back(alone ? strokes[line.members.front()] : line_of(line, strokes, width));
    members.push_back(lines.back().members);
    if (alone) continue;
    for (const std::size_t m : line.members)
      part_by_distance(lines.back(), strokes[m], kBeside * width, merged);
  }
  for (std::string& note : unmet_joins(wishes, members)) notes.push_back(std::move(note));
  strokes = std::move(lines);
  return merged;
}

}  // namespace keyline::sketch

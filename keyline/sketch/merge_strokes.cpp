#include "keyline/sketch/merge_strokes.h"

#include <algorithm>
#include <utility>

#include "keyline/core/polygon.h"
#include "keyline/sketch/polyline_tools.h"

namespace keyline::sketch {
namespace {

/// A line of several strokes, as wide as they are on average.
FineStroke line_of(const MeantLine& line, const std::vector<FineStroke>& strokes, double width) {
  FineStroke fine;
  fine.closed = line.closed;
  for (const std::size_t m : line.members) {
    fine.width += strokes[m].width / static_cast<double>(line.members.size());
    fine.members.insert(fine.members.end(), strokes[m].members.begin(), strokes[m].members.end());
  }
  resample(line.points, std::vector<double>(line.points.size(), fine.width), kStrokeStep * width,
           line.closed, fine.points, fine.widths);
  return fine;
}

}  // namespace

Merged merge(std::vector<FineStroke>& strokes, double width, ConsolidateOptions passes,
             const GroupWishes& wishes, std::vector<std::string>& notes) {
  std::vector<DrawnStroke> drawn;
  std::vector<std::size_t> numbers;
  for (const FineStroke& s : strokes) {
    drawn.push_back({s.points, s.closed});
    numbers.push_back(s.members.front());
  }
  passes.wishes = wishes_among(wishes, numbers);
  std::vector<FineStroke> lines;
  std::vector<std::vector<std::size_t>> members;
  Merged merged;
  double beside = 0;
  double length = 0;
  for (const MeantLine& line : consolidate(drawn, passes)) {
    merged.explained += line.explained;
    const bool alone = line.members.size() == 1;
    lines.push_back(alone ? strokes[line.members.front()] : line_of(line, strokes, width));
    members.push_back(lines.back().members);
    if (alone) continue;
    beside += line.explained;
    for (const std::size_t m : line.members) {
      length += core::polygon_length(strokes[m].points, strokes[m].closed);
      merged.passes.push_back(strokes[m]);
    }
  }
  if (length > 0) merged.beside = std::min(1.0, beside / length);
  for (std::string& note : unmet_joins(wishes, members)) notes.push_back(std::move(note));
  strokes = std::move(lines);
  return merged;
}

}  // namespace keyline::sketch

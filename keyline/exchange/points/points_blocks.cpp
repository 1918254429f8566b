#include "keyline/exchange/points/points_blocks.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>

#include "keyline/core/point.h"
#include "keyline/core/text.h"

namespace keyline::exchange::detail {
namespace {

using acquire::RawCurve;
using core::Point3;

struct Block {
  std::size_t begin = 0;
  std::size_t end = 0;
  BlankLines before;  ///< those that part it from the block before

  std::size_t size() const { return end - begin; }
};

std::vector<Block> blocks_of(const RawCurve& curve, const std::vector<BlankLines>& blanks) {
  std::vector<Block> blocks{{0, 0, {}}};
  auto blank = blanks.begin();
  for (std::size_t i = 0; i < curve.source_lines.size(); ++i) {
    BlankLines before;
    for (; blank != blanks.end() && blank->first < curve.source_lines[i]; ++blank) {
      if (before.count == 0) before.first = blank->first;
      before.count += blank->count;
    }
    if (i > 0 && before.count > 0) blocks.push_back({i, i, before});
    blocks.back().end = i + 1;
  }
  return blocks;
}

/// Whether a curve goes on from the last point of one block to the first of the next: a step less
/// than those before and behind it together, and not back. A block of one point steps as the other.
bool goes_on(std::span<const Point3> before, std::span<const Point3> behind) {
  const auto returns = [](std::span<const Point3> b) {
    return b.size() > 1 && b.front() == b.back();
  };
  if (returns(before) || returns(behind)) return false;
  const core::Vector3 step = behind.front() - before.back();
  if (norm(step) == 0) return true;
  const bool two = behind.size() > 1;
  const core::Vector3 next = two ? behind[1] - behind.front() : step;
  const core::Vector3 last = before.size() > 1 ? before.back() - before[before.size() - 2] : next;
  const core::Vector3 first = two ? next : last;
  return norm(step) < norm(last) + norm(first) && dot(step, last) > 0 && dot(step, first) > 0;
}

/// Whether the blocks are one curve in whose rows blank lines stand.
bool are_one(const RawCurve& curve, const std::vector<Block>& blocks) {
  const std::span<const Point3> points(curve.points);
  const auto of = [&](const Block& b) { return points.subspan(b.begin, b.size()); };
  for (std::size_t i = 1; i < blocks.size(); ++i)
    if (blocks[i].before.count > 1 || !goes_on(of(blocks[i - 1]), of(blocks[i]))) return false;
  return true;
}

RawCurve part_of(const RawCurve& whole, const Block& block) {
  RawCurve part;
  part.has_z = whole.has_z;
  part.notes = whole.notes;
  const auto take = [&](auto& to, const auto& from) {
    if (from.empty()) return;
    to.assign(from.begin() + static_cast<std::ptrdiff_t>(block.begin),
              from.begin() + static_cast<std::ptrdiff_t>(block.end));
  };
  take(part.points, whole.points);
  take(part.weights, whole.weights);
  take(part.source_lines, whole.source_lines);
  return part;
}

}  // namespace

void part_blocks(std::vector<RawCurve>& curves, const std::vector<BlankLines>& blanks,
                 std::vector<std::string>& left_out) {
  const std::vector<Block> blocks = blocks_of(curves.front(), blanks);
  std::vector<Block> lines;
  std::copy_if(blocks.begin(), blocks.end(), std::back_inserter(lines), [&](const Block& b) {
    const auto points = std::span(curves.front().points).subspan(b.begin, b.size());
    return std::ranges::any_of(points, [&](Point3 p) { return p != points.front(); });
  });
  if (blocks.size() < 2 || lines.empty()) return;
  const bool lone = lines.size() < blocks.size();
  if (lines.size() == 1 || are_one(curves.front(), blocks)) {
    left_out.push_back("line " + std::to_string(blocks[1].before.first) + ": " +
                       (blocks.size() > 2 ? "this and other blank lines" : "a blank line") +
                       " among the rows, which are taken for one curve" +
                       (lone ? ", as one stands by itself" : ""));
    return;
  }
  if (lone)
    left_out.push_back(core::counted(blocks.size() - lines.size(), "point that stands alone",
                                     "points that stand alone") +
                       " among blank lines that part the rows into curves");
  const RawCurve whole = std::exchange(curves, {}).front();
  for (const Block& block : lines) {
    curves.push_back(part_of(whole, block));
    const std::string& name = whole.id;
    if (!name.empty())
      curves.back().id = curves.size() == 1 ? name : name + "#" + std::to_string(curves.size());
    curves.back().notes.push_back("blank lines part the rows into " +
                                  core::counted(lines.size(), "curve"));
  }
}

}  // namespace keyline::exchange::detail

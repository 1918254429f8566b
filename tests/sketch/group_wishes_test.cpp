#include "keyline/sketch/group_wishes.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/sketch/consolidate.h"
#include "keyline/sketch/trace.h"

namespace keyline::sketch {
namespace {

using Sets = std::vector<std::vector<std::size_t>>;

DrawnStroke level(double from, double to, double y) {
  DrawnStroke stroke;
  for (int i = 0; i <= 50; ++i) stroke.points.push_back({from + (to - from) * i / 50, y});
  return stroke;
}

/// Three passes of one line, and another line far away.
std::vector<DrawnStroke> three_passes() {
  return {level(0, 100, 0), level(0, 100, 0.5), level(0, 100, 1), level(0, 100, 40)};
}

Sets groups(const std::vector<DrawnStroke>& strokes, const GroupWishes& wishes) {
  Sets members;
  for (const MeantLine& line : consolidate(strokes, {.width = 1, .wishes = wishes}))
    members.push_back(line.members);
  return members;
}

TEST(GroupWishes, StandAboveTheEvidence) {
  EXPECT_EQ(groups(three_passes(), {}), (Sets{{0, 1, 2}, {3}}));
  EXPECT_EQ(groups(three_passes(), {{1}, {}, {}}), (Sets{{0, 2}, {1}, {3}}));
  EXPECT_EQ(groups(three_passes(), {{}, {}, {{0, 1, 2}}}), (Sets{{0}, {1}, {2}, {3}}));
  for (const auto& group : groups(three_passes(), {{}, {}, {{0, 2}}}))
    EXPECT_FALSE(std::ranges::count(group, 0U) && std::ranges::count(group, 2U));
}

// Two dashes that no evidence puts together: the gap is five widths of the pen.
TEST(GroupWishes, JoinWhatLiesApart) {
  const std::vector<DrawnStroke> dashes = {level(0, 100, 0), level(105, 205, 0)};
  ASSERT_EQ(groups(dashes, {}), (Sets{{0}, {1}}));
  EXPECT_EQ(groups(dashes, {{}, {{0, 1}}, {}}), (Sets{{0, 1}}));
}

// A line between two lines would lie on neither: they stay as they are, and that is said.
TEST(GroupWishes, SayWhatCannotBeJoined) {
  TraceOptions options;
  options.consolidate = true;
  options.wishes.join = {{0, 3}};
  const auto result = trace_strokes(three_passes(), 1, options);
  ASSERT_TRUE(result) << result.error().message;
  for (const Stroke& stroke : result->strokes)
    EXPECT_FALSE(std::ranges::count(stroke.members, 0U) && std::ranges::count(stroke.members, 3U));
  ASSERT_EQ(result->notes.size(), 1U);
  EXPECT_NE(result->notes[0].find("strokes 0, 3"), std::string::npos) << result->notes[0];
}

TEST(GroupWishes, ContradictionsAreRefused) {
  EXPECT_TRUE(check_wishes({{3}, {{0, 1}, {1, 2}}, {{2, 3}}}, 4));
  const std::vector<std::pair<GroupWishes, std::string>> bad = {
      {{{4}, {}, {}}, "keep[0]"},           {{{}, {{0, 4}}, {}}, "join[0]"},
      {{{}, {{0, 1}, {2}}, {}}, "join[1]"}, {{{}, {}, {{1, 1}}}, "split[0]"},
      {{{0}, {{0, 1}}, {}}, "keep[0]"},     {{{}, {{0, 1}, {1, 2}}, {{0, 2}}}, "split[0]"},
  };
  for (const auto& [wishes, path] : bad) {
    const auto result = check_wishes(wishes, 4);
    ASSERT_FALSE(result) << path;
    EXPECT_EQ(result.error().code, core::ErrorCode::bad_input);
    EXPECT_EQ(result.error().path, path);
  }
}

}  // namespace
}  // namespace keyline::sketch

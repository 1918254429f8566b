#include "keyline/sketch/group_wishes.h"

#include <algorithm>
#include <set>

#include "keyline/core/disjoint_sets.h"

namespace keyline::sketch {
namespace {

using core::ErrorCode;
using core::Result;

/// Lengths of overlap: no drawing has as many, and sums of them stay exact in a double.
constexpr double kAboveAll = 1e9;

std::unexpected<core::Failure> wrong(const char* field, std::size_t set, const std::string& what,
                                     const std::string& hint) {
  return core::fail(ErrorCode::bad_input, what, hint,
                    std::string(field) + "[" + std::to_string(set) + "]");
}

Result<void> check_sets(const char* field, const std::vector<std::vector<std::size_t>>& sets,
                        std::size_t count) {
  for (std::size_t k = 0; k < sets.size(); ++k) {
    if (sets[k].size() < 2)
      return wrong(field, k, "one stroke is no set", "give the numbers of two strokes and more");
    if (std::set<std::size_t>(sets[k].begin(), sets[k].end()).size() < sets[k].size())
      return wrong(field, k, "a stroke stands twice in the set", "name it once");
    for (const std::size_t n : sets[k])
      if (n >= count)
        return wrong(field, k, "there is no stroke " + std::to_string(n),
                     "there are " + std::to_string(count) + ", counted from 0");
  }
  return {};
}

std::string listed(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const std::size_t n : numbers) text += (text.empty() ? "" : ", ") + std::to_string(n);
  return text;
}

}  // namespace

Result<void> check_wishes(const GroupWishes& wishes, std::size_t count) {
  if (auto done = check_sets("join", wishes.join, count); !done) return done;
  if (auto done = check_sets("split", wishes.split, count); !done) return done;
  core::DisjointSets lines(count);
  std::vector<bool> joined(count, false);
  for (const auto& set : wishes.join)
    for (const std::size_t n : set) {
      lines.join(set.front(), n);
      joined[n] = true;
    }
  for (std::size_t k = 0; k < wishes.split.size(); ++k)
    for (const std::size_t a : wishes.split[k])
      for (const std::size_t b : wishes.split[k])
        if (a < b && lines.find(a) == lines.find(b))
          return wrong("split", k, "strokes " + listed({a, b}) + " are joined and split",
                       "take them out of one of the two");
  for (std::size_t k = 0; k < wishes.keep.size(); ++k) {
    const std::size_t n = wishes.keep[k];
    if (n >= count)
      return wrong("keep", k, "there is no stroke " + std::to_string(n),
                   "there are " + std::to_string(count) + ", counted from 0");
    if (joined[n])
      return wrong("keep", k, "stroke " + std::to_string(n) + " is kept and joined",
                   "take it out of one of the two");
  }
  return {};
}

GroupWishes wishes_among(const GroupWishes& wishes, const std::vector<std::size_t>& some) {
  const auto placed = [&some](const std::vector<std::size_t>& numbers) {
    std::vector<std::size_t> places;
    for (const std::size_t n : numbers)
      for (std::size_t k = 0; k < some.size(); ++k)
        if (some[k] == n) places.push_back(k);
    return places;
  };
  GroupWishes among{placed(wishes.keep), {}, {}};
  for (const auto& set : wishes.join) among.join.push_back(placed(set));
  for (const auto& set : wishes.split)
    for (const std::size_t a : placed(set))
      for (const std::size_t b : placed(set))
        if (a < b && some[a] != some[b]) among.split.push_back({a, b});
  return among;
}

void wish(const GroupWishes& wishes, PassEvidence& evidence) {
  const auto say = [&evidence](std::size_t a, std::size_t b, double how_much) {
    if (a != b) evidence[a][b] = evidence[b][a] = how_much;
  };
  for (const auto& set : wishes.join)
    for (const std::size_t a : set)
      for (const std::size_t b : set) say(a, b, kAboveAll);
  for (const auto& set : wishes.split)
    for (const std::size_t a : set)
      for (const std::size_t b : set) say(a, b, -kAboveAll);
  for (const std::size_t a : wishes.keep)
    for (std::size_t b = 0; b < evidence.size(); ++b) say(a, b, -kAboveAll);
}

std::vector<std::string> unmet_joins(const GroupWishes& wishes,
                                     const std::vector<std::vector<std::size_t>>& lines) {
  std::vector<std::string> notes;
  for (const auto& set : wishes.join) {
    const bool met = std::ranges::any_of(lines, [&set](const auto& members) {
      return std::ranges::all_of(
          set, [&](std::size_t n) { return std::ranges::find(members, n) != members.end(); });
    });
    if (!met)
      notes.push_back("warning: no line lies along strokes " + listed(set) +
                      " together: they were not joined");
  }
  return notes;
}

}  // namespace keyline::sketch

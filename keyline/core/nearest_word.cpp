#include "keyline/core/nearest_word.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace keyline::core {
namespace {

constexpr std::size_t kMostApart = 2;
constexpr std::size_t kLongestWord = 40;  ///< longer ones are text, not a slip of a name

}  // namespace

std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = i;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t other = diagonal + (a[i - 1] == b[k - 1] ? 0 : 1);
      diagonal = std::exchange(row[k], std::min({other, row[k] + 1, row[k - 1] + 1}));
    }
  }
  return row.back();
}

std::string_view nearest_word(std::string_view given, std::span<const std::string_view> words) {
  std::string_view nearest;
  if (given.size() >= kLongestWord) return nearest;
  std::size_t least = kMostApart + 1;
  for (const std::string_view word : words) {
    const std::size_t apart = letters_apart(given, word);
    if (apart >= least || apart >= std::min(given.size(), word.size())) continue;
    least = apart;
    nearest = word;
  }
  return nearest;
}

}  // namespace keyline::core

#pragma once

#include <span>
#include <string_view>

namespace keyline::core {

/// Letters added, dropped or changed that lead from one word to the other.
std::size_t letters_apart(std::string_view a, std::string_view b);

/// The word that was probably meant by one that is none of them: the first of those fewest letters
/// apart, at most two and less than either word has; empty where there is none.
std::string_view nearest_word(std::string_view given, std::span<const std::string_view> words);

}  // namespace keyline::core

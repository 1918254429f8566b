#include "copies.h"

#include <algorithm>
#include <cmath>

namespace keyline::app {
namespace {

using nlohmann::json;

// Of turning a curve of a file into its plane, and far less than any tolerance: a part in 10^4 of
// the length at least.
constexpr double kRounding = 1e-12;

double largest_in(const json& value) {
  if (value.is_number()) return std::abs(value.get<double>());
  double most = 0;
  if (value.is_array())
    for (const json& one : value) most = std::max(most, largest_in(one));
  return most;
}

/// Numbers may differ by so much; none: by a share of the largest of the list they are in.
bool same(const json& a, const json& b, const double* most) {
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>();
    return std::abs(x - b.get<double>()) <= (most ? *most : kRounding * std::abs(x));
  }
  if (a.type() != b.type() || a.size() != b.size()) return false;
  if (a.is_array()) {
    const double own = most ? *most : kRounding * largest_in(a);
    return std::equal(a.begin(), a.end(), b.begin(),
                      [&](const json& x, const json& y) { return same(x, y, &own); });
  }
  if (!a.is_object()) return a == b;
  return std::ranges::all_of(a.items(), [&](const auto& item) {
    const auto other = b.find(item.key());
    return other != b.end() && same(item.value(), *other, nullptr);
  });
}

}  // namespace

bool same_to_rounding(const json& a, const json& b) { return same(a, b, nullptr); }

std::vector<std::size_t> originals(const std::vector<json>& values) {
  std::vector<std::size_t> first;
  std::vector<std::size_t> different;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto found = std::ranges::find_if(
        different, [&](std::size_t k) { return same_to_rounding(values[k], values[i]); });
    first.push_back(found != different.end() ? *found : i);
    if (found == different.end()) different.push_back(i);
  }
  return first;
}

}  // namespace keyline::app

#include <cmath>

#include "keyline/core/text.h"
#include "keyline/operations/json_form.h"

namespace keyline::operations {

using core::Bounds;

std::string bounds_in_words(const Bounds& b, bool whole) {
  const std::string what = whole ? "give a whole number" : "give a number";
  const auto text = [](double x) { return core::number_text(x, 17); };
  const bool low = std::isfinite(b.low);
  const bool high = std::isfinite(b.high);
  if (low && high && (b.low_excluded || b.high_excluded))
    return what + " between " + text(b.low) + " and " + text(b.high) + ", " +
           (b.low_excluded && b.high_excluded ? "both excluded"
            : b.low_excluded                  ? "the first excluded"
                                              : "the second excluded");
  if (low && high) return what + " from " + text(b.low) + " to " + text(b.high);
  if (low && b.low_excluded) return what + " greater than " + (b.low == 0 ? "zero" : text(b.low));
  if (low) return what + ", " + text(b.low) + " or more";
  if (high) return what + (b.high_excluded ? " less than " : " of at most ") + text(b.high);
  return what;
}

}  // namespace keyline::operations

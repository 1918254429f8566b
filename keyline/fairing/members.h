#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::fairing::detail {

/// The measured points that fitted ones are means of.
struct Members {
  std::vector<core::Point2> points;
  std::vector<std::size_t> fitted;  ///< which of the fitted points each belongs to
  friend bool operator==(const Members&, const Members&) = default;
};

}  // namespace keyline::fairing::detail

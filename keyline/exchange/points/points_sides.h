#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace keyline::exchange::detail {

/// Columns of two curves in one table: the upper and the lower side of something.
struct Sides {
  struct Side {
    int x = 0;
    int y = 0;
    std::string name;  ///< of the column of y, without a unit
  };
  Side first;  ///< the one whose y stands further left
  Side second;
};

/// Whether the header's cells name upper and lower y ("yu" and "yl", "y_upper" and "y_lower",
/// "upper" and "lower", "Oberseite" and "Unterseite" ...) over one x, a station, or an x of each
/// side, and no y or z beside them. whole: no other column may stand there (where blanks part,
/// other words make a title).
std::optional<Sides> find_sides(const std::vector<std::string_view>& cells, bool whole);

}  // namespace keyline::exchange::detail

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "keyline/figure/drawing.h"

namespace keyline::figure {

/// Finds places for labels on a page, one after the other, so that none covers another: beside the
/// thing a label names, on as little of the lines as there is room for.
class LabelPlaces {
 public:
  LabelPlaces(double width, double height);

  /// A line that labels should rather not cover. Points in the page's unit.
  void avoid(const std::vector<core::Point2>& line);

  struct Place {
    core::Point2 middle;
    core::Point2 named;    ///< of the points given, the one the label stands beside
    bool away = false;     ///< so far from it that a leader has to show what is meant
    bool covered = false;  ///< there was no room: it covers another label
  };
  /// The best place for a box of that size beside one of the points, earlier ones preferred. It is
  /// taken then. Precondition: there is a point.
  Place take(const std::vector<core::Point2>& beside, double width, double height);

 private:
  struct Cover {
    double lines = 0;   ///< share of the box
    double labels = 0;  ///< and of what lies beyond the page
  };
  Cover cover(core::Point2 middle, double width, double height) const;
  template <class See>
  void visit(core::Point2 middle, double width, double height, const See& see) const;

  int columns_;
  int rows_;
  std::vector<std::uint8_t> cells_;  ///< what lies in them: bits
};

}  // namespace keyline::figure

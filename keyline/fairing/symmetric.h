#pragma once

#include <string_view>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/fairing/mirror.h"

/// What is asked of an answer's mirror symmetry.
namespace keyline::fairing {

enum class SymmetricMode { found, off, line };
constexpr auto choices(const SymmetricMode*) {
  return core::words<SymmetricMode>(
      {{SymmetricMode::found, "auto"}, {SymmetricMode::off, "off"}, {SymmetricMode::line, "line"}});
}

struct Symmetric {
  SymmetricMode mode = SymmetricMode::off;
  core::Point2 point;    ///< of the line…
  double direction = 0;  ///< …and which way it runs
  friend bool operator==(const Symmetric&, const Symmetric&) = default;
  static constexpr auto describe() {
    return core::fields(
        core::field<&Symmetric::mode>(
            "off: a symmetry is reported, not made exact; auto: about the line "
            "in which the points mirror within their noise; or a given one"),
        core::field<&Symmetric::point>("of the line").in("length"),
        core::field<&Symmetric::direction>("of the line, from the x axis").in("radians"));
  }
  static constexpr std::string_view kTextForm =
      "auto, off, x=0 or y=0 with any number, or X,Y:DEGREES for a line through a point";
  static core::Result<Symmetric> from_text(std::string_view text);
};

/// A symmetry that the points have within their noise, or that was asked for.
struct FoundSymmetry {
  core::Point2 point;
  double direction = 0;
  double rms = 0;  ///< of the distances of the mirrored points from the curve through the points
  bool exact = false;  ///< the answer has it exactly
  static constexpr auto describe() {
    return core::fields(
        core::field<&FoundSymmetry::point>("of the line of symmetry").in("length"),
        core::field<&FoundSymmetry::direction>("of the line, from the x axis").in("radians"),
        core::field<&FoundSymmetry::rms>("how far the mirrored points lie beside the curve through "
                                         "the points, root mean square")
            .in("length"),
        core::field<&FoundSymmetry::exact>("whether the answer has it exactly"));
  }
};

}  // namespace keyline::fairing

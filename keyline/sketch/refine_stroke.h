#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/join_strokes.h"
#include "keyline/sketch/tone.h"

namespace keyline::sketch {

/// A stroke's centre line, a pixel between points, with the ink's width along it.
struct FineStroke {
  std::vector<core::Point2> points;  ///< pixels, y down
  std::vector<double> widths;
  double width = 0;  ///< median
  double wave = 0;   ///< pixels: shortest that was not smoothed away
  bool closed = false;
  bool free_start = true;  ///< ends in paper, not at another line
  bool free_end = true;
  std::vector<std::size_t> members;  ///< numbers of what it stands for: see Stroke
};

/// Takes strokes from pixels to where the ink's grey values say they are.
class Refiner {
 public:
  explicit Refiner(const Tone& tone);

  /// Along the normal of every sure point the ink's profile is read from the grey values; the
  /// middle between its flanks is the centre. Points in junctions, gaps and where the profile is
  /// not that of one line, shows another twice as dark or reaches out of the picture, are
  /// interpolated. Free ends reach to where the ink ends less half the width (the pen was round),
  /// or to the picture's rim.
  ///
  /// Accuracy: a few hundredths of a pixel on clean lines 2 to 12 pixels wide, away from junctions.
  FineStroke refine(const RawStroke& raw) const;

  /// How far from p along `out` (unit) the ink's border lies, within two pixels either way; 0 where
  /// none is seen.
  double edge_offset(core::Point2 p, core::Vector2 out) const;

  /// From a place to where the ink ends that way (unit): where darkness falls to half of the
  /// greatest within `near`. Nothing where it goes on for more than a width and three pixels
  /// beyond that.
  std::optional<double> ink_ahead(core::Point2 from, core::Vector2 out, double near,
                                  double width) const;

  /// At a place, bilinear: 0 paper, 1 black.
  double darkness(core::Point2 p) const;

 private:
  struct Profile {
    bool good = false;
    double centre = 0;
    double width = 0;
    double peak = 0;  ///< darkness
  };
  Profile profile(core::Point2 p, core::Vector2 normal, double half_width) const;
  /// What was read beside a line, by its points; weight 0 where nothing was.
  struct Centres {
    std::vector<core::Point2> places;
    std::vector<double> widths;
    std::vector<double> weights;
  };
  /// Reads them along the normals of `line`; how many there are. `usual`: half widths.
  std::size_t read_centres(const RawStroke& raw, const std::vector<double>& usual,
                           const std::vector<core::Point2>& line, Centres& read) const;
  /// From its values by steps, which are there up to `reach` of them either way.
  template <class Values>
  static Profile profile_along(Values&& at, int reach, double half_width);
  double extension(core::Point2 end, core::Vector2 direction, double half_width) const;
  /// Way to the picture's rim that a line running that way crosses; below 0 beyond it, infinite
  /// where the line runs along it.
  double rim_ahead(core::Point2 p, core::Vector2 direction) const;
  void trim_end(std::vector<core::Point2>& points, std::vector<double>& widths,
                double half_width) const;

  const Tone& tone_;
  std::vector<float> darkness_of_level_;
};

}  // namespace keyline::sketch

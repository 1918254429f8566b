#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/operations/made_curve.h"
#include "keyline/operations/sketch_target.h"
#include "keyline/sketch/trace.h"

/// From a drawing to curves as an operation: sketch.trace.
namespace keyline::operations {

struct SketchRequest {
  std::string image;
  std::string file;
  sketch::TraceOptions options;
  std::optional<std::array<std::optional<double>, sketch::kRegionCount>> thresholds;
  std::optional<double> scale;
  std::optional<double> dpi;
  std::optional<double> tolerance;
  std::vector<WantedPlace> target;
  bool per_segment = false;
  bool stages = false;
  static constexpr auto describe() {
    using Request = SketchRequest;
    using Trace = sketch::TraceOptions;
    using Ink = sketch::BinarizeOptions;
    using Tone = sketch::ToneOptions;
    using Curve = sketch::StrokeCurveOptions;
    return core::fields(
        core::field<&Request::image>("PNG, JPEG, TIFF or WebP in base64; or give file"),
        core::field<&Request::file>(
            "path of such a picture, or of pen strokes (scap, svg, dxf, json); or give image"),
        core::field<&Request::options, &Trace::rectify>(
            "photos of a sheet of paper on darker ground are mapped back to the sheet"),
        core::field<&Request::options, &Trace::sheet>(
            "corners of that sheet: upper left, upper right, lower right, lower left, in pixels "
            "from the picture's upper left corner; found unless given")
            .in("pixel"),
        core::field<&Request::options, &Trace::binarize, &Ink::threshold>(
            "level of the log picture: what is darker is ink; found by region unless given")
            .within(core::from_to(0, 1)),
        core::field<&Request::thresholds>(
            "the same for each of 8 x 8 regions, row by row from the top left; null: found")
            .within(core::from_to(0, 1)),
        core::field<&Request::options, &Trace::tone, &Tone::gain>(
            "the a of y = a log x in the log picture; unless given such that paper is 1")
            .named("log_gain")
            .within(core::kPositive),
        core::field<&Request::options, &Trace::tone, &Tone::flatten>(
            "whether to remove the paper's own shades"),
        core::field<&Request::options, &Trace::tone, &Tone::polarity>(
            "dark lines on light paper, or light lines on dark paper"),
        core::field<&Request::options, &Trace::edge>(
            "what to follow: the middle of the lines, or the outer "
            "border of the ink"),
        core::field<&Request::options, &Trace::smoothing>(
            "passes of erosion and dilation over the ink's edges")
            .within(core::from_to(0, 100)),
        core::field<&Request::options, &Trace::smoothing_by>(
            "what smoothing changes. features: bumps and dents of one pixel; pixels: every edge, "
            "which rounds corners and loses thin lines ([Sketch] Fig. 6b), for comparison"),
        core::field<&Request::scale>("mm per pixel; unless given lengths are in pixels")
            .within(core::kPositive),
        core::field<&Request::dpi>("pixels per inch, in place of scale; lengths are in mm then")
            .within(core::kPositive),
        core::field<&Request::options, &Trace::consolidate>(
            "make one line of a line that was drawn several times"),
        core::field<&Request::options, &Trace::wishes, &sketch::GroupWishes::keep>(
            "with consolidate: strokes that stay as drawn, by their numbers from 0"),
        core::field<&Request::options, &Trace::wishes, &sketch::GroupWishes::join>(
            "with consolidate: sets of strokes that are one line, as in 3,7"),
        core::field<&Request::options, &Trace::wishes, &sketch::GroupWishes::split>(
            "with consolidate: sets of strokes of which no two are one line, as in 3,7"),
        core::field<&Request::options, &Trace::curve, &Curve::aim>(
            "change the curves' curvature: smooth takes waves out, rhythm also makes it "
            "log-aesthetic")
            .named("curvature"),
        core::field<&Request::options, &Trace::curve, &Curve::rhythm>(
            "with curvature rhythm: the lines' own, or one to give them; accelerating is slope "
            "-0.5 and less, stable 0, decelerating 0.5 and more"),
        core::field<&Request::target>(
            "curvatures to give a line: its number from 0, the fraction of its length, the "
            "curvature in 1/length, as in 0,0.5,0.01; at least two for a line; its ends stay"),
        core::field<&Request::tolerance>(
            "largest distance of the curve from the line; half a pixel, or half the pen's width of "
            "drawn strokes, unless given")
            .in("length")
            .within(core::kPositive),
        core::field<&Request::per_segment>(
            "one quintic per line segment, as in [Sketch]; otherwise as few as follow the lines"),
        core::field<&Request::options, &Trace::gap>(
            "longest gap that is bridged; chosen by the stroke width unless given")
            .in("pixel")
            .within(core::at_least(0)),
        core::field<&Request::options, &Trace::specks>(
            "pieces of ink of fewer pixels are dirt; chosen by the stroke width unless given")
            .within(core::from_to(0, 1 << 20)),
        core::field<&Request::stages>("also return the picture after each stage"));
  }
  /// Fails: bad_input for wishes where nothing is consolidated, a rhythm for curvature smooth, a
  /// sheet that is not to be rectified.
  static core::Result<void> check(const SketchRequest& request);
};

/// A picture of grey levels on the way from the drawing to its lines.
struct StageShown {
  std::string name;
  int width = 0;
  int height = 0;
  std::string gray;
  static constexpr auto describe() {
    return core::fields(core::field<&StageShown::name>("log, binary, smoothed, edges, lines"),
                        core::field<&StageShown::width>("in pixels"),
                        core::field<&StageShown::height>("in pixels"),
                        core::field<&StageShown::gray>(
                            "in base64, a byte a pixel, row by row from the top left, 0 black"));
  }
};

struct CurvatureErrorShown {
  double before = 0;
  double after = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&CurvatureErrorShown::before>("rms").in("1/length"),
                        core::field<&CurvatureErrorShown::after>("rms").in("1/length"));
  }
};

struct StrokeShown {
  std::vector<core::Point2> points;
  std::vector<core::Point2> segments;
  MadeCurve curve;
  std::vector<std::size_t> corners;
  bool closed = false;
  double width = 0;
  std::optional<std::vector<std::size_t>> members;
  std::optional<CurvatureErrorShown> curvature_error;
  static constexpr auto describe() {
    using Stroke = StrokeShown;
    return core::fields(
        core::field<&Stroke::points>("along the line's middle"),
        core::field<&Stroke::segments>("vertices of the line segments"),
        core::flattened<&Stroke::curve>(),
        core::field<&Stroke::corners>("pieces of the curve that start with a corner"),
        core::field<&Stroke::closed>("whether the line is"),
        core::field<&Stroke::width>("of the ink, median").in("length"),
        core::field<&Stroke::members>(
            "drawn strokes it stands for, from 0; of a picture, with consolidate, strokes of the "
            "answer without"),
        core::field<&Stroke::curvature_error>("curvature less its target"));
  }
};

struct SketchAnswer {
  std::vector<StrokeShown> strokes;
  std::array<double, 2> size{};
  std::optional<sketch::SheetCorners> sheet;
  std::string unit;
  double explained = 1;
  std::vector<std::size_t> left_over;
  std::vector<std::string> report;
  std::optional<std::vector<StageShown>> stages;

  sketch::TraceResult trace;  ///< not part of the public form: for pictures, like what follows
  std::vector<sketch::Stage> pictures;
  double scale = 1;

  static constexpr auto describe() {
    return core::fields(
        core::field<&SketchAnswer::strokes>("the lines, longest first"),
        core::field<&SketchAnswer::size>("of the picture, or of the sheet in it").in("length"),
        core::field<&SketchAnswer::sheet>(
            "corners of the sheet that a photo was mapped back to, as they are given")
            .in("pixel"),
        core::field<&SketchAnswer::unit>("of lengths: px, or mm where the scale is known"),
        core::field<&SketchAnswer::explained>(
            "share of the ink, or of the strokes' length, that lies beside a curve"),
        core::field<&SketchAnswer::left_over>("drawn strokes that no line stands for, from 0"),
        core::field<&SketchAnswer::report>("what was decided, left out or looks doubtful"),
        core::field<&SketchAnswer::stages>("where asked for"));
  }
};

}  // namespace keyline::operations

#include "keyline/sketch/trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"
#include "keyline/core/text.h"
#include "keyline/numeric/parallel.h"
#include "keyline/sketch/enlargement.h"
#include "keyline/sketch/explained.h"
#include "keyline/sketch/find_dots.h"
#include "keyline/sketch/find_ink.h"
#include "keyline/sketch/ink_measure.h"
#include "keyline/sketch/join_strokes.h"
#include "keyline/sketch/light_lines.h"
#include "keyline/sketch/meet_lines.h"
#include "keyline/sketch/merge_strokes.h"
#include "keyline/sketch/morphology.h"
#include "keyline/sketch/outline.h"
#include "keyline/sketch/pixel_words.h"
#include "keyline/sketch/polyline_tools.h"
#include "keyline/sketch/refine_stroke.h"
#include "keyline/sketch/straighten.h"
#include "keyline/sketch/stroke_graph.h"
#include "keyline/sketch/tell_picture.h"
#include "keyline/sketch/thinning.h"

namespace keyline::sketch {
namespace {

using core::Point2;

/// Widths of the pen that traced lines of one line lie apart at most; what is closer has run into
/// one line of ink already.
constexpr double kPictureApart = 3.5;

/// Widths and two pixels, pixels at most: shorter lines that start at another are none.
constexpr double kStub = 1.2;
constexpr double kLongestStub = 5;

constexpr double kManyPasses = 0.75;  ///< lines per stroke from which passes are told

constexpr std::size_t kAtOnce = 32;  ///< lines fitted between two reports of progress

constexpr double kGrainShare = 0.15;  ///< of the width: how far curves may pass from such lines

/// Pixels with y down to y up.
void turn_up(Stroke& stroke, double height) {
  const auto turn = [height](Point2& p) { p.y = height - p.y; };
  std::for_each(stroke.points.begin(), stroke.points.end(), turn);
  std::for_each(stroke.segments.begin(), stroke.segments.end(), turn);
  for (auto& axis : stroke.axes) std::for_each(axis.begin(), axis.end(), turn);
  for (auto* pieces : {&stroke.quadratics, &stroke.curve})
    for (curve::Bezier2& piece : *pieces)
      std::for_each(piece.control.begin(), piece.control.end(), turn);
  for (fit::CurvatureTarget& target : stroke.target) target.curvature = -target.curvature;
}

void turn_up(TraceResult& result) {
  for (Stroke& stroke : result.strokes) turn_up(stroke, result.height);
  for (DrawnStroke& pass : result.passes)
    for (Point2& p : pass.points) p.y = result.height - p.y;
}

core::Result<TraceResult> nothing_found() {
  return core::fail(core::ErrorCode::undrawable, "nothing in the picture looks like a line",
                    "give --threshold, or a picture with more contrast");
}

/// True for what starts at a line and ends freely: short ones are where the pen went on a little.
bool is_stub(const RawStroke& line) { return !line.closed && line.free_start != line.free_end; }

/// Lines along the middle of the ink.
std::vector<FineStroke> center_lines(const Ink& found, const Refiner& refiner,
                                     const TraceOptions& options) {
  const Binary& ink = found.picture;
  const double width = found.width;
  const Binary thinned = thin(ink);
  show_stage(options, "lines", thinned);
  StrokeGraph graph = build_graph(thinned, ink, found.grainy);
  InkPieces left_out = found.dirt.specks;
  left_out.add(found.lost);
  find_dots(ink, left_out, graph);
  options.progress.report(0.6, "following lines");
  std::vector<FineStroke> strokes;
  std::vector<RawStroke> lines = join_strokes(
      std::move(graph), {.gap = options.gap.value_or(2.5 * width + 3), .rows = !options.gap});
  std::erase_if(lines, [&](const RawStroke& line) {
    return core::polygon_length(line.points, line.closed) < std::max(2.0, 0.5 * width);
  });
  std::vector<FineStroke> fine(lines.size());
  numeric::parallel_for(lines.size(), 0, [&](std::size_t i, int) {
    if (!options.progress.stop_requested()) fine[i] = refiner.refine(lines[i]);
  });
  if (options.progress.stop_requested()) return {};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double length = core::polygon_length(fine[i].points, fine[i].closed);
    if (length >= (is_stub(lines[i]) ? std::min(kStub * width + 2, kLongestStub) : 1.5))
      strokes.push_back(std::move(fine[i]));
  }
  end_on_lines(strokes, refiner, found.grainy);
  return strokes;
}

/// Longest first, those of one length in their order.
template <class Line>
void sort_by_length(std::vector<Line>& lines) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < lines.size(); ++i)
    order.emplace_back(-core::polygon_length(lines[i].points), i);
  std::ranges::sort(order);
  std::vector<Line> sorted;
  for (const auto& [length, i] : order) sorted.push_back(std::move(lines[i]));
  lines = std::move(sorted);
}

/// A picture's lines get the numbers that they have in the answer without merging: longest first.
void number_lines(std::vector<FineStroke>& lines) {
  std::erase_if(lines, [](const FineStroke& s) { return s.points.size() < 2; });
  sort_by_length(lines);
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i].members = {i};
}

/// Strokes of which many are passes of one line are told, where they were not made one.
void tell_passes(const std::vector<FineStroke>& strokes, const ConsolidateOptions& passes,
                 TraceResult& result) {
  std::vector<DrawnStroke> drawn;
  for (const FineStroke& s : strokes)
    if (s.points.size() >= 2) drawn.push_back({s.points, s.closed});
  if (drawn.size() < 2) return;
  const std::size_t lines = count_lines(drawn, passes);
  if (static_cast<double>(lines) > kManyPasses * static_cast<double>(drawn.size())) return;
  result.notes.push_back(core::counted(drawn.size(), "stroke") + " look like passes of about " +
                         core::counted(lines, "line") + ": consolidate makes one curve of each");
}

/// Makes one line of every group of a picture's lines.
core::Result<Merged> merge_traced(std::vector<FineStroke>& lines, const ConsolidateOptions& passes,
                                  const GroupWishes& wishes, TraceResult& result) {
  number_lines(lines);
  for (const FineStroke& s : lines) result.passes.push_back({s.points, s.closed});
  if (auto sound = check_wishes(wishes, lines.size()); !sound)
    return std::unexpected(sound.error());
  return merge(lines, passes.width, passes, wishes, result.notes);
}

void warn_of_little(const std::string& of_what, TraceResult& result) {
  result.notes.push_back("warning: the lines explain " +
                         std::to_string(std::lround(100 * result.explained)) + " % of the " +
                         of_what);
}

/// What is left of the ink in pieces as large as a dot of the pen: eyes, blots, missed strokes.
std::string tell_places(Binary rest, double width) {
  const InkPieces pieces = take_pieces(rest);
  std::size_t large = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (static_cast<double>(pieces[i].size()) >= 0.25 * core::kPi * width * width) ++large;
  if (large == 0) return "";
  return "; " +
         core::counted(large, "place as large as a dot of the pen has",
                       "places as large as a dot of the pen have") +
         " no line (the overlay shows where)";
}

/// Finds and tells the share of all ink, the faint that was lost included, that lines explain.
void find_explained(Ink& found, const Tone& tone, const Merged& merged, TraceResult& result) {
  const double ink =
      static_cast<double>(count_ink(found.picture.data.data(), found.picture.data.size()));
  const auto lost = static_cast<double>(
      count_lost(found.faint, found.picture, tone, faint_line(found.width, found.specks)));
  double explained = explained_ink(found.picture, result.strokes);
  explained += (1 - explained) * explained_ink(found.picture, merged.passes);
  const double far = (1 - explained) * explained_ink(found.picture, merged.far);
  const double of_all = ink / (ink + lost);
  result.explained = explained * of_all;
  const long far_share = std::lround(100 * far * of_all);
  const std::string in_far =
      std::to_string(far_share) + " % is passes farther than a pen and a half from their line";
  if (result.explained >= kEnoughExplained) return;
  warn_of_little(
      (far_share > 0 ? "ink; " + in_far : "ink") + tell_places(found.picture, found.width), result);
}

/// How curves are fitted: they may pass grainy lines farther off.
TraceOptions curves_of(const Ink& ink, TraceOptions options) {
  if (ink.grainy) options.curve.width_share = kGrainShare;
  return options;
}

/// Curves of all strokes, longest first.
core::Result<void> add_curves(const std::vector<FineStroke>& lines, const TraceOptions& options,
                              const Refiner* picture, TraceResult& result) {
  std::vector<std::optional<Stroke>> curves(lines.size());
  for (std::size_t first = 0; first < lines.size(); first += kAtOnce) {
    if (options.progress.stop_requested())
      return core::fail(core::ErrorCode::cancelled, "cancelled");
    options.progress.report(
        0.7 + 0.3 * static_cast<double>(first) / static_cast<double>(lines.size()),
        "fitting curves");
    numeric::parallel_for(std::min(kAtOnce, lines.size() - first), 0, [&](std::size_t k, int) {
      const FineStroke& line = lines[first + k];
      if (line.points.size() >= 2) curves[first + k] = curve_of(line, options.curve, picture);
    });
  }
  for (std::optional<Stroke>& curve : curves)
    if (curve) result.strokes.push_back(std::move(*curve));
  sort_by_length(result.strokes);
  std::size_t straight_ended = 0;
  for (const Stroke& s : result.strokes) straight_ended += s.straight_ended;
  if (straight_ended > 0)
    result.notes.push_back(core::counted(straight_ended, "stretch", "stretches") +
                           " from or to a straight place can only be accelerating");
  return {};
}

/// Drawn strokes with as many points as those of pictures have; the numbers of those left over.
core::Result<std::vector<FineStroke>> lines_of(const std::vector<DrawnStroke>& strokes,
                                               double width, std::vector<std::size_t>& left_over) {
  const auto bad = [](const std::string& what) {
    return core::fail(core::ErrorCode::bad_input, what, "give strokes of two places and more");
  };
  std::vector<FineStroke> lines;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const DrawnStroke& s = strokes[i];
    if (!std::all_of(s.points.begin(), s.points.end(), [](Point2 p) { return is_finite(p); }))
      return bad("a stroke is not finite");
    const double length = core::polygon_length(s.points, s.closed);
    if (!(length > 0.5 * width)) {
      left_over.push_back(i);
      continue;
    }
    if (length > 1e6 * width) return bad("a stroke is a million times longer than its pen is wide");
    FineStroke fine;
    fine.closed = s.closed;
    fine.width = width;
    fine.members = {i};
    resample(s.points, std::vector<double>(s.points.size(), width), kStrokeStep * width, s.closed,
             fine.points, fine.widths);
    lines.push_back(std::move(fine));
  }
  if (lines.empty()) return bad("no stroke has any length");
  return lines;
}

/// Lengths counted in another unit.
void reduce(FineStroke& line, double unit) {
  for (Point2& p : line.points) p = {p.x / unit, p.y / unit};
  line.width /= unit;
  for (double& w : line.widths) w /= unit;
}

/// A picture of grey levels on one ground.
core::Result<TraceResult> trace_grey(Image image, const TraceOptions& options);

/// A picture whose pixels were repeated is traced at its own size: the steps are not its lines'.
core::Result<TraceResult> trace_enlarged(const Image& image, const OwnSize& size,
                                         const TraceOptions& options) {
  const double times = static_cast<double>(image.width()) / size.width;
  TraceOptions own = options;
  if (own.gap) *own.gap /= times;
  if (own.specks) *own.specks = static_cast<int>(*own.specks / (times * times));
  if (own.curve.tolerance > 0)
    own.curve.tolerance = std::max(own.curve.tolerance / times, StrokeCurveOptions{}.tolerance);
  if (own.sheet)
    for (Point2& p : *own.sheet) p = {p.x / times, p.y / times};
  auto result = trace_grey(reduced(image, size), own);
  if (!result) return result;
  if (result->sheet)
    enlarge(*result, static_cast<int>(std::lround(times * result->width)),
            static_cast<int>(std::lround(times * result->height)));
  else
    enlarge(*result, image.width(), image.height());
  result->notes.push_back("the picture was enlarged " + core::number_text(times, 3) +
                          " times by repeating pixels: traced at its own size");
  return result;
}

core::Result<TraceResult> trace_grey(Image image, const TraceOptions& options) {
  if (const OwnSize size = own_size(image); size.width < image.width())
    return trace_enlarged(image, size, options);
  TraceResult result;
  const bool on_black = image.on_black;
  options.progress.report(0, "reading grey values");
  if (auto done = straighten(image, options, result); !done) return std::unexpected(done.error());
  result.width = image.width();
  result.height = image.height();
  Tone tone = transform_intensity(std::move(image), options.tone);
  show_stage(options, tone);
  tell_ground(tone, on_black, result);
  options.progress.report(0.2, "telling ink from paper");
  Ink found = find_ink(tone, options);
  const Binary& ink = found.picture;
  const double width = found.width;
  if (options.stage) show_stage(options, "edges", laplacian_edges(ink));
  options.progress.report(0.4, "thinning");
  const Refiner refiner(tone);
  std::vector<FineStroke> lines =
      options.edge == Edge::outer ? outlines(ink, tone) : center_lines(found, refiner, options);
  put_back_drawn(lines, found);
  tell_dirt(found, result);
  const ConsolidateOptions passes{
      .width = width, .measured = true, .apart = kPictureApart, .hand = 0};
  Merged merged;
  if (options.consolidate) {
    auto done = merge_traced(lines, passes, options.wishes, result);
    if (!done) return std::unexpected(done.error());
    merged = std::move(*done);
  } else if (options.edge == Edge::center) {
    tell_passes(lines, passes, result);
  }
  if (found.grainy) result.notes.push_back("grainy lines: looked at through a blur");
  const bool is_clear = options.edge == Edge::center && !found.grainy;
  if (auto done =
          add_curves(lines, curves_of(found, options), is_clear ? &refiner : nullptr, result);
      !done)
    return std::unexpected(done.error());
  if (options.progress.stop_requested()) return core::fail(core::ErrorCode::cancelled, "cancelled");
  if (result.strokes.empty()) return nothing_found();
  if (options.edge == Edge::center) find_explained(found, tone, merged, result);
  warn_of_photograph(tone, found, options.edge, result);
  turn_up(result);
  return result;
}

}  // namespace

core::Result<TraceResult> trace(Image image, const TraceOptions& options) {
  const LightShare light = darken_light_lines(image, options.tone.polarity);
  auto result = trace_grey(std::move(image), options);
  if (result) tell_light(light, *result);
  return result;
}

core::Result<TraceResult> trace_strokes(const std::vector<DrawnStroke>& strokes, double width,
                                        const TraceOptions& options) {
  if (auto sound = check_wishes(options.wishes, strokes.size()); !sound)
    return std::unexpected(sound.error());
  TraceResult result;
  result.passes = strokes;
  auto found = lines_of(strokes, width, result.left_over);
  if (!found) return std::unexpected(found.error());
  std::vector<FineStroke>& lines = *found;
  double drawn = 0;
  for (const DrawnStroke& s : strokes) drawn += core::polygon_length(s.points, s.closed);
  double explained = drawn;
  if (options.consolidate)
    explained = merge(lines, width, {.width = width}, options.wishes, result.notes).explained;
  else
    tell_passes(lines, {.width = width}, result);
  result.explained = std::min(1.0, explained / drawn);
  if (result.explained < kEnoughExplained) warn_of_little("strokes", result);
  // what counts pixels in pictures counts steps between points here, so that no unit matters
  const double unit = kStrokeStep * width;
  for (FineStroke& line : lines) reduce(line, unit);
  TraceOptions scaled = options;
  scaled.curve.straightness *= width / unit;
  scaled.curve.tolerance *= width / unit;
  if (auto done = add_curves(lines, scaled, nullptr, result); !done)
    return std::unexpected(done.error());
  for (Stroke& stroke : result.strokes) scale(stroke, unit, unit);
  return result;
}

}  // namespace keyline::sketch

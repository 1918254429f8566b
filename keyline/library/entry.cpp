#include "keyline/library/entry.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

#include "keyline/analysis/analyze.h"
#include "keyline/analysis/self_affinity.h"
#include "keyline/classa/free_form.h"
#include "keyline/document/cusped.h"
#include "keyline/exchange/cad/planar_form.h"
#include "keyline/exchange/document_file.h"
#include "keyline/library/thumbnail.h"
#include "keyline/numeric/parallel.h"
#include "keyline/surface/network.h"

namespace keyline::library {

using core::ErrorCode;
using core::Result;
using document::Document;

namespace {

/// A document for each thing.
std::vector<Document> things_of(const Document& document) {
  std::vector<Document> things;
  const auto part = [&]() -> Document& {
    Document& one = things.emplace_back();
    one.unit = document.unit;
    return one;
  };
  for (const auto& path : document.paths) part().paths.push_back(path);
  for (const auto& curve : document.space_curves) part().space_curves.push_back(curve);
  for (const auto& surface : document.surfaces) part().surfaces.push_back(surface);
  return things;
}

/// More than one line, and nothing but lines: measured points, or a corner beside a corner.
bool is_polygon(const document::Path& path) {
  std::size_t edges = 0;
  for (const auto& member : path.curves) {
    const auto* line = std::get_if<curve::Polyline2>(&member.value);
    if (!line) return false;
    edges += line->points.size() - 1;
  }
  return edges > 1;
}

PieceEntry piece_entry(const analysis::CurveView& curve, const analysis::ArcLengthTable& table,
                       const analysis::PieceAnalysis& piece, double whole) {
  PieceEntry entry{piece.length / whole, piece.rhythm, piece.slopes, {}, {}, piece.volume, {}};
  if (piece.lcg.defined) {
    entry.lcg_slope = piece.lcg.slope;
    entry.lcg_variance = piece.lcg.variance;
  }
  constexpr int kSamples = 257;
  const auto profile = analysis::sample_profile(curve, table, piece.extent.t, kSamples);
  if (const auto affine = analysis::self_affinity(profile)) entry.self_affinity = affine->deviation;
  return entry;
}

void measure_rhythm(Entry& entry, const document::Path& path, int threads) {
  const document::CuspedPath cusped(path);
  const analysis::CurveView view(cusped);
  analysis::AnalyzeOptions options;
  options.threads = threads;
  const auto found = analysis::analyze(view, options);
  if (!found) {
    entry.notes.push_back("not measured: " + found.error().message);
    return;
  }
  entry.length = found->length;
  entry.turning = turning_profile(view);
  if (is_polygon(path)) {
    entry.notes.push_back("a polyline has no curvature: fair it to see its rhythm");
    return;
  }
  entry.volume = found->volume;
  entry.curvature.emplace();
  if (!document::has_cusp(cusped.stops(), -1)) (*entry.curvature)[0] = found->curvature_min;
  if (!document::has_cusp(cusped.stops(), 1)) (*entry.curvature)[1] = found->curvature_max;
  const analysis::ArcLengthTable table(view);
  for (const auto& piece : found->pieces)
    entry.pieces.push_back(piece_entry(view, table, piece, found->length));
}

Result<classa::Evaluation> evaluate_path(const document::Path& path) {
  Result<classa::Approximation> bezier;
  const auto* exact =
      path.curves.size() == 1 ? std::get_if<curve::Bezier2>(&path.curves[0].value) : nullptr;
  if (exact && !curve::is_rational(*exact)) {
    bezier = classa::Approximation{*exact, true};
  } else {
    bezier = path.curves.size() == 1 ? classa::approximate(curve::PlanarView(path.curves[0]))
                                     : classa::approximate(curve::PlanarView(path));
  }
  if (!bezier) return std::unexpected(bezier.error());
  return classa::evaluate_curve(std::move(*bezier), {});
}

void measure_cav(Entry& entry, const document::Path& path) {
  const auto found = evaluate_path(path);
  if (!found) {
    entry.notes.push_back("no CAV: " + found.error().message);
    return;
  }
  entry.cav_type = found->value.type;
  entry.cav = found->value.cav;
  if (found->nearest) entry.nearest_distance = found->nearest->distance;
  if (found->nearest_value) entry.nearest_cav = found->nearest_value->cav;
}

void measure_path(Entry& entry, const document::Path& path, int threads) {
  measure_rhythm(entry, path, threads);
  if (entry.length && !is_polygon(path)) measure_cav(entry, path);
}

void measure_surface(Entry& entry, const surface::Surface& surface) {
  const auto patches = surface::sav_by_patch(surface);
  if (!patches) {
    entry.notes.push_back("no SAV: " + patches.error().message);
    return;
  }
  entry.sav = 0;
  for (const auto& patch : *patches) *entry.sav += patch.value.sav;
  if (patches->size() > 1)
    entry.notes.push_back("SAV is the sum over " + std::to_string(patches->size()) + " patches");
}

Entry describe_thing(Document thing, const std::string& source, int threads) {
  Entry entry;
  entry.source = source;
  entry.size = exchange::extent(thing);
  entry.thumbnail = thumbnail(thing);
  if (!thing.paths.empty()) {
    measure_path(entry, thing.paths.front().path, threads);
  } else if (!thing.surfaces.empty()) {
    entry.kind = Kind::surface;
    measure_surface(entry, thing.surfaces.front().surface);
  } else {
    entry.kind = Kind::space_curve;
    const auto planar = exchange::planar_form(thing.space_curves.front().curve);
    if (planar) measure_path(entry, document::Path{{planar->curve}, false}, threads);
    if (!planar) entry.notes.push_back("not in a plane: no rhythm, no CAV");
  }
  entry.thing = std::move(thing);
  return entry;
}

}  // namespace

const document::Label& label(const Entry& entry) {
  if (!entry.thing.paths.empty()) return entry.thing.paths.front().label;
  if (!entry.thing.space_curves.empty()) return entry.thing.space_curves.front().label;
  return entry.thing.surfaces.front().label;
}

Result<std::vector<Entry>> describe(const Document& document, const std::string& source,
                                    const DescribeOptions& options,
                                    const core::Progress& progress) {
  std::vector<Document> things = things_of(document);
  things.erase(things.begin(), things.begin() + std::min(options.first, things.size()));
  if (options.most && *options.most < things.size()) things.resize(*options.most);
  std::vector<Entry> entries(things.size());
  const int within = things.size() == 1 ? options.threads : 1;  // else others measure other curves
  std::atomic<std::size_t> done = 0;
  std::mutex telling;
  numeric::parallel_for(things.size(), options.threads, [&](std::size_t i) {
    if (progress.stop_requested()) return;
    entries[i] = describe_thing(std::move(things[i]), source, within);
    const std::size_t count = ++done;
    const std::scoped_lock lock(telling);
    progress.report(static_cast<double>(count) / static_cast<double>(entries.size()),
                    "measuring curves");
  });
  if (progress.stop_requested()) return core::fail(ErrorCode::cancelled, "cancelled");
  return entries;
}

}  // namespace keyline::library

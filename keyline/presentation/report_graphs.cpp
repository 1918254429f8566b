#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "keyline/figure/rhythm_charts.h"
#include "keyline/presentation/report_parts.h"

namespace keyline::presentation::detail {
namespace {

using core::Point2;

constexpr std::size_t kFewPieces = 6;       // with charts of full size
constexpr std::size_t kMostPieces = 40;     // with charts at all
constexpr std::size_t kPiecesPerSheet = 6;  // compact: two to a row
constexpr std::size_t kGraphPoints = 60;
constexpr double kDecades = 2.5;       // of radius in a graph
constexpr double kRounding = 1e-12;    // a variance below it is that of an exact line
constexpr double kCompactWidth = 252;  // px
constexpr double kCompactHeight = 236;

/// Decadic instead of natural logarithms, thinned. Radii far above the smallest, around an
/// inflection or a straight end, would fill the graph and are left out.
std::vector<Point2> graph_points(const analysis::Lcg& lcg) {
  std::vector<Point2> near;
  double least = HUGE_VAL;
  for (const auto& p : lcg.points) least = std::min(least, p.log_radius);
  for (const auto& p : lcg.points)
    if (p.log_radius <= least + kDecades * std::numbers::ln10)
      near.push_back({p.log_radius / std::numbers::ln10, p.log_rate / std::numbers::ln10});
  std::vector<Point2> points;
  const std::size_t step =
      std::max<std::size_t>(1, (near.size() + kGraphPoints - 1) / kGraphPoints);
  for (std::size_t i = 0; i < near.size(); ++i)
    if (i % step == 0 || i + 1 == near.size()) points.push_back(near[i]);
  return points;
}

figure::LcgPiece lcg_of(const PieceGraphs& piece) {
  figure::LcgPiece graph;
  graph.name = piece.name + ": LCG";
  graph.points = graph_points(piece.lcg);
  graph.measured = graph_points(piece.before);
  if (!piece.lcg.defined || graph.points.empty()) return graph;
  const auto [low, high] = std::minmax_element(graph.points.begin(), graph.points.end(),
                                               [](Point2 a, Point2 b) { return a.x < b.x; });
  graph.lines.push_back(
      {low->x, high->x, piece.lcg.slope, piece.lcg.intercept / std::numbers::ln10});
  const double variance = piece.lcg.variance / (std::numbers::ln10 * std::numbers::ln10);
  if (variance > kRounding) graph.variance = variance;
  return graph;
}

std::vector<Point2> tops_of(const std::vector<analysis::LddcTop>& tops) {
  std::vector<Point2> points;
  for (const auto& top : tops) points.push_back({top.x, top.y});
  return points;
}

figure::LddcPiece lddc_of(const PieceGraphs& piece) {
  const analysis::Lddc& lddc = piece.lddc;
  figure::LddcPiece diagram;
  diagram.name = piece.name + ": LDDC";
  diagram.bin_width = analysis::kLddcBarWidth;
  for (const auto& bar : lddc.bars)
    if (bar.count > 0)
      diagram.bars.push_back({bar.low + 0.5 * analysis::kLddcBarWidth, bar.height});
  diagram.c_curve = tops_of(lddc.c_curve);
  diagram.measured = tops_of(piece.before_lddc.c_curve);
  if (lddc.has_gradient)
    diagram.lines.push_back({lddc.a.x, lddc.b.x, lddc.gradient, lddc.intercept});
  if (!lddc.c_curve.empty()) {
    diagram.point_a = Point2{lddc.a.x, lddc.a.y};
    if (lddc.c_curve.size() > 1) diagram.point_b = Point2{lddc.b.x, lddc.b.y};
  }
  return diagram;
}

bool has_graph(const PieceGraphs& piece) { return piece.lcg.defined; }

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void add_full(report::Section& section, const PieceGraphs& piece) {
  section.figures.push_back(
      {figure::lcg_chart(lcg_of(piece)), fmt::format("{}: logarithmic curvature graph. Slope {}.",
                                                     piece.name, slopes_text({piece.lcg.slope}))});
  section.figures.push_back({figure::lddc_chart(lddc_of(piece)),
                             fmt::format("{}: diagram of curvature. From A to B {:.2f}.",
                                         piece.name, piece.lddc.distance_ab)});
}

void add_sheet(report::Section& section, const std::vector<const PieceGraphs*>& pieces) {
  std::vector<figure::Drawing> charts;
  std::vector<std::string> names;
  for (const PieceGraphs* piece : pieces) {
    charts.push_back(figure::lcg_chart(lcg_of(*piece), kCompactWidth, kCompactHeight));
    charts.push_back(figure::lddc_chart(lddc_of(*piece), kCompactWidth, kCompactHeight));
    names.push_back(piece->name);
  }
  section.figures.push_back(
      {figure::tile(charts, 4, 6), "Graph and diagram of " + list_of(names) + "."});
}

}  // namespace

void add_graphs(report::Section& section, const std::vector<PieceGraphs>& pieces) {
  std::vector<const PieceGraphs*> shown;
  std::vector<std::string> without;
  for (const PieceGraphs& piece : pieces) {
    if (has_graph(piece))
      shown.push_back(&piece);
    else
      without.push_back(piece.name);
  }
  if (!without.empty())
    section.paragraphs.push_back("No graph, as the radius does not change: " + list_of(without) +
                                 ".");
  if (shown.size() > kMostPieces) {
    std::vector<const PieceGraphs*> longest = shown;
    std::stable_sort(longest.begin(), longest.end(),
                     [](const auto* a, const auto* b) { return a->length > b->length; });
    longest.resize(kMostPieces);
    std::erase_if(shown, [&longest](const auto* piece) {
      return std::find(longest.begin(), longest.end(), piece) == longest.end();
    });
    section.paragraphs.push_back(fmt::format("Shown are the {} longest of {} pieces.", shown.size(),
                                             pieces.size() - without.size()));
  }
  if (shown.size() <= kFewPieces) {
    for (const PieceGraphs* piece : shown) add_full(section, *piece);
    return;
  }
  for (std::size_t i = 0; i < shown.size(); i += kPiecesPerSheet)
    add_sheet(
        section,
        {shown.begin() + static_cast<std::ptrdiff_t>(i),
         shown.begin() + static_cast<std::ptrdiff_t>(std::min(shown.size(), i + kPiecesPerSheet))});
}

}  // namespace keyline::presentation::detail

// quasi_figures FOLDER: the tables of docs/quasi-log-aesthetic.md on the standard output, its
// figures as SVG in FOLDER.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "keyline/analysis/lcg.h"
#include "keyline/analysis/profile.h"
#include "keyline/core/error.h"
#include "keyline/figure/drawing.h"
#include "keyline/figure/plot.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/quasi/quasi.h"

namespace {

using namespace keyline;
using core::Point2;
using figure::Drawing;
using lac::QuasiForm;
using lac::QuasiResult;

struct FormName {
  QuasiForm form;
  const char* name;
};
constexpr FormName kForms[] = {{QuasiForm::discrete_arc, "discretised, arc"},
                               {QuasiForm::discrete_angle, "discretised, angle"},
                               {QuasiForm::taylor_arc, "Taylor, arc"},
                               {QuasiForm::taylor_angle, "Taylor, angle"},
                               {QuasiForm::rational_cubic, "rational cubic"},
                               {QuasiForm::best, "best"}};
constexpr double kSlopes[] = {-1, 0, 1, 2};
constexpr int kDegrees[] = {6, 10, 20};
constexpr double kLambda = 0.4;
constexpr core::Interval kAngles{0, 1};

QuasiResult quasi(double alpha, double lambda, QuasiForm form, int degree,
                  std::optional<double> about = {}, bool automatic = false) {
  auto r = lac::quasi_log_aesthetic(alpha, lambda, kAngles, {form, degree, about, automatic});
  if (!r) throw core::InvalidInput(r.error().message);
  return *std::move(r);
}

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

const char* verdict(const QuasiResult& r) {
  if (r.monotone.answer == curve::MonotoneVerdict::yes) return "yes";
  return r.monotone.answer == curve::MonotoneVerdict::no ? "no" : "?";
}

// ---- Tables -------------------------------------------------------------------------------

/// Slope error, variance and bound of the deviation; marked where curvature is not monotone.
void print_cell(double alpha, const QuasiResult& r) {
  std::printf(" %+.0e, %.0e, %.0e%s |", r.lcg_slope - alpha, r.lcg_variance, r.deviation,
              r.monotone.answer == curve::MonotoneVerdict::yes ? "" : " (not monotone)");
}

void print_main_table() {
  for (const double alpha : kSlopes) {
    std::printf("\n| slope %g | degree 6 | degree 10 | degree 20 |\n|---|---|---|---|\n", alpha);
    for (const FormName& f : kForms) {
      std::printf("| %s |", f.name);
      for (const int degree : kDegrees) print_cell(alpha, quasi(alpha, kLambda, f.form, degree));
      std::printf("\n");
    }
    std::printf("| Taylor, automatic |");
    for (const int degree : kDegrees)
      print_cell(alpha, quasi(alpha, kLambda, QuasiForm::taylor_angle, degree, {}, true));
    std::printf("\n");
  }
}

void print_expansion_table() {
  std::printf("\n| alpha | variance, start | variance, end | deviation, start | end |\n");
  std::printf("|---|---|---|---|---|\n");
  for (const double alpha : {-1.0, 0.0, 0.5, 0.9, 1.0, 1.1, 1.5, 2.0}) {
    const QuasiResult a = quasi(alpha, kLambda, QuasiForm::taylor_angle, 6, 0.0);
    const QuasiResult b = quasi(alpha, kLambda, QuasiForm::taylor_angle, 6, 1.0);
    std::printf("| %g | %.1e | %.1e | %.1e | %.1e |\n", alpha, a.lcg_variance, b.lcg_variance,
                a.deviation, b.deviation);
  }
}

/// Handles of lengths 1 and `ratio` turning by one radian: ratio 1 is the circle.
void print_circle_table() {
  std::printf(
      "\n| P1P2 : P0P1 | Taylor, degree 5 | 6 | 8 | 10 | rational cubic | best, 6 | 10 |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const double ratio : {1.5, 1.2, 1.1, 1.05, 1.02, 1.01, 1.001}) {
    const Point2 p2{1 + ratio * std::cos(1.0), ratio * std::sin(1.0)};
    const auto cell = [&](QuasiForm form, int degree) {
      const auto r = lac::quasi_log_aesthetic({0, 0}, {1, 0}, p2, 0, {form, degree});
      std::printf(" %s |", r ? verdict(*r) : "none");
    };
    std::printf("| %g |", ratio);
    for (const int degree : {5, 6, 8, 10}) cell(QuasiForm::taylor_angle, degree);
    cell(QuasiForm::rational_cubic, 3);
    for (const int degree : {6, 10}) cell(QuasiForm::best, degree);
    std::printf("\n");
  }
}

// ---- Figures ------------------------------------------------------------------------------

struct Line {
  std::string name;
  std::vector<Point2> points;
  figure::Color color;
  double width = 1.4;
  std::vector<double> dash = {};
};

figure::Color color_of(std::size_t i) { return i == 5 ? figure::kInk : figure::palette(i); }

constexpr figure::Color kTarget{200, 30, 30};

/// Same scale both ways.
Drawing shape_panel(const std::string& title, const std::vector<Line>& lines, bool legend) {
  figure::Plot plot;
  plot.title = title;
  plot.width = 330;
  plot.height = 260;
  figure::Box box;
  for (const Line& l : lines)
    for (const Point2 p : l.points) include(box, p);
  const double side = 1.08 * std::max(width(box) / 1.25, height(box));
  const Point2 middle = mix(box.min, box.max, 0.5);
  plot.x.low = middle.x - 0.625 * side;
  plot.x.high = middle.x + 0.625 * side;
  plot.y.low = middle.y - 0.5 * side;
  plot.y.high = middle.y + 0.5 * side;
  for (const Line& l : lines) {
    figure::Series s;
    s.name = legend ? l.name : "";
    s.points = l.points;
    s.color = l.color;
    s.width = l.width;
    s.dash = l.dash;
    plot.series.push_back(s);
  }
  return draw(plot);
}

std::vector<Point2> graph_of(const curve::Bezier2& c) {
  std::vector<Point2> points;
  for (const auto& p : analysis::logarithmic_curvature_graph(c, 121).points)
    points.push_back({p.log_radius, p.log_rate});
  return points;
}

std::vector<Point2> graph_of(const lac::Segment& s) {
  std::vector<Point2> points;
  for (const auto& p : analysis::logarithmic_curvature_graph(s, 21).points)
    points.push_back({p.log_radius, p.log_rate});
  return points;
}

Drawing graph_panel(const std::string& title, const std::vector<Line>& lines) {
  figure::Plot plot;
  plot.title = title;
  plot.width = 330;
  plot.height = 260;
  plot.x.title = "ln \xCF\x81";
  plot.y.title = "ln(\xCF\x81 ds/d\xCF\x81)";
  for (const Line& l : lines) {
    figure::Series s;
    s.points = l.points;
    s.color = l.color;
    s.width = l.width;
    s.dash = l.dash;
    s.sets_range = &l == &lines.front();
    plot.series.push_back(s);
  }
  // The straight graph of the target sets the range; half of it is added above and below.
  const auto& first = lines.front().points;
  const double low = std::min(first.front().y, first.back().y);
  const double high = std::max(first.front().y, first.back().y);
  const double slack = std::max(0.5 * (high - low), 0.35);
  plot.y.low = low - slack;
  plot.y.high = high + slack;
  return draw(plot);
}

void save(const std::string& folder, const std::string& name, const Drawing& drawing) {
  std::ofstream(folder + "/" + name) << figure::write_svg(drawing);
}

Line target_line(const QuasiResult& r) {
  return {"log-aesthetic", sample(r.target, 41), kTarget, 3.2};
}
Line target_graph(const QuasiResult& r) {
  return {"log-aesthetic", graph_of(r.target), kTarget, 3.2};
}

/// [QLAC] Fig. 1: P_theta and P_s of degree 5 about the start.
void draw_angle_and_arc(const std::string& folder) {
  std::vector<Drawing> panels;
  for (const double alpha : {-1.0, 2.0}) {
    const QuasiResult angle = quasi(alpha, 0.49, QuasiForm::taylor_angle, 5, 0.0);
    const QuasiResult arc = quasi(alpha, 0.49, QuasiForm::taylor_arc, 5, 0.0);
    panels.push_back(
        shape_panel(number("slope %g, degree 5, about the start", alpha),
                    {target_line(angle),
                     {"tangent angle", curve::sample(angle.curve, 61), color_of(0)},
                     {"arc length", curve::sample(arc.curve, 61), color_of(2), 1.4, {5, 3}}},
                    true));
  }
  save(folder, "quasi-1-angle-and-arc.svg", tile(panels, 2));
}

/// [QLAC] Fig. 2: expanded at the start and at the end.
void draw_expansion_point(const std::string& folder) {
  std::vector<Drawing> panels;
  for (const double alpha : kSlopes) {
    const QuasiResult a = quasi(alpha, kLambda, QuasiForm::taylor_angle, 6, 0.0);
    const QuasiResult b = quasi(alpha, kLambda, QuasiForm::taylor_angle, 6, 1.0);
    panels.push_back(graph_panel(number("slope %g: start, end (dashed)", alpha),
                                 {target_graph(a),
                                  {"start", graph_of(a.curve), color_of(0)},
                                  {"end", graph_of(b.curve), color_of(2), 1.4, {5, 3}}}));
  }
  save(folder, "quasi-2-point-of-expansion.svg", tile(panels, 2));
}

/// [QLAC] Figs. 4-7: the forms at degrees 6, 10 and 20.
void draw_forms(const std::string& folder, double alpha, int figure_number) {
  std::vector<Drawing> shapes, graphs;
  for (const int degree : kDegrees) {
    const QuasiResult any = quasi(alpha, kLambda, QuasiForm::best, degree);
    std::vector<Line> curves{target_line(any)};
    std::vector<Line> lines{target_graph(any)};
    for (std::size_t i = 0; i < std::size(kForms); ++i) {
      if (kForms[i].form == QuasiForm::rational_cubic && degree > kDegrees[0]) continue;
      const QuasiResult r = quasi(alpha, kLambda, kForms[i].form, degree);
      curves.push_back({kForms[i].name, curve::sample(r.curve, 41), color_of(i)});
      lines.push_back({kForms[i].name, graph_of(r.curve), color_of(i)});
    }
    const std::string title = number("slope %g, ", alpha) + number("degree %g", degree);
    shapes.push_back(shape_panel(title, curves, degree == kDegrees[0]));
    graphs.push_back(graph_panel(title, lines));
  }
  shapes.insert(shapes.end(), graphs.begin(), graphs.end());
  save(folder, number("quasi-%g-forms.svg", figure_number), tile(shapes, 3));
}

/// [QLAC] Fig. 8: G1 Hermite interpolation at degree 8.
void draw_hermite(const std::string& folder) {
  std::vector<Drawing> shapes, curvatures, graphs;
  const Point2 p0{0, 0}, p1{2, 0}, p2{3, 1.5};
  for (const double alpha : {-1.0, 0.0, 2.0}) {
    const auto r = lac::quasi_log_aesthetic(p0, p1, p2, alpha, {QuasiForm::taylor_angle, 8});
    if (!r) continue;
    const std::string title = number("slope %g, degree 8", alpha) + number(", Λ = %.3f", r->lambda);
    shapes.push_back(shape_panel(title,
                                 {target_line(*r),
                                  {"handles", {p0, p1, p2}, figure::kRaw, 1, {4, 3}},
                                  {"quasi", curve::sample(r->curve, 61), color_of(0)}},
                                 false));
    figure::Plot plot;
    plot.title = "curvature";
    plot.width = 330;
    plot.height = 220;
    plot.x.title = "arc length";
    const auto mine = analysis::curvature_profile(r->curve, 81);
    const auto exact = analysis::curvature_profile(r->target, 41);
    figure::Series wanted, got;
    for (std::size_t i = 0; i < exact.curvature.size(); ++i)
      wanted.points.push_back({exact.arc_length[i], exact.curvature[i]});
    for (std::size_t i = 0; i < mine.curvature.size(); ++i)
      got.points.push_back({mine.arc_length[i], mine.curvature[i]});
    wanted.color = kTarget;
    wanted.width = 3.2;
    got.color = color_of(0);
    plot.series = {wanted, got};
    curvatures.push_back(draw(plot));
    graphs.push_back(graph_panel("logarithmic curvature graph",
                                 {target_graph(*r), {"quasi", graph_of(r->curve), color_of(0)}}));
  }
  shapes.insert(shapes.end(), curvatures.begin(), curvatures.end());
  shapes.insert(shapes.end(), graphs.begin(), graphs.end());
  save(folder, "quasi-8-hermite.svg", tile(shapes, 3));
}

/// Deviation against degree: what the forms are worth.
void draw_deviation(const std::string& folder) {
  std::vector<Drawing> panels;
  for (const double alpha : kSlopes) {
    figure::Plot plot;
    plot.title = number("slope %g", alpha);
    plot.width = 360;
    plot.height = 300;
    plot.x.title = "degree";
    plot.y.title = "bound of the deviation";
    plot.y.scale = figure::Scale::log10;
    for (std::size_t i = 0; i < std::size(kForms); ++i) {
      if (kForms[i].form == QuasiForm::rational_cubic) continue;
      figure::Series s;
      s.name = alpha == kSlopes[0] ? kForms[i].name : "";
      s.color = color_of(i);
      for (int degree = 5; degree <= 26; ++degree)
        s.points.push_back({1.0 * degree, quasi(alpha, kLambda, kForms[i].form, degree).deviation});
      plot.series.push_back(s);
    }
    panels.push_back(draw(plot));
  }
  save(folder, "quasi-deviation.svg", tile(panels, 2));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: quasi_figures FOLDER\n");
    return 2;
  }
  const std::string folder = arguments[1];
  print_main_table();
  print_expansion_table();
  print_circle_table();
  draw_angle_and_arc(folder);
  draw_expansion_point(folder);
  for (int i = 0; i < 4; ++i) draw_forms(folder, kSlopes[i], 4 + i);
  draw_hermite(folder);
  draw_deviation(folder);
}

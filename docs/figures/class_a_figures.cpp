// class_a_figures FOLDER: the figures of docs/guide/class-a.md as SVG in FOLDER, its tables on
// standard output. They redraw Figs. 2-5, 7 and 8 of Oya, Hanafusa and Aoyama.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "keyline/classa/edit.h"
#include "keyline/classa/free_form.h"
#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"
#include "keyline/core/error.h"
#include "keyline/figure/class_a_charts.h"
#include "keyline/figure/drawing.h"
#include "keyline/lac/hermite/clamped.h"
#include "keyline/presentation/class_a_figure.h"

namespace {

using namespace keyline;
using core::Point2;
using figure::Drawing;

const classa::MatrixCurve kGiven{{0, 0}, {1, 2}, 1, {core::kPi / 4, 1.05}, 3};

template <class T>
T value(core::Result<T> result) {
  if (!result) throw core::InvalidInput(result.error().message);
  return *std::move(result);
}

struct Output {
  std::string folder;
  void save(const std::string& name, const Drawing& drawing) const {
    std::ofstream file(folder + "/" + name + ".svg");
    file << figure::write_svg(drawing);
    if (!file) throw core::InvalidInput("cannot write " + name);
  }
};

std::vector<Point2> points_of(const curve::Bezier2& c) { return curve::sample(c, 201); }

Drawing pair_chart(const std::string& title, const curve::Bezier2& before,
                   const curve::Bezier2& after) {
  figure::BeforeAfter pair;
  pair.before.points = points_of(before);
  pair.after.points = points_of(after);
  pair.before_control = before.control;
  pair.after_control = after.control;
  figure::ChartOptions options;
  options.title = title;
  options.width = 470;
  options.largest_height = 420;
  return figure::before_after_chart(pair, options);
}

void figure_2(const Output& out) {
  figure::AlphaSPlane plane;
  plane.title = "The α–s plane";
  plane.subtitle = "shaded: Class A";
  out.save("class-a-2-plane", figure::alpha_s_chart(plane));
}

/// The minimum with the end held within a share of the chord, curves and plane.
void minimum_with(const Output& out, const std::string& name, const std::string& title,
                  double share) {
  classa::EditOptions options;
  const auto given = classa::to_bezier(kGiven);
  options.cav.end_tolerance = share * distance(given.control.front(), given.control.back());
  const auto edited = value(classa::edit(given, options));
  const classa::Evaluation before{{given, true}, edited.before, {}, {}};
  const classa::Evaluation after{{edited.curve, true}, edited.after, {}, {}};
  const std::vector<Drawing> both{
      pair_chart(title, given, edited.curve),
      presentation::plane_chart({{"given", &before}, {"found", &after}}, options.cav, edited.path)};
  out.save(name, figure::tile(both, 2));
  std::printf("| %s | %.4f | %.4f | %.4f | %.4f |\n", title.c_str(), edited.target.alpha,
              edited.target.s, edited.before.energy, edited.after.energy);
}

void figure_5(const Output& out) {
  figure::AlphaSPlane plane;
  plane.title = "Types of curves";
  plane.subtitle = "1 at the minimum, 2 Class A, 3 outside, 4 several places; type 5 has none";
  classa::CavOptions options;
  options.end_tolerance = 0.01;
  const auto given = value(classa::cav(kGiven, options));
  plane.points = {{"1", given.minimum->alpha, given.minimum->s, figure::Marker::cross},
                  {"2", 0.35, 1.75},
                  {"3", given.matrix->alpha, given.matrix->s},
                  {"4", 0.55, 0.8, figure::Marker::circle},
                  {"4", 0.9, 1.2, figure::Marker::circle}};
  out.save("class-a-5-types", figure::alpha_s_chart(plane));
}

/// Figs. 7 and 8, and the way between them.
void figures_7_and_8(const Output& out) {
  classa::EditOptions options;
  options.cav.end_tolerance = 0.01;
  const auto given = classa::to_bezier(kGiven);
  const auto edited = value(classa::edit(given, options));
  const classa::Evaluation before{{given, true}, edited.before, {}, {}};
  const classa::Evaluation after{{edited.curve, true}, edited.after, {}, {}};
  out.save("class-a-7-plane",
           presentation::plane_chart({{"given (π/4, 1.05)", &before}, {"edited", &after}},
                                     options.cav, edited.path));
  out.save("class-a-8-curves", pair_chart("Given and edited", given, edited.curve));
}

void table_of_amounts() {
  std::printf("\n| amount | α | s | energy | CAV | monotone |\n|---|---|---|---|---|---|\n");
  for (const double amount : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    classa::EditOptions options;
    options.cav.end_tolerance = 0.01;
    options.amount = amount;
    const auto edited = value(classa::edit(classa::to_bezier(kGiven), options));
    std::printf("| %.2f | %.4f | %.4f | %.4f | %.3f | %s |\n", amount, edited.after.matrix->alpha,
                edited.after.matrix->s, edited.after.energy, edited.after.cav,
                edited.after.monotone.answer == curve::MonotoneVerdict::yes ? "yes" : "no");
  }
}

/// Curves from the handles (0,0), (1.3,0), (3,1.5): log-aesthetic of four slopes, a cubic as CAD
/// systems draw it, and the Class A curve of least energy with its ends and start tangent.
void compare(const Output& out) {
  struct Named {
    std::string name;
    classa::Approximation curve;
  };
  std::vector<Named> all;
  const curve::Bezier2 cad{{{0, 0}, {1.3 * 2 / 3, 0}, {1.3 + 1.7 / 3, 0.5}, {3, 1.5}}, {}};
  all.push_back({"CAD cubic", {cad, true}});
  for (const double slope : {-1.0, 0.0, 1.0, 2.0}) {
    const auto chain = value(lac::solve_g1_chain({0, 0}, {1.3, 0}, {3, 1.5}, slope)).chain;
    char name[32];
    std::snprintf(name, sizeof name, "slope %g", slope);
    all.push_back({name, value(classa::approximate(curve::PlanarView(chain), 1e-3))});
  }
  classa::EditOptions exact;
  exact.cav.end_tolerance = 0;
  all.push_back({"least energy", {value(classa::edit(cad, exact)).curve, true}});
  std::printf(
      "\n| curve | degree | type | CAV | nearest away | α | s | CAV of the nearest |\n"
      "|---|---|---|---|---|---|---|---|\n");
  std::vector<classa::Evaluation> evaluations;
  for (const Named& c : all) {
    evaluations.push_back(value(classa::evaluate_curve(c.curve, exact.cav)));
    const classa::Evaluation& e = evaluations.back();
    const classa::CurveValue& place = e.nearest_value ? *e.nearest_value : e.value;
    std::printf("| %s | %d | %d | %.3g | %.2g | %.3f | %.3f | %.3f |\n", c.name.c_str(),
                e.value.degree, e.value.type, e.value.cav, e.nearest ? e.nearest->distance : 0.0,
                place.matrix->alpha, place.matrix->s, place.cav);
  }
  std::vector<presentation::PlaneEntry> entries;
  for (std::size_t i = 0; i < all.size(); ++i) entries.push_back({all[i].name, &evaluations[i]});
  out.save("class-a-compare", presentation::plane_chart(entries, exact.cav));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "class_a_figures FOLDER\n");
    return 2;
  }
  const Output out{argv[1]};
  figure_2(out);
  std::printf("| end held | α | s | energy given | energy found |\n|---|---|---|---|---|\n");
  minimum_with(out, "class-a-3-loose", "End within 0.6 of the chord", 0.6);
  minimum_with(out, "class-a-4-held", "End within 0.002 of the chord", 0.002);
  figure_5(out);
  figures_7_and_8(out);
  table_of_amounts();
  compare(out);
  return 0;
}

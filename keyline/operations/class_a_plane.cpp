#include "keyline/operations/class_a_plane.h"

#include <cmath>

#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"

namespace keyline::operations {
namespace {

using core::Point2;

constexpr int kSteps = 80;        // of the grid, each way: contours look smooth at 500 pixels
constexpr int kReachSteps = 200;  // of the line of curves that reach the end
constexpr core::Interval kScales{1e-3, 1e3};  // in which that line is sought

std::vector<std::vector<double>> energy_grid(int degree, double chord, const ClassAPlane& plane) {
  std::vector<std::vector<double>> rows;
  for (int j = 0; j <= kSteps; ++j) {
    std::vector<double>& row = rows.emplace_back();
    for (int i = 0; i <= kSteps; ++i) {
      const classa::ControlMatrix m{at(plane.alpha, static_cast<double>(i) / kSteps),
                                    at(plane.s, static_cast<double>(j) / kSteps)};
      const double reach = norm(classa::end_in_frame(m, degree));
      row.push_back(classa::matrix_energy(m, degree).value * reach / chord);
    }
  }
  return rows;
}

std::vector<Point2> reach_line(const classa::CurveReading& reading, const ClassAPlane& plane) {
  const classa::EnergyConditions& c = reading.conditions;
  const double side = reading.matrix.left ? 1 : -1;
  double angle = side * core::angle_between(c.tangent, c.chord);
  if (angle < 0) angle += 2 * core::kPi;  // it turns on past the tangent's backward direction
  std::vector<Point2> line;
  for (int i = 1; i <= kReachSteps && angle > 0; ++i) {
    const double alpha = plane.alpha.high * i / kReachSteps;
    const double scale = classa::scale_at_end_angle(alpha, angle, c.degree, kScales);
    const bool met = std::abs(classa::end_angle({alpha, scale}, c.degree) - angle) < 1e-9;
    if (met && contains(plane.s, scale)) line.push_back({alpha, scale});
  }
  return line;
}

}  // namespace

ClassAPlane class_a_plane(const classa::CurveReading& reading, double alpha_max, core::Interval s) {
  ClassAPlane plane;
  plane.alpha = {0, alpha_max};
  plane.s = s;
  plane.energy = energy_grid(reading.conditions.degree, norm(reading.conditions.chord), plane);
  for (int i = 0; i <= kSteps; ++i) {
    const double alpha = at(plane.alpha, static_cast<double>(i) / kSteps);
    plane.growing.push_back({alpha, 1 / std::cos(alpha)});
    plane.falling.push_back({alpha, std::cos(alpha)});
  }
  plane.reach = reach_line(reading, plane);
  return plane;
}

}  // namespace keyline::operations

#include "keyline/analysis/piece_frame.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::analysis::detail {
namespace {

/// Turning at arc length s: cubic Hermite between samples, with curvature as derivative.
double turning_at(const CurvatureProfile& p, double s) {
  const auto it = std::upper_bound(p.arc_length.begin() + 1, p.arc_length.end() - 1, s);
  const std::size_t i = static_cast<std::size_t>(it - p.arc_length.begin());
  const double ds = p.arc_length[i] - p.arc_length[i - 1];
  if (!(ds > 0)) return p.turning[i];
  const double u = (s - p.arc_length[i - 1]) / ds;
  if (u <= 1e-9) return p.turning[i - 1];
  if (u >= 1 - 1e-9) return p.turning[i];
  const double rise = p.turning[i] - p.turning[i - 1];
  const double a = ds * p.curvature[i - 1] - rise;
  const double b = rise - ds * p.curvature[i];
  return p.turning[i - 1] + u * rise + u * (1 - u) * ((1 - u) * a + u * b);
}

}  // namespace

PieceFrame::PieceFrame(const CurvatureProfile& piece) : turning_(kCells) {
  const double first = piece.arc_length.front();
  length_ = piece.arc_length.back() - first;
  double before = turning_at(piece, first);
  for (int i = 0; i < kCells; ++i) {
    const double now = turning_at(piece, first + length_ * (i + 1) / kCells);
    turning_[i] = now - before;
    before = now;
  }
  constexpr int half = kCells / 2;
  sign_ = turning_.sum() < 0 ? -1 : 1;
  turning_ *= sign_;
  reversed_ = turning_.tail(half).sum() > turning_.head(half).sum();
  if (reversed_) turning_.reverseInPlace();
  make_modes();
}

PieceFrame PieceFrame::coarse() const {
  PieceFrame few;
  few.length_ = length_;
  few.reversed_ = reversed_;
  few.sign_ = sign_;
  few.turning_ = turning_.reshaped(cells() / kFewCells, kFewCells).colwise().sum().transpose();
  few.make_modes();
  return few;
}

double PieceFrame::mean_curvature(int from, int to) const {
  return turning_.segment(from, to - from).mean() * cells();
}

void PieceFrame::make_modes() {
  const int n = cells();
  core::Point2 p;
  double angle = -turning_.sum() / 2;
  std::vector<core::Point2> points = {p};
  core::Vector2 centre;
  for (int i = 0; i < n; ++i) {
    const core::Vector2 along = core::unit_vector(angle + turning_[i] / 2);
    normals_.push_back(core::perpendicular_left(along));
    p = p + (1.0 / n) * along;
    angle += turning_[i];
    points.push_back(p);
    centre = centre + core::Vector2{p.x, p.y} / (n + 1.0);
  }
  turn_mode_.resize(2 * (n + 1));
  for (int i = 0; i <= n; ++i) {
    const core::Vector2 moved =
        core::perpendicular_left(core::Vector2{points[i].x, points[i].y} - centre);
    turn_mode_[2 * i] = moved.x;
    turn_mode_[2 * i + 1] = moved.y;
  }
  turn_mode_.normalize();
}

Eigen::VectorXd PieceFrame::displacement(const Eigen::VectorXd& model_turning) const {
  const int n = cells();
  Eigen::VectorXd r(2 * (n + 1));
  core::Vector2 moved;
  core::Vector2 mean;
  double turned = 0;
  r[0] = 0;
  r[1] = 0;
  const double cell = 1.0 / n;
  for (int i = 0; i < n; ++i) {
    const double more = model_turning[i] - turning_[i];
    moved = moved + ((turned + more / 2) * cell) * normals_[i];
    turned += more;
    r[2 * i + 2] = moved.x;
    r[2 * i + 3] = moved.y;
    mean = mean + moved;
  }
  mean = mean / (n + 1.0);
  for (int i = 0; i <= n; ++i) {
    r[2 * i] -= mean.x;
    r[2 * i + 1] -= mean.y;
  }
  r -= turn_mode_ * turn_mode_.dot(r);
  return r / std::sqrt(n + 1.0);
}

}  // namespace keyline::analysis::detail

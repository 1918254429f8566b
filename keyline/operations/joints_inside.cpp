#include "keyline/operations/joints_inside.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "keyline/document/cusped.h"

namespace keyline::operations {
namespace {

bool is_steep(const lac::Piece& piece, double here, double there) {
  return here == 0 && there != 0 && piece.alpha < -1;
}

bool is_steep_before(const lac::Piece& p) {
  return is_steep(p, p.curvature_end, p.curvature_start);
}
bool is_steep_after(const lac::Piece& p) { return is_steep(p, p.curvature_start, p.curvature_end); }

constexpr double kSame = 1e-12;  // of the parameter

/// Where the rate of curvature is infinite on a side.
std::vector<double> steep_places(const document::Path& path) {
  std::vector<double> places;
  const auto count = static_cast<double>(path.curves.size());
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    const auto* chain = std::get_if<lac::Chain>(&path.curves[i].value);
    if (!chain) continue;
    const double length = lac::arc_length(*chain);
    double s = 0;
    const auto add = [&] { places.push_back((static_cast<double>(i) + s / length) / count); };
    for (const lac::Piece& piece : chain->pieces) {
      if (is_steep_after(piece)) add();
      s += piece.length;
      if (is_steep_before(piece)) add();
    }
  }
  return places;
}

bool is_near(const std::vector<double>& places, double t) {
  return std::ranges::any_of(places, [t](double p) { return std::abs(p - t) <= kSame; });
}

}  // namespace

std::vector<analysis::InnerJoint> joints_inside(const document::Path& path,
                                                const analysis::ContinuityTolerance& tolerance) {
  const document::CuspedPath cusped(path);
  auto joints = analysis::inner_continuity(analysis::CurveView(cusped), tolerance);
  const std::vector<double> steep = steep_places(path);
  for (auto& [t, joint] : joints)
    if (is_near(steep, t)) joint = without_rate(joint);
  return joints;
}

bool is_steep_at_start(const document::PlanarCurve& c) {
  const auto* chain = std::get_if<lac::Chain>(&c.value);
  return chain && is_steep_after(chain->pieces.front());
}

bool is_steep_at_end(const document::PlanarCurve& c) {
  const auto* chain = std::get_if<lac::Chain>(&c.value);
  return chain && is_steep_before(chain->pieces.back());
}

analysis::JointContinuity without_rate(analysis::JointContinuity joint) {
  joint.curvature_rate_jump = joint.relative_curvature_rate_jump = std::nullopt;
  joint.order = std::min(joint.order, 2);
  return joint;
}

}  // namespace keyline::operations

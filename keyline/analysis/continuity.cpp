#include "keyline/analysis/continuity.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/curve/arriving.h"

namespace keyline::analysis {
namespace {

struct Jump {
  std::optional<double> absolute, relative;
};

Jump jump(double before, double after, double least_size) {
  if (!std::isfinite(before) || !std::isfinite(after)) return {};
  const double size = std::max({std::abs(before), std::abs(after), least_size});
  return {after - before, std::abs(after - before) / size};
}

}  // namespace

JointContinuity joint_continuity(const curve::Jet2& end, const curve::Jet2& start, double scale,
                                 const ContinuityTolerance& tolerance) {
  JointContinuity joint;
  joint.position = core::mix(end.point, start.point, 0.5);
  joint.gap = core::distance(end.point, start.point);
  joint.angle = core::wrap_angle(curve::tangent_angle(start) - curve::arriving_angle(end));
  const double unit = scale > 0 ? 1 / scale : 1;
  const Jump kappa = jump(curve::curvature(end), curve::curvature(start), unit);
  const Jump rate = jump(curve::curvature_rate(end), curve::curvature_rate(start), unit * unit);
  joint.curvature_jump = kappa.absolute;
  joint.relative_curvature_jump = kappa.relative;
  joint.curvature_rate_jump = rate.absolute;
  joint.relative_curvature_rate_jump = rate.relative;
  if (!(joint.gap <= tolerance.gap)) return joint;
  joint.order = 0;
  if (!(std::abs(joint.angle) <= tolerance.angle)) return joint;
  joint.order = 1;
  if (!kappa.relative || *kappa.relative > tolerance.curvature) return joint;
  joint.order = 2;
  if (rate.relative && *rate.relative <= tolerance.curvature_rate) joint.order = 3;
  return joint;
}

std::vector<JointContinuity> continuity(const std::vector<CurveView>& curves, bool closed,
                                        const ContinuityTolerance& tolerance) {
  std::vector<JointContinuity> joints;
  std::vector<double> lengths;
  for (const CurveView& c : curves) lengths.push_back(ArcLengthTable(c).length());
  const std::size_t n = curves.size();
  for (std::size_t i = 0; i < n && (closed || i + 1 < n); ++i) {
    const std::size_t next = (i + 1) % n;
    joints.push_back(joint_continuity(curves[i].jet_at(1), curves[next].jet_at(0),
                                      std::min(lengths[i], lengths[next]), tolerance));
  }
  return joints;
}

std::vector<InnerJoint> inner_continuity(const CurveView& curve,
                                         const ContinuityTolerance& tolerance) {
  std::vector<InnerJoint> joints;
  const ArcLengthTable table(curve);
  const auto& breaks = curve.breaks();
  std::optional<double> before;  // where the piece before ends
  double length = 0;             // up to there
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double t = breaks[i];
    const double from = std::exchange(length, table.length_at(breaks[i + 1]));
    if (!(length > from)) continue;
    if (before)
      joints.push_back({t, joint_continuity(curve.jet_at(std::nextafter(*before, 0.0)),
                                            curve.jet_at(t), table.length(), tolerance)});
    before = breaks[i + 1];
  }
  return joints;
}

}  // namespace keyline::analysis

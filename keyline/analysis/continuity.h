#pragma once

#include <optional>
#include <vector>

#include "keyline/analysis/profile.h"
#include "keyline/core/describe.h"

namespace keyline::analysis {

/// How far apart two ends may be and still count as joined. Curvature and its rate are compared
/// relative to the larger of the two (curvature no smaller than 1 / scale, its rate than
/// 1 / scale^2), where scale is the length of the shorter curve.
struct ContinuityTolerance {
  double gap = 1e-6;             ///< in the curves' unit
  double angle = 1e-4;           ///< radians
  double curvature = 1e-3;       ///< relative
  double curvature_rate = 1e-2;  ///< relative
  static constexpr auto describe() {
    return core::fields(
        core::field<&ContinuityTolerance::gap>("largest gap that still joins")
            .in("length")
            .within(core::at_least(0)),
        core::field<&ContinuityTolerance::angle>("largest angle of a G1 joint")
            .in("radian")
            .within(core::at_least(0)),
        core::field<&ContinuityTolerance::curvature>("largest relative jump of a G2 joint")
            .within(core::at_least(0)),
        core::field<&ContinuityTolerance::curvature_rate>("the same of a G3 joint")
            .within(core::at_least(0)));
  }
};

/// What happens where one curve ends and the next begins. order is 0…3 for G0…G3, -1 where there
/// is a gap. angle is the turn from the end tangent to the start tangent in (-pi, pi]; the jumps
/// are start of the next less end of the one before, absolute, and relative as compared; empty
/// where one of the two is infinite.
struct JointContinuity {
  core::Point2 position;
  double gap = 0;
  double angle = 0;
  std::optional<double> curvature_jump = 0;
  std::optional<double> curvature_rate_jump = 0;
  std::optional<double> relative_curvature_jump = 0;
  std::optional<double> relative_curvature_rate_jump = 0;
  int order = -1;
  static constexpr auto describe() {
    return core::fields(
        core::field<&JointContinuity::position>("where the joint is"),
        core::field<&JointContinuity::gap>("between the two ends").in("length"),
        core::field<&JointContinuity::angle>("from one tangent to the next").in("radian"),
        core::field<&JointContinuity::curvature_jump>(
            "next less before; null where one is infinite")
            .in("1/length")
            .null_if_empty(),
        core::field<&JointContinuity::curvature_rate_jump>("of the rate, likewise")
            .in("1/length^2")
            .null_if_empty(),
        core::field<&JointContinuity::relative_curvature_jump>("relative to the larger curvature")
            .null_if_empty());
  }
};

/// The joint between two ends; scale > 0 as above. Where a curvature is not finite (a cusp) the
/// order is at most 1, where a rate is not, at most 2.
JointContinuity joint_continuity(const curve::Jet2& end, const curve::Jet2& start, double scale,
                                 const ContinuityTolerance& tolerance = {});

/// One entry per joint of the curves taken in order, the last one closing the loop if `closed`.
std::vector<JointContinuity> continuity(const std::vector<CurveView>& curves, bool closed = false,
                                        const ContinuityTolerance& tolerance = {});

struct InnerJoint {
  double t = 0;  ///< the curve's parameter
  JointContinuity joint;
};

/// One entry per breakpoint inside a curve; pieces of no length between two are none, so that their
/// neighbours meet. Lengths are compared with the curve's.
std::vector<InnerJoint> inner_continuity(const CurveView& curve,
                                         const ContinuityTolerance& tolerance = {});

template <curve::PlanarCurve C>
std::vector<JointContinuity> continuity(const std::vector<C>& curves, bool closed = false,
                                        const ContinuityTolerance& tolerance = {}) {
  std::vector<CurveView> views;
  for (const C& c : curves) views.push_back(view(c));
  return continuity(views, closed, tolerance);
}

}  // namespace keyline::analysis

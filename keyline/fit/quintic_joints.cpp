#include "keyline/fit/quintic_joints.h"

#include "keyline/core/angle.h"

namespace keyline::fit {

using core::Vector2;

JointedQuintic piece_of(const JointedQuintics& chain, std::size_t piece) {
  const QuinticJoint& p = chain.joints[piece];
  const QuinticJoint& q = chain.end_of(piece);
  const QuinticLengths& l = chain.lengths[piece];
  const Vector2 t0 = core::unit_vector(p.direction);
  const Vector2 t1 = core::unit_vector(q.direction);
  JointedQuintic made{{}, t0, t1, p.curvature, q.curvature, l};
  QuinticHandles& h = made.control;
  h[0] = p.place;
  h[1] = p.place + l.a * t0;
  h[2] = h[1] + l.c * t0 + (1.25 * p.curvature * l.a * l.a) * core::perpendicular_left(t0);
  h[5] = q.place;
  h[4] = q.place - l.b * t1;
  h[3] = h[4] - l.d * t1 + (1.25 * q.curvature * l.b * l.b) * core::perpendicular_left(t1);
  return made;
}

std::vector<JointedQuintic> pieces_of(const JointedQuintics& chain) {
  std::vector<JointedQuintic> pieces;
  pieces.reserve(chain.lengths.size());
  for (std::size_t k = 0; k < chain.lengths.size(); ++k) pieces.push_back(piece_of(chain, k));
  return pieces;
}

QuinticRow sensitivity(const JointedQuintic& piece, const QuinticWeights& b) {
  const QuinticLengths& l = piece.lengths;
  const Vector2 t0 = piece.start_tangent;
  const Vector2 n0 = core::perpendicular_left(t0);
  const Vector2 t1 = piece.end_tangent;
  const Vector2 n1 = core::perpendicular_left(t1);
  const double k0 = piece.start_curvature;
  const double k1 = piece.end_curvature;
  const double start = b[0] + b[1] + b[2];
  const double end = b[3] + b[4] + b[5];
  QuinticRow row{};
  row[0] = {start, 0};
  row[1] = {0, start};
  row[2] = (b[1] * l.a + b[2] * (l.a + l.c)) * n0 - (b[2] * 1.25 * k0 * l.a * l.a) * t0;
  row[3] = (b[2] * 1.25 * l.a * l.a) * n0;
  row[4] = (b[1] + b[2]) * t0 + (b[2] * 2.5 * k0 * l.a) * n0;
  row[5] = -(b[3] + b[4]) * t1 + (b[3] * 2.5 * k1 * l.b) * n1;
  row[6] = b[2] * t0;
  row[7] = -b[3] * t1;
  row[8] = {end, 0};
  row[9] = {0, end};
  row[10] = -(b[4] * l.b + b[3] * (l.b + l.d)) * n1 - (b[3] * 1.25 * k1 * l.b * l.b) * t1;
  row[11] = (b[3] * 1.25 * l.b * l.b) * n1;
  return row;
}

}  // namespace keyline::fit

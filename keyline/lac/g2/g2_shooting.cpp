#include "keyline/lac/g2/g2_shooting.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/piece_shape.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

constexpr double kAccepted = 2e-13;
constexpr int kIterations = 30;
/// Powers below this are flat but for a jump at zero, and a step in them means nothing: pieces of
/// such slopes hardly bend near an inflection, and joints keep their sign.
constexpr double kFlattest = 1e-3;

/// Variables of the joints' curvatures; those of the ends are not used.
using Variables = std::array<CurvatureVariable, 4>;

Variables variables_of(const UnitG2& request, const ShortChain& chain) {
  Variables v;
  for (int i = 1; i < chain.pieces; ++i) {
    const double beside =
        std::max(std::abs(chain.curvature[i - 1]), std::abs(chain.curvature[i + 1]));
    if (request.alpha >= 0 || (request.alpha > -kFlattest && chain.curvature[i] != 0)) {
      v[i].step = CurvatureStep::logarithm;
    } else if (request.alpha != -1 && std::abs(chain.curvature[i]) < 0.3 * beside) {
      v[i] = {CurvatureStep::power, -request.alpha};
    }
  }
  return v;
}

/// The chain walked from its start: misses at the end and the matrix of their derivatives.
struct Walk {
  Miss miss{};
  std::array<std::array<double, 3>, 3> by{};  ///< by[row][unknown]
};

Walk walk(const UnitG2& request, const ShortChain& chain, const Variables& variables) {
  std::array<PieceShape, 3> shape;
  std::array<Vector2, 4> at{};
  std::array<double, 4> angle{request.from, 0, 0, 0};
  for (int i = 0; i < chain.pieces; ++i) {
    const double length = chain.length_of(i);
    shape[i] = piece_shape(request.alpha, chain.curvature[i] * length,
                           chain.curvature[i + 1] * length, variables[i], variables[i + 1]);
    at[i + 1] = at[i] + length * core::rotate_ccw(shape[i].chord, angle[i]);
    angle[i + 1] = angle[i] + shape[i].turning;
  }
  const Vector2 end = at[chain.pieces];
  Walk result;
  result.miss = {end.x - 1, end.y, angle[chain.pieces] - request.to};
  const auto add = [&](int i, int unknown, Vector2 local, double turned) {
    const Vector2 lever = core::perpendicular_left(end - at[i + 1]);
    const Vector2 d = core::rotate_ccw(local, angle[i]) + turned * lever;
    result.by[0][unknown] += d.x;
    result.by[1][unknown] += d.y;
    result.by[2][unknown] += turned;
  };
  for (int i = 0; i < chain.pieces; ++i) {
    const double length = chain.length_of(i);
    // In shape the variables are those of kappa * length.
    const auto scale = [&](const CurvatureVariable& v) {
      return v.step == CurvatureStep::linear  ? length
             : v.step == CurvatureStep::power ? std::pow(length, v.power)
                                              : 1.0;
    };
    for (int side = 0; side < 2; ++side) {
      const int joint = i + side;
      if (joint == 0 || joint == chain.pieces) continue;
      const double s = scale(variables[joint]);
      add(i, joint - 1, length * s * shape[i].chord_by[side], s * shape[i].turning_by[side]);
    }
    const int unknown = chain.pieces == 3 ? 2 : 1 + i;
    add(i, unknown, length * shape[i].chord_by_length, shape[i].turning);
  }
  return result;
}

ShortChain moved(const ShortChain& chain, const Variables& variables, const Miss& step, double by) {
  ShortChain next = chain;
  for (int i = 1; i < chain.pieces; ++i) {
    next.curvature[i] = stepped(chain.curvature[i], by * step[i - 1], variables[i]);
  }
  if (chain.pieces == 3) {
    next.length[1] *= std::exp(by * step[2]);
  } else {
    next.length[0] *= std::exp(by * step[1]);
    next.length[1] *= std::exp(by * step[2]);
  }
  return next;
}

/// Largest share of the Newton step that changes no length by more than a factor of two or so and
/// no joint by more than a radian over the chord.
double allowed_share(const ShortChain& chain, const Variables& variables, const Miss& step) {
  double share = 1;
  const auto bound = [&](double value, double limit) {
    if (std::abs(value) > limit) share = std::min(share, limit / std::abs(value));
  };
  for (int i = 0; i < 3; ++i) {
    const bool curvature = i + 1 < chain.pieces;
    const bool linear = curvature && variables[i + 1].step == CurvatureStep::linear;
    bound(step[i], linear ? 4 : 0.8);
  }
  return share;
}

/// Whether the longer arm of a piece bends more than largest_bend allows.
bool astray(double alpha, double k0, double k1, double length) {
  const double high = std::max(std::abs(k0), std::abs(k1)) * length;
  if (high < largest_bend(alpha)) return false;
  if (!(alpha < 0 && k0 * k1 < 0)) return true;
  const double low = std::min(std::abs(k0), std::abs(k1)) * length;
  return !(high < largest_bend(alpha) * (1 + std::pow(low / high, -alpha)));
}

bool within_reason(const UnitG2& request, const ShortChain& chain) {
  double total = 0;
  for (int i = 0; i < chain.pieces; ++i) {
    const double length = chain.length_of(i);
    if (!(length > 1e-7 && length < request.longest)) return false;
    if (astray(request.alpha, chain.curvature[i], chain.curvature[i + 1], length)) return false;
    if (request.alpha >= 0 && !(chain.curvature[i + 1] != 0)) return false;
    total += length;
  }
  return total < request.longest;
}

}  // namespace

std::optional<ShortChain> shoot(const UnitG2& request, ShortChain chain, double* residual) {
  if (!within_reason(request, chain)) return std::nullopt;
  Variables variables = variables_of(request, chain);
  Walk here = walk(request, chain, variables);
  double size = size_of(here.miss);
  for (int i = 0; i < kIterations && size > 4e-16; ++i) {
    Miss step = here.miss;
    auto matrix = here.by;
    if (!solve_small(matrix, step)) break;
    for (double& s : step) s = -s;
    double share = allowed_share(chain, variables, step);
    bool better = false;
    const int tries = size < 1e-12 ? 1 : 7;  // down at rounding a shorter step gains nothing
    for (int halving = 0; halving < tries && !better; ++halving, share *= 0.5) {
      const ShortChain next = moved(chain, variables, step, share);
      if (!within_reason(request, next)) continue;
      const Variables next_variables = variables_of(request, next);
      const Walk there = walk(request, next, next_variables);
      if (!(size_of(there.miss) < (1 - 0.1 * share) * size)) continue;
      better = true;
      chain = next;
      variables = next_variables;
      here = there;
    }
    if (!better) break;
    size = size_of(here.miss);
  }
  if (residual) *residual = size;
  if (!(size <= kAccepted)) return std::nullopt;
  return chain;
}

}  // namespace keyline::lac::detail

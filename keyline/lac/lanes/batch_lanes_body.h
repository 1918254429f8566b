#pragma once

#include "keyline/lac/lanes/batch_lanes.h"
#include "keyline/lac/lanes/chord_lanes_body.h"
#include "keyline/lac/lanes/clothoid_lanes_body.h"

/// Internals: included once for each instruction set by a source compiled for it. The steps are
/// those of quick_search.cpp, where they are explained.
namespace keyline::lac::detail {

template <class Batch>
struct LaneProblem {
  using Mask = typename Batch::batch_bool_type;
  Batch a, b, k, sharpness, sign;
  Batch theta, half_x, half_y, axis_x, axis_y, slope, bend;

  LaneProblem(const Batch& alpha, const Batch& turning, const Batch& excess) : theta(turning) {
    const Mask negative = alpha < Batch(0.0);
    a = abs(alpha);
    b = select(negative, Batch(1.0) - alpha, alpha - Batch(1.0));
    k = min(a, abs(b));
    sharpness = max(a, abs(b));
    sign = select(negative, Batch(1.0), Batch(-1.0));
    const Batch h = Batch(0.5) * theta;
    numeric::simd::sincos_short(h, half_y, half_x);
    Batch sine;
    numeric::simd::sincos_short(excess, sine, axis_x);
    axis_y = sign * sine;
    const Batch z = h * h;
    const Batch series = h * numeric::simd::horner(z, 1.0 / 6, 1.0 / 90, 1.0 / 945, 1.0 / 9450);
    slope = select(h < Batch(0.1), series, (Batch(1.0) - h * half_x / half_y) / theta);
  }

  /// The first guess of q; sets bend.
  Batch guess(const Batch& excess) {
    const Batch growing = min(Batch(1.0), Batch(2.5) * a);
    const Batch falling = Batch(0.8) * b / (Batch(1.0) + b);
    const Batch share = select(b > a, growing, select(b > Batch(0.0), falling, Batch(0.0)));
    const Batch spread = a + abs(b);
    const Batch grown = fma(share, Batch(12.0) * slope / theta - Batch(1.0), Batch(1.0));
    const Batch c = Batch(0.5) * theta / spread * grown;
    const Batch y = min(excess / c, Batch(0.98));
    const Batch s = a + b;
    const Batch end = min(Batch(2.0), spread / max(Batch(6.0) * k, Batch(1e-9)));
    const Batch twice = end + end;
    const Batch cubic =
        Batch(0.3) * (Batch(1.0) + s * s) / (spread * spread) - twice * Batch(1.0 / 3);
    const Batch square = y * y;
    const Batch open = Batch(1.0) / (Batch(1.0) - square);
    const Batch first = fma(twice, open - Batch(1.0), fma(Batch(3.0) * cubic, square, Batch(1.0)));
    const Batch second = y * (Batch(2.0) * twice * open * open + Batch(6.0) * cubic);
    const Batch scale = c / slope;
    bend = second / (first * first * scale);
    const Batch rest = fma(square, cubic, Batch(1.0) - twice);
    return scale * (y * rest + end * log((Batch(1.0) + y) / (Batch(1.0) - y)));
  }
};

template <class Batch>
inline LaneSums<Batch> lane_sums(const LaneProblem<Batch>& p, const Batch& q, const Batch& scale,
                                 int nodes) {
  const GaussNodes& rule = gauss_nodes(nodes);
  const LaneDecay<Batch> b(p.b);
  const Batch centre = Batch(0.5) * p.theta;
  LaneSums<Batch> sums;
  for (int i = 0; i < nodes; ++i) {
    const Batch lambda = Batch(rule.nodes[i]) * q;
    const Batch weight = Batch(rule.weights[i]) * numeric::simd::exp(-p.a * lambda);
    const Batch angle = scale * b.integral(lambda);
    sums.add(weight, angle, angle - centre);
  }
  return sums;
}

template <class Batch>
struct LaneStep {
  Batch miss, change, length, length_slope;
  typename Batch::batch_bool_type fits;  ///< within what unguarded steps can do
};

template <class Batch>
inline LaneStep<Batch> lane_step(const LaneProblem<Batch>& p, const Batch& q, const Batch& reach,
                                 int nodes) {
  const Batch arc = LaneDecay<Batch>(p.a).integral(q);
  const Batch angle = LaneDecay<Batch>(p.b).integral(q);
  const Batch arc_rest = fnma(p.a, arc, Batch(1.0));
  const Batch angle_rest = fnma(p.b, angle, Batch(1.0));
  const Batch unit = Batch(1.0) / arc;
  const LaneSums<Batch> s = lane_sums(p, q, p.theta / angle, nodes);
  const Batch width = q * unit;
  const Batch x = s.x * width;
  const Batch y = s.y * width;
  const Batch angle_end = angle_rest / angle * width;
  const Batch arc_end = arc_rest * unit;
  const auto circle = reach - p.theta < Batch(1e-3);
  const Batch circle_rate = p.sign * p.slope;
  const Batch dx =
      select(circle, -circle_rate * y, arc_end * (p.half_x - x) + angle_end * s.angle_y);
  const Batch dy =
      select(circle, circle_rate * x, arc_end * (p.half_y - y) - angle_end * s.angle_x);
  const Batch square = x * x + y * y;
  const Batch r = (p.axis_x * y - p.axis_y * x) / (p.axis_x * x + p.axis_y * y);
  LaneStep<Batch> step;
  step.miss = p.sign * r / fma(r, r * Batch(1.0 / 3), Batch(1.0));
  const Batch rate = p.sign * (x * dy - y * dx) / square;
  const Batch newton = step.miss / rate;
  const Batch bend = p.bend * newton;
  step.change = -newton / fma(Batch(0.5), bend, Batch(1.0));
  step.length = sqrt(square);
  step.length_slope = (x * dx + y * dy) / step.length;
  step.fits = (rate > Batch(0.0)) & (bend > Batch(-0.8));
  return step;
}

/// Largest of the lanes.
template <class Batch>
inline double lane_max(const Batch& x) {
  alignas(64) double lane[Batch::size];
  x.store_aligned(lane);
  double most = lane[0];
  for (std::size_t i = 1; i < Batch::size; ++i) most = lane[i] > most ? lane[i] : most;
  return most;
}

/// What follows from the unknown q at its end.
template <class Batch>
inline void store_lanes(const LaneProblem<Batch>& p, const Batch& last, ChordBlock& block,
                        std::size_t at) {
  const Batch arc = LaneDecay<Batch>(p.a).integral(last);
  const Batch angle = LaneDecay<Batch>(p.b).integral(last);
  const Batch angle_rest = numeric::simd::exp(-p.b * last);
  const Batch heavy = select(last > Batch(0.0), p.theta * arc / angle, p.theta);
  const Batch standard = select(p.b < Batch(0.0), angle / angle_rest, angle);
  heavy.store_aligned(block.heavy + at);
  numeric::simd::exp(-last).store_aligned(block.ratio + at);
  (standard / p.theta).store_aligned(block.lambda + at);
}

template <class Batch>
inline void solve_lanes(ChordBlock& block, std::size_t at) {
  const Batch alpha = Batch::load_aligned(block.alpha + at);
  const Batch excess = Batch::load_aligned(block.excess + at);
  LaneProblem<Batch> p(alpha, Batch::load_aligned(block.theta + at), excess);
  using Mask = typename Batch::batch_bool_type;
  Batch q = p.guess(excess);
  Batch length(1.0);
  Mask open(true);
  Mask failed(false);
  for (int iteration = 0; iteration < 8; ++iteration) {
    const Batch reach = fma(p.sharpness, q, p.theta);
    const Mask bad = open & !((q > Batch(0.0)) & (reach < Batch(16.0)));
    failed = failed | bad;
    open = open & !bad;
    if (!any(open)) break;
    const Batch safe_q = select(open, q, Batch(0.5) / p.sharpness);
    const Batch safe_reach = fma(p.sharpness, safe_q, p.theta);
    const double most = lane_max(safe_reach);
    const bool rough = iteration == 0;
    const LaneStep<Batch> step =
        lane_step(p, safe_q, safe_reach, rough ? rough_nodes_for(most) : nodes_for(most));
    const Mask lost = open & !step.fits;
    failed = failed | lost;
    open = open & !lost;
    const Mask done =
        open & Mask(!rough) & (abs(step.miss * p.sharpness * step.change) < Batch(1e-13));
    length = select(done, fma(step.length_slope, step.change, step.length), length);
    q = select(open, max(q + step.change, Batch(0.0)), q);
    open = open & !done;
  }
  failed = failed | open;
  select(failed, Batch(0.0), Batch(1.0)).store_aligned(block.solved + at);
  length.store_aligned(block.chord_length + at);
  store_lanes(p, select(failed, Batch(0.0), q), block, at);
}

/// All lanes of slope -1.
template <class Batch>
inline void solve_clothoid_lanes(ChordBlock& block, std::size_t at) {
  const Batch theta = Batch::load_aligned(block.theta + at);
  const Batch h = Batch(0.5) * theta;
  const ClothoidLanes<Batch> c = clothoid_lanes(h, Batch::load_aligned(block.excess + at));
  const Batch heavy = h + c.y;
  select(c.solved, Batch(1.0), Batch(0.0)).store_aligned(block.solved + at);
  c.chord_length.store_aligned(block.chord_length + at);
  (heavy + heavy).store_aligned(block.heavy + at);
  ((h - c.y) / heavy).store_aligned(block.ratio + at);
  (c.y / (heavy * heavy)).store_aligned(block.lambda + at);
}

template <class Batch>
inline bool all_clothoids(const ChordBlock& block, std::size_t at) {
  return !any(!(Batch::load_aligned(block.alpha + at) == Batch(-1.0)));
}

template <class Arch>
void AngleKernel::operator()(Arch, const double* y, const double* x, double* angle,
                             std::size_t count) const {
  using Batch = numeric::simd::Lanes<Arch>;
  for (std::size_t i = 0; i < count; i += Batch::size) {
    atan2(Batch::load_aligned(y + i), Batch::load_aligned(x + i)).store_aligned(angle + i);
  }
}

template <class Arch>
void BatchKernel::operator()(Arch, ChordBlock* block, std::size_t count) const {
  using Batch = numeric::simd::Lanes<Arch>;
  for (std::size_t i = 0; i < count; i += Batch::size) {
    if (all_clothoids<Batch>(*block, i)) {
      solve_clothoid_lanes<Batch>(*block, i);
    } else {
      solve_lanes<Batch>(*block, i);
    }
  }
}

}  // namespace keyline::lac::detail

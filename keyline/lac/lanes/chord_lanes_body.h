#pragma once

#include "keyline/lac/lanes/chord_lanes.h"
#include "keyline/lac/lanes/gauss_nodes.h"
#include "keyline/numeric/elementary.h"

/// Internals: included once for each instruction set by a source compiled for it.
namespace keyline::lac::detail {

/// A decay k of decay_integral() (arm.h): 0 stands for its limit.
template <class Batch>
struct LaneDecay {
  Batch minus_k, scale;
  explicit LaneDecay(const Batch& k) {
    const Batch safe = select(k == Batch(0.0), Batch(1e-30), k);
    minus_k = -safe;
    scale = Batch(-1.0) / safe;
  }
  /// (1 - e^{-k x}) / k.
  Batch integral(const Batch& x) const { return scale * numeric::simd::expm1(minus_k * x); }
};

template <class Batch>
struct LaneSums {
  Batch x = Batch(0.0), y = Batch(0.0), angle_x = Batch(0.0), angle_y = Batch(0.0);

  void add(const Batch& weight, const Batch& angle, const Batch& from_centre) {
    Batch sine, cosine;
    numeric::simd::sincos_short(from_centre, sine, cosine);
    const Batch fx = weight * cosine;
    const Batch fy = weight * sine;
    x += fx;
    y += fy;
    angle_x = fma(angle, fx, angle_x);
    angle_y = fma(angle, fy, angle_y);
  }
};

template <class Arch>
PanelSums PanelKernel::operator()(Arch, double decay_a, double decay_b, double start, double extent,
                                  double factor, double middle, const GaussNodes* rule,
                                  int nodes) const {
  using Batch = numeric::simd::Lanes<Arch>;
  const Batch a(decay_a), from(start), width(extent), scale(factor), centre(middle);
  const LaneDecay<Batch> b{Batch(decay_b)};
  LaneSums<Batch> sums;
  for (int i = 0; i < nodes; i += static_cast<int>(Batch::size)) {
    const Batch lambda = fma(width, Batch::load_aligned(rule->nodes + i), from);
    const Batch weight = Batch::load_aligned(rule->weights + i) * numeric::simd::exp(-a * lambda);
    const Batch angle = scale * b.integral(lambda);
    sums.add(weight, angle, angle - centre);
  }
  return {extent * hadd(sums.x), extent * hadd(sums.y), extent * hadd(sums.angle_x),
          extent * hadd(sums.angle_y)};
}

}  // namespace keyline::lac::detail

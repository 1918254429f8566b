#pragma once

#include "keyline/lac/chord_lanes.h"
#include "keyline/lac/gauss_nodes.h"
#include "keyline/numeric/elementary.h"

/// Internals: included once for each instruction set by a source compiled for it.
namespace keyline::lac::detail {

/// (1 - e^{-b x}) / b; `near` says |b x| <= 1/2 throughout.
template <class Batch>
inline Batch decay_integral_of(const Batch& b, const Batch& inverse_b, const Batch& x, bool near) {
  if (near) return x * numeric::simd::expm1_over_small(-b * x);
  return (Batch(1) - numeric::simd::exp(-b * x)) * inverse_b;
}

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
    angle_x = xsimd::fma(angle, fx, angle_x);
    angle_y = xsimd::fma(angle, fy, angle_y);
  }
};

template <class Arch>
PanelSums PanelKernel::operator()(Arch, double decay_a, double decay_b, double start, double extent,
                                  double factor, double middle, const GaussNodes* rule,
                                  int nodes) const {
  using Batch = xsimd::batch<double, Arch>;
  const Batch a(decay_a), b(decay_b), from(start), width(extent), scale(factor), centre(middle);
  const Batch inverse_b(decay_b == 0 ? 0.0 : 1 / decay_b);
  const double reach = decay_b * (start + extent);
  const bool near = reach < 0.5 && reach > -0.5;
  LaneSums<Batch> sums;
  for (int i = 0; i < nodes; i += static_cast<int>(Batch::size)) {
    const Batch lambda = xsimd::fma(width, Batch::load_aligned(rule->nodes + i), from);
    const Batch weight = Batch::load_aligned(rule->weights + i) * numeric::simd::exp(-a * lambda);
    const Batch angle = scale * decay_integral_of(b, inverse_b, lambda, near);
    sums.add(weight, angle, angle - centre);
  }
  return {extent * xsimd::hadd(sums.x), extent * xsimd::hadd(sums.y),
          extent * xsimd::hadd(sums.angle_x), extent * xsimd::hadd(sums.angle_y)};
}

}  // namespace keyline::lac::detail

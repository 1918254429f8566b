#pragma once

/// Internals: the sums of the chord integral, vectorised, one body for every instruction set.
namespace keyline::lac::detail {

/// A panel [from, from + width] in lambda of an arm with decays a and b; angles are counted from
/// `centre`, from which they may differ by 1.7 at most. scale = theta / decay_integral(b, range).
struct PanelJob {
  double a = 0;
  double b = 0;
  double from = 0;
  double width = 0;
  double scale = 0;
  double centre = 0;
  int nodes = 16;  ///< 8, 12, 16, 24 or 32
};

/// Integrals over the panel of f = e^{-a lambda} e^{i (angle - centre)} and of angle times f.
struct PanelSums {
  double x = 0;
  double y = 0;
  double angle_x = 0;
  double angle_y = 0;
};

struct GaussNodes;

/// The members of a PanelJob one by one: in registers. A block of scalars just written would stall
/// the wide loads the compiler makes of it.
struct PanelKernel {
  template <class Arch>
  PanelSums operator()(Arch, double a, double b, double from, double width, double scale,
                       double centre, const GaussNodes* rule, int nodes) const;
};

/// (These two are static so that every source has its own, for its own instruction set.)
/// Nodes that carry a panel to rounding, by its decay, max(a, |b|) times width, plus its turning
/// (up to 16). The error of n Gauss nodes on e^{zt} falls like (z/4)^(2n)/(2n)!; the bounds for 8
/// to 16 nodes were measured over slopes from 0.05 to 20 (errors below 2e-15).
static inline int nodes_for(double reach) {
  if (reach < 3.3) return reach < 1.4 ? 8 : 12;
  return reach < 5.2 ? 16 : reach < 10 ? 24 : 32;
}

/// Nodes that carry a panel to about 1e-6: enough for a first Newton step, whose own error is
/// larger.
static inline int rough_nodes_for(double reach) {
  if (reach < 7.5) return reach < 5 ? 8 : 12;
  return reach < 10 ? 16 : 24;
}

/// Dispatched to the best instruction set at hand.
PanelSums panel_sums(const PanelJob& job);

}  // namespace keyline::lac::detail

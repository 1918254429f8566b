#pragma once

#include <vector>

#include "keyline/surface/continuity.h"

namespace keyline::surface {

inline bool is_u_edge(Edge e) { return e == Edge::u0 || e == Edge::u1; }

/// An edge of a surface with samples of it, at its stations among others. Keeps a pointer to the
/// surface.
class Border {
 public:
  Border(const Surface& s, Edge e);

  Edge edge() const { return edge_; }
  core::Point3 point(double along) const;
  SurfaceJet jet_at(double along) const;

  /// Of the polygon through the samples.
  double length() const;

  /// The nearest place, from samples and Newton's method on the squared distance.
  double nearest(const core::Point3& p) const;

  /// Knots and the middles between them, growing, without both ends; of an edge of one span none,
  /// of more than 2,048 spans those of every second, third, ... knot.
  const std::vector<double>& stations() const { return stations_; }

  /// Whether there is an inner knot within `reach`.
  bool has_knot(double along, double reach) const;

 private:
  struct EdgeJet;
  EdgeJet edge_jet(double along) const;

  const Surface* surface_;
  Edge edge_;
  std::vector<double> knots_;  ///< inner ones
  std::vector<double> stations_;
  std::vector<double> at_;  ///< of the samples, growing
  std::vector<core::Point3> points_;
};

}  // namespace keyline::surface

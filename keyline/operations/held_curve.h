#pragma once

#include <memory>
#include <span>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/error.h"

/// Curves and surfaces that a program keeps between requests, to evaluate them at many places at
/// once without going through JSON: columns of doubles in and out. Safe to use from any thread.
namespace keyline::operations {

/// What a curve can be evaluated for at an arc length.
enum class Along { point, tangent, curvature, curvature_rate, torsion, tangent_angle };

/// Any curve value of the public interface, in the plane or in space.
class HeldCurve {
 public:
  /// Fails: as the reader of the value does, the path starting with "curve"; unsupported for paths
  ///        of curves in space.
  static core::Result<HeldCurve> from_json(const nlohmann::json& value);

  nlohmann::json to_json() const;
  double length() const;
  int dimension() const;  ///< 2 or 3

  /// Numbers in one answer: points and tangents have dimension(), the rest one.
  std::size_t width(Along what) const;

  /// The answer at each arc length from the start (clamped to the curve), row by row.
  /// Precondition: out.size() == at.size() * width(what).
  /// Fails: bad_input where a place is not finite; unsupported where the curve has no such thing
  ///        (torsion in the plane, tangent angles and curvature rates in space).
  core::Result<void> ask(Along what, std::span<const double> at, std::span<double> out) const;

  /// The curve as Béziers of the degree within the tolerance, with "deviation", the bound they
  /// meet: the form "bezier" of every result that holds a curve.
  /// Fails: bad_input where such a form cannot be asked for (a tolerance of 0, a degree of 1).
  core::Result<nlohmann::json> bezier(double tolerance, int degree) const;

 private:
  struct Body;
  explicit HeldCurve(std::shared_ptr<const Body> body) : body_(std::move(body)) {}
  std::shared_ptr<const Body> body_;
};

/// A surface of the public interface.
class HeldSurface {
 public:
  static core::Result<HeldSurface> from_json(const nlohmann::json& value);
  nlohmann::json to_json() const;

  /// Point (and unit normal where asked for) at each pair of parameters in [0, 1].
  /// Precondition: out.size() == 3 * u.size(), u.size() == v.size().
  /// Fails: bad_input where a parameter is not finite.
  core::Result<void> points(std::span<const double> u, std::span<const double> v,
                            std::span<double> out) const;
  core::Result<void> normals(std::span<const double> u, std::span<const double> v,
                             std::span<double> out) const;

 private:
  struct Body;
  explicit HeldSurface(std::shared_ptr<const Body> body) : body_(std::move(body)) {}
  std::shared_ptr<const Body> body_;
};

/// Answers to many requests lac.segment: segment i has start, direction, length, curvatures.
struct SegmentColumns {
  std::vector<double> start;      ///< x, y
  std::vector<double> direction;  ///< radians
  std::vector<double> length;
  std::vector<double> curvature;  ///< at start and end
  std::vector<double> lambda;
  std::vector<unsigned char> drawn;  ///< 0: there is none; lac.segment tells why
  std::vector<unsigned char> reversed;
};

/// lac.segment for many triples of handles at once (x0 y0 x1 y1 x2 y2 each) and one slope or one
/// for each; shared among threads (<= 0: all), which changes nothing in the answers.
/// Fails: bad_input where the sizes do not agree.
core::Result<SegmentColumns> many_segments(std::span<const double> handles,
                                           std::span<const double> alphas, int threads);

}  // namespace keyline::operations

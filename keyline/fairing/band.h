#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"

/// The tolerance as what it is: limits on every point's offset, met by a primal-dual interior
/// point method. Shared by the dense curve and the chain of log-aesthetic pieces.
namespace keyline::fairing::detail {

/// What a point asks of the quadratic model: weight * (d offset)^2 / 2 + slope * d offset.
struct Pull {
  double weight = 0;
  double slope = 0;
};

/// What the points ask of a curve while it is solved for.
class Limits {
 public:
  virtual ~Limits() = default;
  virtual Pull pull(std::size_t j) const = 0;
  /// Largest share of Newton's step, one at most, that the changes it means allow.
  virtual double longest(const std::vector<double>& meant) const = 0;
  /// Whether a step of that share of Newton's may lead to these offsets.
  virtual bool allows(const std::vector<double>& offsets, double share) const = 0;
  /// What these offsets cost after such a step.
  virtual double merit(const std::vector<double>& offsets, double share) const = 0;
  /// Moves on: new offsets by a step of that share, and the changes Newton's whole step meant.
  virtual void move(const std::vector<double>& offsets, const std::vector<double>& meant,
                    double share) = 0;
  /// Other offsets of the same curve, whose points have found other places on it.
  virtual void rest(const std::vector<double>& offsets) = 0;
  /// The energy's unit has been changed: what is counted in it follows.
  virtual void rescale(double by) = 0;
};

/// What share of the mean square of all offsets each point's square is: none of a guide's, and the
/// offset itself where a point's share makes it count for more.
std::vector<double> mean_weights(const std::vector<FitPoint>& points);

/// The largest distance of a point, the spread of what it stands for included.
double largest_of(const std::vector<FitPoint>& points, const std::vector<double>& offsets);

/// Whether the offsets keep the points' own limits, to that slack.
bool limits_kept(const std::vector<FitPoint>& points, const std::vector<double>& offsets,
                 double slack);

/// What a point to be passed may be off by, in tolerances.
inline constexpr double kPassed = 1e-3;

/// Weight of what is held, points to be passed, ends and seams, in squared tolerances.
inline constexpr double kHeld = 1e4;

/// Whether the points to be passed are.
bool all_passed(const std::vector<FitPoint>& points, const std::vector<double>& offsets,
                double tolerance);

/// Root of the mean square of the measured points' offsets.
double root_mean_square(const std::vector<double>& mean_weights,
                        const std::vector<double>& offsets);

/// Springs: half the weight times the mean square of the offsets, guides beside the points.
class Springs : public Limits {
 public:
  Springs(const std::vector<FitPoint>& points, std::vector<double> offsets, double weight);
  Pull pull(std::size_t j) const override;
  double longest(const std::vector<double>&) const override { return 1; }
  bool allows(const std::vector<double>&, double) const override { return true; }
  double merit(const std::vector<double>& offsets, double share) const override;
  void move(const std::vector<double>& offsets, const std::vector<double>&, double) override;
  void rest(const std::vector<double>& offsets) override { offset_ = offsets; }
  void rescale(double) override {}

 private:
  std::vector<double> weight_;
  std::vector<double> offset_;
};

/// Slacks and multipliers of offset + high <= tolerance and -offset - low <= tolerance, a pair a
/// point, and of the limits that a point has of its own. A first curve need not keep to them: what
/// a limit is passed by counts as extra width, which every step of Newton's takes back as far as it
/// goes (an infeasible interior point). Points to be passed have no limits but a weight and a
/// multiplier (an augmented Lagrangian): between limits so close a step could not bend.
///
/// Source: [Wright 1997], chapters 1 and 6; [Nocedal 2006], section 17.3.
class Band : public Limits {
 public:
  /// spring: also half that weight times the mean square of all offsets, in the merit's unit.
  Band(const std::vector<FitPoint>& points, double tolerance, double spring);

  Pull pull(std::size_t j) const override;

  void start(const std::vector<double>& offsets, double barrier);

  double longest(const std::vector<double>& meant) const override;
  bool allows(const std::vector<double>& offsets, double share) const override;
  /// -barrier * sum of the slacks' logarithms + price * extra width, and the springs.
  double merit(const std::vector<double>& offsets, double share) const override;
  /// Multipliers go as far as none loses its sign.
  void move(const std::vector<double>& offsets, const std::vector<double>& meant,
            double share) override;
  /// No slack shrinks below half of the tolerance: what is missing counts as extra width.
  void rest(const std::vector<double>& offsets) override;
  void rescale(double by) override;

  void set_barrier(double barrier) { barrier_ = barrier; }
  double barrier() const { return barrier_; }
  /// Largest extra width left, or offset of a point that is not passed yet.
  double extra() const;

 private:
  void set_price();
  struct Side {
    double multiplier = 0;
    double extra = 0;
  };
  struct Pair {
    Side high;
    Side low;
  };
  /// The offset of a point to be passed, whatever its share.
  double missed(std::size_t j, double offset) const { return offset / points_[j].share; }
  /// Of what draws a point to be passed to its place.
  double stiffness() const { return kHeld / (tolerance_ * tolerance_); }
  double room_high(std::size_t j, double offset) const;
  double room_low(std::size_t j, double offset) const;

  const std::vector<FitPoint>& points_;
  double tolerance_;
  std::vector<double> spring_;
  double barrier_ = 1;
  double price_ = 0;
  std::vector<double> offset_;
  std::vector<Pair> pair_;
  std::vector<double> force_;  ///< multipliers of points to be passed
};

}  // namespace keyline::fairing::detail

#include "keyline/lac/space/space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "keyline/core/angle.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/space/space_shooting.h"
#include "keyline/lac/space/space_stretch.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point3;
using core::Result;
using core::Vector3;

/// Position over the piece's length, tangent, normal.
using State = std::array<double, 9>;

constexpr double kLocalError = 1e-13;  ///< of the coarser of two answers; the finer is taken
constexpr double kLeastStep = 1e-12;

Vector3 part_of(const State& s, std::size_t i) { return {s[i], s[i + 1], s[i + 2]}; }
void put(State& s, std::size_t i, Vector3 v) {
  s[i] = v.x;
  s[i + 1] = v.y;
  s[i + 2] = v.z;
}

/// Frenet's equations of one piece, in the fraction of its length or a stretch's variable.
class Frenet {
 public:
  explicit Frenet(const SpacePiece& p)
      : curvature_(curvature_law(p)), torsion_(torsion_law(p)), length_(p.length) {}

  void operator()(const State& state, State& rate, double s) const {
    const double t = stretch.place(s);
    const double speed = stretch.rate(s);
    const Vector3 tangent = part_of(state, 3);
    const Vector3 normal = part_of(state, 6);
    const double bend = speed * length_ * curvature(curvature_, t);
    const double twist = speed * length_ * curvature(torsion_, t);
    put(rate, 0, speed * tangent);
    put(rate, 3, bend * normal);
    put(rate, 6, twist * cross(tangent, normal) - bend * tangent);
  }

  detail::Stretch stretch;

 private:
  Piece curvature_;
  Piece torsion_;
  double length_;
};

/// Where a law vanishes, the ends included.
detail::LawZero zero_of(const Piece& law) {
  const double k0 = law.curvature_start;
  const double k1 = law.curvature_end;
  if (!(law.alpha < 0) || k0 == k1) return {};
  return {k0 == 0 ? 0 : k1 == 0 ? 1 : inflection(law), law.alpha};
}

/// Frames along one piece at growing t.
class Walker {
 public:
  Walker(const SpaceFrame& start, const SpacePiece& piece)
      : origin_(start.position),
        length_(piece.length),
        rates_(piece),
        stretches_(
            detail::stretches_between(zero_of(curvature_law(piece)), zero_of(torsion_law(piece)))) {
    put(state_, 3, start.tangent);
    put(state_, 6, start.normal);
    const double turn =
        piece.length * std::max({std::abs(piece.curvature_start), std::abs(piece.curvature_end),
                                 std::abs(piece.torsion_start), std::abs(piece.torsion_end), 1e-3});
    first_step_ = std::min(0.25, 0.2 / turn);
    step_ = first_step_;
    rates_.stretch = stretches_.all[0];
  }

  SpaceFrame at(double t) {
    while (now_ + 1 < stretches_.count && t > rates_.stretch.to) {
      advance(1);
      rates_.stretch = stretches_.all[++now_];
      s_ = 0;
      step_ = first_step_;
    }
    advance(rates_.stretch.variable(t));
    const Vector3 tangent = part_of(state_, 3) / norm(part_of(state_, 3));
    Vector3 normal = part_of(state_, 6);
    normal = normal - dot(normal, tangent) * tangent;
    normal = normal / norm(normal);
    return {origin_ + length_ * part_of(state_, 0), tangent, normal, cross(tangent, normal)};
  }

 private:
  /// One step against two of half the length. (Fehlberg's own estimate is blind to what depends on
  /// t alone: it takes its stages at both ends of the step with opposite signs.)
  void advance(double to) {
    while (s_ < to) {
      const bool whole = step_ >= to - s_;
      const double step = whole ? to - s_ : step_;
      State once{};
      State half{};
      State twice{};
      stepper_.do_step(rates_, state_, s_, once, step);
      stepper_.do_step(rates_, state_, s_, half, step / 2);
      stepper_.do_step(rates_, half, s_ + step / 2, twice, step / 2);
      double error = 0;
      for (std::size_t i = 0; i < once.size(); ++i)
        error = std::max(error, std::abs(once[i] - twice[i]));
      const double factor = error > 0 ? 0.9 * std::pow(kLocalError / error, 0.125) : 3.0;
      if (error <= kLocalError || step < kLeastStep) {
        state_ = twice;
        s_ = whole ? to : s_ + step;
      }
      if (!whole || factor < 1)
        step_ = std::max(kLeastStep / 2, step * std::clamp(factor, 0.2, 3.0));
    }
  }

  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper_;
  Point3 origin_;
  double length_;
  Frenet rates_;
  State state_{};
  detail::Stretches stretches_;
  int now_ = 0;
  double s_ = 0;
  double step_ = 0.1;
  double first_step_ = 0.1;
};

ChainLocation locate(const SpaceChain& chain, double t) {
  std::vector<double> joints{0};
  for (const SpacePiece& piece : chain.pieces) joints.push_back(joints.back() + piece.length);
  return located(joints, t);
}

bool is_frame(const SpaceFrame& f) {
  const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-9; };
  return near(dot(f.tangent, f.tangent), 1) && near(dot(f.normal, f.normal), 1) &&
         near(dot(f.tangent, f.normal), 0) && norm(cross(f.tangent, f.normal) - f.binormal) <= 1e-9;
}

Result<void> check_law(const Piece& law, std::size_t i, const char* which) {
  core::Failure failure{ErrorCode::bad_input, "", "", "pieces[" + std::to_string(i) + "]"};
  if (std::isinf(law.curvature_start) || std::isinf(law.curvature_end)) {
    failure.message = std::string(which) + " is not finite";
    return std::unexpected(std::move(failure));
  }
  if (const auto sound = validate(law); !sound) {
    failure.message = std::string(which) + ": " + sound.error().message;
    failure.hint = sound.error().hint;
    return std::unexpected(std::move(failure));
  }
  return {};
}

}  // namespace

Result<void> validate(const SpaceChain& chain) {
  if (chain.pieces.empty())
    return core::fail(ErrorCode::bad_input, "the curve has no piece", "give at least one",
                      "pieces");
  if (!is_finite(chain.start.position))
    return core::fail(ErrorCode::bad_input, "the start is not finite", "", "start");
  if (!is_frame(chain.start))
    return core::fail(ErrorCode::bad_input, "the frame is not orthonormal and right-handed",
                      "give unit vectors [tangent, normal, binormal] with t x n = b", "frame");
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    if (auto sound = check_law(curvature_law(chain.pieces[i]), i, "curvature"); !sound)
      return sound;
    if (auto sound = check_law(torsion_law(chain.pieces[i]), i, "torsion"); !sound) return sound;
  }
  return {};
}

double arc_length(const SpaceChain& chain) {
  double length = 0;
  for (const SpacePiece& p : chain.pieces) length += p.length;
  return length;
}

SpaceJointGap largest_joint_gap(const SpaceChain& chain) {
  SpaceJointGap gap;
  for (std::size_t i = 1; i < chain.pieces.size(); ++i) {
    const SpacePiece& a = chain.pieces[i - 1];
    const SpacePiece& b = chain.pieces[i];
    gap.curvature = std::max(gap.curvature, std::abs(b.curvature_start - a.curvature_end));
    gap.torsion = std::max(gap.torsion, std::abs(b.torsion_start - a.torsion_end));
  }
  return gap;
}

double curvature(const SpaceChain& chain, double t) {
  const ChainLocation at = locate(chain, t);
  return curvature(curvature_law(chain.pieces[at.piece]), at.t);
}

double torsion(const SpaceChain& chain, double t) {
  const ChainLocation at = locate(chain, t);
  return curvature(torsion_law(chain.pieces[at.piece]), at.t);
}

std::vector<SpaceFrame> frames(const SpaceChain& chain, std::span<const double> t) {
  std::vector<SpaceFrame> all;
  all.reserve(t.size());
  std::size_t piece = 0;
  std::optional<Walker> walker(std::in_place, chain.start, chain.pieces[0]);
  for (const double each : t) {
    const ChainLocation at = locate(chain, each);
    while (piece < at.piece) {
      const SpaceFrame joint = walker->at(1);
      walker.emplace(joint, chain.pieces[++piece]);
    }
    all.push_back(walker->at(at.t));
  }
  return all;
}

SpaceFrame frame_at(const SpaceChain& chain, double t) { return frames(chain, {&t, 1}).front(); }

std::vector<Point3> sample(const SpaceChain& chain, int n) {
  std::vector<double> t;
  for (int i = 0; i < n; ++i) t.push_back(i / (n - 1.0));
  std::vector<Point3> points;
  for (const SpaceFrame& frame : frames(chain, t)) points.push_back(frame.position);
  return points;
}

Point3 evaluate(const SpaceChain& chain, double t) { return frame_at(chain, t).position; }

namespace {

curve::Jet3 jet_of(const SpaceChain& chain, const ChainLocation& at, const SpaceFrame& f) {
  const SpacePiece& piece = chain.pieces[at.piece];
  const double length = arc_length(chain);
  const double bend = curvature(curvature_law(piece), at.t);
  const double twist = curvature(torsion_law(piece), at.t);
  double rate = curvature_rate(curvature_law(piece), at.t);
  if (!std::isfinite(rate)) rate = 0;
  const Vector3 third = rate * f.normal - bend * bend * f.tangent + bend * twist * f.binormal;
  return {f.position, length * f.tangent, length * length * bend * f.normal,
          length * length * length * third};
}

}  // namespace

curve::Jet3 jet(const SpaceChain& chain, double t) {
  return jet_of(chain, locate(chain, t), frame_at(chain, t));
}

std::vector<double> breakpoints(const SpaceChain& chain) {
  const double length = arc_length(chain);
  std::vector<double> at{0};
  double s = 0;
  for (const SpacePiece& piece : chain.pieces) {
    for (const Piece& law : {curvature_law(piece), torsion_law(piece)})
      if (const double zero = inflection(law); zero > 0)
        at.push_back((s + zero * piece.length) / length);
    s += piece.length;
    at.push_back(s / length);
  }
  at.back() = 1;
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

SpaceChain reverse(const SpaceChain& chain) {
  const SpaceFrame end = frame_at(chain, 1);
  SpaceChain back{{end.position, -end.tangent, end.normal, -end.binormal}, {}};
  for (auto p = chain.pieces.rbegin(); p != chain.pieces.rend(); ++p)
    back.pieces.push_back({p->alpha, p->beta, p->length, p->curvature_end, p->curvature_start,
                           p->torsion_end, p->torsion_start});
  return back;
}

Result<SpacePiece> standard_piece(const SpaceStandardForm& form, double length) {
  const SpacePiece piece{form.alpha,
                         form.beta,
                         length,
                         1,
                         detail::carried(1, form.alpha, form.lambda * length),
                         form.nu,
                         detail::carried(form.nu, form.beta, form.omega * length)};
  if (!std::isfinite(form.lambda) || !std::isfinite(form.omega) ||
      std::isnan(piece.curvature_end) || std::isnan(piece.torsion_end))
    return core::fail(ErrorCode::bad_input, "the standard form ends before this length",
                      "give a shorter length or smaller lambda and omega");
  if (auto sound = check_law(curvature_law(piece), 0, "curvature"); !sound)
    return std::unexpected(sound.error());
  if (auto sound = check_law(torsion_law(piece), 0, "torsion"); !sound)
    return std::unexpected(sound.error());
  return piece;
}

namespace {

/// Slope of log rho against log |rho ds/drho| by least squares; false for a flat law.
bool graph_slope(const Piece& law, double& slope) {
  constexpr int kPlaces = 64;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double t = (i + 0.5) / kPlaces;
    const double bend = std::abs(curvature(law, t));
    const double rate = std::abs(curvature_rate(law, t));
    if (!(bend > 0 && rate > 0 && std::isfinite(rate))) continue;
    const double x = -std::log(bend);
    const double y = std::log(bend / rate);  // rho / |drho/ds|, drho/ds = -rate / bend^2
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double spread = n > 0 ? sxx / n - (sx / n) * (sx / n) : 0;
  if (!(spread > 1e-16)) return false;
  slope = (sxy / n - sx / n * (sy / n)) / spread;
  return true;
}

}  // namespace

SpaceGraphs logarithmic_graphs(const SpacePiece& piece) {
  SpaceGraphs graphs;
  graphs.curvature_defined = graph_slope(curvature_law(piece), graphs.curvature_slope);
  graphs.torsion_defined = graph_slope(torsion_law(piece), graphs.torsion_slope);
  return graphs;
}

}  // namespace keyline::lac

#include "keyline/operations/held_curve.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include <nlohmann/json.hpp>

#include "keyline/curve/length.h"
#include "keyline/exchange/json/json_curve.h"
#include "keyline/exchange/json/json_members.h"
#include "keyline/exchange/json/json_space.h"
#include "keyline/lac/chain/chain_sampler.h"
#include "keyline/numeric/parallel.h"
#include "keyline/operations/json_form.h"
#include "keyline/operations/made_curve.h"

namespace keyline::operations {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

namespace {

Result<void> check_places(std::span<const double> at) {
  const auto wrong = std::ranges::find_if(at, [](double s) { return !std::isfinite(s); });
  if (wrong == at.end()) return {};
  return core::fail(ErrorCode::bad_input, "a place is not finite", {},
                    "s[" + std::to_string(wrong - at.begin()) + "]");
}

Result<void> has_none(const char* what) {
  return core::fail(ErrorCode::unsupported, std::string("this curve has no ") + what);
}

/// The chain where a path is one log-aesthetic curve.
const lac::Chain* chain_of(const document::Path& path) {
  return path.curves.size() == 1 ? std::get_if<lac::Chain>(&path.curves[0].value) : nullptr;
}

Result<void> ask_chain(const lac::ChainSampler& chain, Along what, std::span<const double> at,
                       std::span<double> out) {
  switch (what) {
    case Along::curvature:
      chain.curvatures(at, out);
      return {};
    case Along::curvature_rate:
      chain.curvature_rates(at, out);
      return {};
    case Along::tangent_angle:
      chain.tangent_angles(at, out);
      return {};
    case Along::point: {
      static_assert(sizeof(core::Point2) == 2 * sizeof(double));
      chain.points(at, {reinterpret_cast<core::Point2*>(out.data()), at.size()});
      return {};
    }
    case Along::tangent: {
      std::vector<double> angles(at.size());
      chain.tangent_angles(at, angles);
      for (std::size_t i = 0; i < at.size(); ++i) {
        out[2 * i] = std::cos(angles[i]);
        out[2 * i + 1] = std::sin(angles[i]);
      }
      return {};
    }
    case Along::torsion:
      break;
  }
  return has_none("torsion: it is planar");
}

/// Many places are shared among the machine's threads; the answers do not depend on it.
Result<void> ask_in_blocks(const lac::ChainSampler& chain, Along what, std::size_t width,
                           std::span<const double> at, std::span<double> out) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  const std::size_t blocks = (at.size() + kBlock - 1) / kBlock;
  std::vector<Result<void>> done(blocks);
  numeric::parallel_for(blocks, 0, [&](std::size_t block) {
    const std::size_t from = block * kBlock;
    const std::size_t count = std::min(kBlock, at.size() - from);
    done[block] =
        ask_chain(chain, what, at.subspan(from, count), out.subspan(from * width, count * width));
  });
  for (auto& one : done)
    if (!one) return one;
  return {};
}

Result<void> write(const curve::Jet2& jet, Along what, double* out) {
  const core::Vector2 tangent = curve::unit_tangent(jet);
  switch (what) {
    case Along::point:
      out[0] = jet.point.x;
      out[1] = jet.point.y;
      return {};
    case Along::tangent:
      out[0] = tangent.x;
      out[1] = tangent.y;
      return {};
    case Along::curvature:
      *out = curve::curvature(jet);
      return {};
    case Along::curvature_rate:
      *out = curve::curvature_rate(jet);
      return {};
    case Along::tangent_angle:
      *out = curve::tangent_angle(jet);
      return {};
    case Along::torsion:
      break;
  }
  return has_none("torsion: it is planar");
}

Result<void> write(const curve::Jet3& jet, Along what, double* out) {
  const double speed = curve::speed(jet);
  const core::Vector3 tangent = speed > 0 ? jet.first / speed : jet.first;
  switch (what) {
    case Along::point:
      out[0] = jet.point.x;
      out[1] = jet.point.y;
      out[2] = jet.point.z;
      return {};
    case Along::tangent:
      out[0] = tangent.x;
      out[1] = tangent.y;
      out[2] = tangent.z;
      return {};
    case Along::curvature:
      *out = curve::curvature(jet);
      return {};
    case Along::torsion:
      *out = curve::torsion(jet);
      return {};
    default:
      return has_none("signed curvature: it is in space");
  }
}

/// Any curve by its parameter at each arc length.
template <class Curve>
Result<void> ask_jets(const Curve& curve, const curve::ArcLengthMap& map, Along what,
                      std::size_t width, std::span<const double> at, std::span<double> out) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double s = std::clamp(at[i], 0.0, curve::total_length(map));
    const auto there = jet(curve, curve::parameter_at_length(curve, map, s));
    if (auto done = write(there, what, &out[i * width]); !done) return done;
  }
  return {};
}

}  // namespace

struct HeldCurve::Body {
  std::variant<document::Path, document::SpaceCurve> curve;
  bool is_path = false;  ///< given as one, also of a single member
  std::optional<lac::ChainSampler> chain = {};
  curve::ArcLengthMap map = {};
};

Result<HeldCurve> HeldCurve::from_json(const json& value) {
  if (auto known = exchange::check_members(value, "curve"); !known)
    return std::unexpected(known.error());
  auto body = std::make_shared<Body>();
  if (exchange::is_space_curve(value)) {
    auto curve = exchange::space_curve_from_json(value, "curve");
    if (!curve) return std::unexpected(curve.error());
    body->map = curve::arc_length_map(*curve);
    body->curve = std::move(*curve);
    return HeldCurve(body);
  }
  auto path = exchange::path_from_json(value, "curve");
  if (!path) return std::unexpected(path.error());
  if (const lac::Chain* chain = chain_of(*path)) {
    body->chain.emplace(*chain);
  } else {
    body->map = curve::arc_length_map(*path);
  }
  body->is_path = value.at("type") == "path";
  body->curve = std::move(*path);
  return HeldCurve(body);
}

json HeldCurve::to_json() const {
  if (const auto* space = std::get_if<document::SpaceCurve>(&body_->curve))
    return exchange::to_json(*space);
  const auto& path = std::get<document::Path>(body_->curve);
  return !body_->is_path ? exchange::to_json(path.curves.front()) : exchange::to_json(path);
}

double HeldCurve::length() const {
  return body_->chain ? body_->chain->length() : curve::total_length(body_->map);
}

int HeldCurve::dimension() const {
  return std::holds_alternative<document::Path>(body_->curve) ? 2 : 3;
}

std::size_t HeldCurve::width(Along what) const {
  const bool vector = what == Along::point || what == Along::tangent;
  return vector ? static_cast<std::size_t>(dimension()) : 1;
}

Result<void> HeldCurve::ask(Along what, std::span<const double> at, std::span<double> out) const {
  if (auto sound = check_places(at); !sound) return sound;
  if (body_->chain) return ask_in_blocks(*body_->chain, what, width(what), at, out);
  return std::visit(
      [&](const auto& curve) { return ask_jets(curve, body_->map, what, width(what), at, out); },
      body_->curve);
}

Result<json> HeldCurve::bezier(double tolerance, int degree) const {
  MadeCurve made;
  std::visit([&](const auto& curve) { made.curve = curve; }, body_->curve);
  Forms forms;
  Form& form = forms.bezier.emplace();
  const Part asked{&core::type_of<Form>(), &form};
  if (auto read = read_json({{"degree", degree}, {"tolerance", tolerance}}, {&asked, 1}, {}, "");
      !read)
    return std::unexpected(read.error());
  if (auto done = add_forms(core::type_of<MadeCurve>(), &made, forms); !done)
    return std::unexpected(done.error());
  return write_json(core::type_of<BoundedCurve>(), &*made.bezier);
}

}  // namespace keyline::operations

#include "keyline/exchange/too_large.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>

#include "keyline/core/coordinate.h"
#include "keyline/document/document.h"

namespace keyline::exchange {
namespace {

using core::is_too_large;

template <class Points>
bool is_any_too_large(const Points& points) {
  return std::ranges::any_of(points, [](const auto& p) { return is_too_large(p); });
}

/// The start of pieces or their length.
template <class Chain>
bool is_chain_too_large(const Chain& chain, core::Point3 start) {
  return is_too_large(start) || std::ranges::any_of(chain.pieces, [](const auto& piece) {
           return core::is_too_large(piece.length);
         });
}
bool is_any_too_large(const lac::Chain& c) {
  return is_chain_too_large(c, {c.start.position.x, c.start.position.y, 0});
}
bool is_any_too_large(const lac::SpaceChain& c) { return is_chain_too_large(c, c.start.position); }

template <class Curve>
bool is_curve_too_large(const Curve& curve) {
  return std::visit(
      [](const auto& c) {
        if constexpr (requires { c.points; })
          return is_any_too_large(c.points);
        else if constexpr (requires { c.control; })
          return is_any_too_large(c.control);
        else
          return is_any_too_large(c);
      },
      curve.value);
}

bool is_too_large(const document::NamedPath& named) {
  return std::ranges::any_of(named.path.curves, is_curve_too_large<document::PlanarCurve>);
}
bool is_too_large(const document::NamedSpaceCurve& named) {
  return is_curve_too_large(named.curve);
}
bool is_too_large(const document::NamedSurface& named) {
  return is_any_too_large(net_of(named.surface).points) ||
         std::ranges::any_of(named.trim_loops, [](const auto& loop) {
           return std::ranges::any_of(loop, is_curve_too_large<document::SpaceCurve>);
         });
}

}  // namespace

void leave_out_too_large(document::Document& document) {
  std::size_t place = 0;
  const auto leave_out_of = [&](auto& things, const char* kind) {
    std::erase_if(things, [&](const auto& named) {
      ++place;
      if (!is_too_large(named)) return false;
      const std::string& name = named.label.name;
      document.skipped.push_back((name.empty() ? kind + (" " + std::to_string(place)) : name) +
                                 ": a coordinate of it is larger than 1e100");
      return true;
    });
  };
  leave_out_of(document.paths, "curve");
  leave_out_of(document.space_curves, "curve");
  leave_out_of(document.surfaces, "surface");
}

}  // namespace keyline::exchange

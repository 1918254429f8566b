#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/document/planar_curve.h"
#include "keyline/document/space_curve.h"
#include "keyline/surface/surface.h"

/// The values of the public interface that have a form of their own, as members of described
/// records.
namespace keyline::operations {

/// Curves in space end to end.
struct SpacePath {
  std::vector<document::SpaceCurve> curves;
  bool closed = false;
};

/// Any curve value, in the plane or in space: one with a third coordinate other than 0, or of a
/// type that only space has, is a curve in space. A path is written as a path, also of one member.
using AnyCurve =
    std::variant<document::PlanarCurve, document::Path, document::SpaceCurve, SpacePath>;

/// The curve as a path where it lies in the plane; of a single curve, a path of one member.
std::optional<document::Path> planar_path(const AnyCurve& curve);

/// A path's only member, or the path where it has several.
AnyCurve simplest(document::Path path);

/// A curve that stands for another within a distance, written as the curve with "deviation".
struct BoundedCurve {
  AnyCurve curve;
  double deviation = 0;
};

/// A path of one member; as a field of type Path it is written as that member alone.
document::Path path_of(document::PlanarCurve curve);

}  // namespace keyline::operations

namespace keyline::core {

template <>
struct ValueType<document::Path> {
  static const Type& type();
};
template <>
struct ValueType<operations::AnyCurve> {
  static const Type& type();
};
template <>
struct ValueType<operations::BoundedCurve> {
  static const Type& type();
};
template <>
struct ValueType<surface::Surface> {
  static const Type& type();
};

}  // namespace keyline::core

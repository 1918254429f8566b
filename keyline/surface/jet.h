#pragma once

#include "keyline/core/point.h"

namespace keyline::surface {

/// Point of a surface with its partial derivatives by u and v to third order.
struct SurfaceJet {
  core::Point3 point;
  core::Vector3 u, v;
  core::Vector3 uu, uv, vv;
  core::Vector3 uuu, uuv, uvv, vvv;
  friend bool operator==(const SurfaceJet&, const SurfaceJet&) = default;
};

}  // namespace keyline::surface

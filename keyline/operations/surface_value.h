#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "keyline/operations/class_a.h"
#include "keyline/surface/network.h"

/// Values of surfaces in results.
namespace keyline::operations {

using PatchPlace = std::array<int, 2>;  ///< row (span in u) and column

struct NetworkCurveShown {
  ValueShown value;
  std::string name;
  std::optional<NearestShown> nearest;
  std::optional<PatchPlace> patch;
  static constexpr auto describe() {
    using Curve = NetworkCurveShown;
    return core::fields(core::flattened<&Curve::value>(),
                        core::field<&Curve::name>("A1, A2, ...: rows, columns"),
                        core::field<&Curve::nearest>("types 4 and 5: nearest curve of one matrix"),
                        core::field<&Curve::patch>("of several: row and column, from 0"));
  }
};

struct PatchValueShown {
  PatchPlace patch{};
  double sav = 0;
  std::string worst;
  std::optional<double> nearest_sav;
  static constexpr auto describe() {
    using Patch = PatchValueShown;
    return core::fields(core::field<&Patch::patch>("row and column, from 0"),
                        core::field<&Patch::sav>("its value"),
                        core::field<&Patch::worst>("its worst curve"),
                        core::field<&Patch::nearest_sav>("with the nearest curves of one matrix"));
  }
};

/// A surface.sav result.
struct SurfaceValueShown {
  double sav = 0;
  std::vector<NetworkCurveShown> curves;
  std::string worst;
  std::optional<double> nearest_sav;
  std::optional<PatchPlace> worst_patch;
  std::optional<std::vector<PatchValueShown>> patches;
  std::optional<std::array<double, 4>> steps;

  std::vector<surface::PatchValue> values;  ///< not part of the public form: for pictures

  static constexpr auto describe() {
    using Value = SurfaceValueShown;
    return core::fields(
        core::field<&Value::sav>("sum of the curves' values, less is better"),
        core::field<&Value::curves>("of the network"),
        core::field<&Value::worst>("name of the curve of the largest value"),
        core::field<&Value::nearest_sav>("sum with the nearest curves for types 4 and 5"),
        core::field<&Value::worst_patch>("of several patches"),
        core::field<&Value::patches>("of several, one by one"),
        core::field<&Value::steps>("what the sum can be at most where all curves are Class A, have "
                                   "one matrix, several, or none (Eq. 10: 12, 38, 110, 407)"));
  }
};
SurfaceValueShown shown(const std::vector<surface::PatchValue>& patches);
SurfaceValueShown shown(const surface::SurfaceValue& value);

}  // namespace keyline::operations

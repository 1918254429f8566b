#include "keyline/surface/network_patch.h"

#include <string>

#include "keyline/core/text.h"

namespace keyline::surface {
namespace {

using core::ErrorCode;

core::Result<void> check_curve(const curve::Bezier3& c, const std::string& path) {
  if (is_rational(c))
    return core::fail(ErrorCode::unsupported, "a curve with weights spans no polynomial patch",
                      "give polynomial beziers", path);
  if (auto sound = validate(c); !sound)
    return core::fail(ErrorCode::bad_input, sound.error().message, sound.error().hint, path);
  return {};
}

core::Result<void> check(const std::vector<curve::Bezier3>& rows, const curve::Bezier3& column) {
  if (auto sound = check_curve(column, "column"); !sound) return sound;
  if (rows.size() != column.control.size())
    return core::fail(ErrorCode::bad_input,
                      "the column has " + core::counted(column.control.size(), "control point") +
                          ", there are " + core::counted(rows.size(), "row"),
                      "give one row for each of them, or raise the degree of the column", "rows");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string path = "rows[" + std::to_string(i) + "]";
    if (auto sound = check_curve(rows[i], path); !sound) return sound;
    if (rows[i].control.size() != rows[0].control.size())
      return core::fail(ErrorCode::bad_input, "the rows are not of one degree",
                        "raise the degree of the lower ones", path);
  }
  return {};
}

}  // namespace

core::Result<NetworkPatch> patch_from_network(const std::vector<curve::Bezier3>& rows,
                                              const curve::Bezier3& column) {
  if (auto sound = check(rows, column); !sound) return std::unexpected(sound.error());
  NetworkPatch patch;
  Net& net = patch.surface.net;
  net.rows = static_cast<int>(rows.size());
  net.columns = static_cast<int>(rows[0].control.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const core::Vector3 by = column.control[i] - rows[i].control[0];
    patch.moved.push_back(norm(by));
    net.points.push_back(column.control[i]);
    for (std::size_t k = 1; k < rows[i].control.size(); ++k)
      net.points.push_back(rows[i].control[k] + by);
  }
  if (auto sound = validate(patch.surface); !sound) return std::unexpected(sound.error());
  return patch;
}

}  // namespace keyline::surface

#pragma once

#include <string>
#include <vector>

#include "keyline/surface/edit.h"

namespace keyline::surface::detail {

struct Target {
  std::string name;
  Net net;
};

/// All targets of edit() that exist for this net, exact ones only.
std::vector<Target> edit_targets(const Net& net, const EditOptions& options);

}  // namespace keyline::surface::detail

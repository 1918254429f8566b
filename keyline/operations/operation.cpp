#include "keyline/operations/operation.h"

#include <algorithm>

#include "keyline/operations/registry.h"

namespace keyline::operations {

const std::vector<Operation>& operations() {
  static const std::vector<Operation> all = [] {
    std::vector<Operation> list = all_operations();
    std::sort(list.begin(), list.end(),
              [](const Operation& a, const Operation& b) { return a.name < b.name; });
    return list;
  }();
  return all;
}

const Operation* find_operation(const std::string& name) {
  const auto& all = operations();
  const auto at = std::lower_bound(all.begin(), all.end(), name,
                                   [](const Operation& operation, const std::string& wanted) {
                                     return operation.name < wanted;
                                   });
  return at != all.end() && at->name == name ? &*at : nullptr;
}

}  // namespace keyline::operations

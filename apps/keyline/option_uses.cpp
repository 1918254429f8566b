#include "option_uses.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace keyline::app {

/// The fields that a result tells to have had no use.
std::vector<std::string> unused_in(const operations::Outcome& outcome) {
  std::vector<std::string> names;
  core::visit_fields(
      *outcome.operation->result, outcome.result.get(),
      [&](const core::Field& field, const void* member) {
        if (field.name == "unused" && &field.type() == &core::type_of<std::vector<std::string>>())
          names = *static_cast<const std::vector<std::string>*>(member);
      });
  return names;
}

void OptionUses::add(const core::Type& record, const nlohmann::json& given,
                     const std::vector<std::string>& unused) {
  const std::lock_guard alone(mutex_);
  core::visit_fields(record, record.make().get(), [&](const core::Field& field, void*) {
    const std::string name(field.name);
    if (!given.contains(name)) return;
    const bool found = std::ranges::find(unused, name) == unused.end();
    Use& use = uses_.try_emplace(name, Use{field.text}).first->second;
    use.found = use.found || found;
  });
}

std::vector<std::pair<std::string, std::string_view>> OptionUses::take_unused() {
  const std::lock_guard alone(mutex_);
  std::vector<std::pair<std::string, std::string_view>> unused;
  for (const auto& [name, use] : std::exchange(uses_, {}))
    if (!use.found) unused.emplace_back(name, use.text);
  return unused;
}

}  // namespace keyline::app

#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/describe.h"
#include "keyline/operations/perform.h"

/// Which of the options that were given had a use.
namespace keyline::app {

/// The fields that a result tells to have had no use.
std::vector<std::string> unused_in(const operations::Outcome& outcome);

/// Collects over all operations of a command, which several threads may perform at a time.
class OptionUses {
 public:
  /// The fields of a record that were given to an operation, and which of them it did not use.
  void add(const core::Type& record, const nlohmann::json& given,
           const std::vector<std::string>& unused);
  /// Those that no operation had a use for, each with what it is. Forgets all.
  std::vector<std::pair<std::string, std::string_view>> take_unused();

 private:
  struct Use {
    std::string_view text;  ///< what the option is
    bool found = false;     ///< some operation had a use for it
  };
  std::mutex mutex_;
  std::map<std::string, Use> uses_;
};

}  // namespace keyline::app

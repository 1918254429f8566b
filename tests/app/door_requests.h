#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/operations/operation.h"

/// Requests that every door is asked, and how each is put.
namespace keyline::app_test {

struct Case {
  const operations::Operation* operation;
  nlohmann::json request;
};

/// Every operation's examples, and 200 requests drawn at random near them.
std::vector<Case> cases();

/// The same request typed: every field an option.
std::string typed(const operations::Operation& operation, const nlohmann::json& request);

/// All requests, a line each.
std::string lines_of(const std::vector<Case>& all);

/// An answer for each, in their order.
std::vector<nlohmann::json> answers_of(const std::string& out, std::size_t count);

}  // namespace keyline::app_test

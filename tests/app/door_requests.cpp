#include "door_requests.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include "keyline/operations/perform.h"

namespace keyline::app_test {
namespace {

using core::Type;
using nlohmann::json;
using operations::Operation;

/// A value near the one given, within the field's bounds; null where the kind is not varied.
json varied(const core::Field& field, const Type& type, const json& given, std::mt19937& dice) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(dice);
  };
  const core::Bounds& b = field.bounds;
  switch (type.kind) {
    case Type::Kind::boolean:
      return uniform(0, 1) < 0.5;
    case Type::Kind::integer: {
      const double low = std::isfinite(b.low) ? b.low : 0;
      return static_cast<std::int64_t>(std::floor(uniform(low, std::min(b.high, low + 5) + 0.999)));
    }
    case Type::Kind::number: {
      const double about = given.is_number()      ? given.get<double>()
                           : std::isfinite(b.low) ? b.low + 0.5
                                                  : 0.5;
      const double low = std::max(b.low, about - 0.2 * std::abs(about) - 0.01);
      const double high = std::min(b.high, about + 0.2 * std::abs(about) + 0.01);
      const double value = uniform(low, high);
      return core::contains(b, value) ? json(value) : json();
    }
    case Type::Kind::choice:
      return std::string(type.words[dice() % type.word_count]);
    case Type::Kind::optional:
      return varied(field, type.item(), given, dice);
    default:
      return {};
  }
}

/// The example with some of its single values, and some it leaves out, changed.
json varied(const Operation& operation, json request, std::mt19937& dice) {
  core::visit_fields(*operation.request, operation.request->make().get(),
                     [&](const core::Field& field, void*) {
                       if (field.name == "file" || dice() % 3 != 0) return;
                       const std::string name(field.name);
                       const json given = request.contains(name) ? request[name] : json();
                       if (json value = varied(field, field.type(), given, dice); !value.is_null())
                         request[name] = std::move(value);
                     });
  return request;
}

std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return all + "'";
}

}  // namespace

std::string typed(const Operation& operation, const json& request) {
  std::string line = "perform " + operation.name + " --json";
  for (const auto& [name, value] : request.items()) {
    std::string option = "--" + name;
    std::replace(option.begin(), option.end(), '_', '-');
    const std::string text = value.is_boolean()  ? (value.get<bool>() ? "yes" : "no")
                             : value.is_string() ? value.get<std::string>()
                                                 : value.dump();
    line += " " + option + "=" + quoted(text);
  }
  return line;
}

std::vector<Case> cases() {
  std::mt19937 dice(7);
  std::vector<Case> all;
  for (const Operation& operation : operations::operations()) {
    if (operation.writes_files) continue;  // two doors would write one file
    for (const std::string& example : operation.examples)
      all.push_back({&operation, json::parse(example)});
  }
  const std::size_t examples = all.size();
  for (int i = 0; i < 200; ++i) {
    const Case& base = all[static_cast<std::size_t>(i) % examples];
    all.push_back({base.operation, varied(*base.operation, base.request, dice)});
  }
  return all;
}

std::string lines_of(const std::vector<Case>& all) {
  std::string lines;
  for (const Case& c : all) {
    json request = c.request;
    request["op"] = c.operation->name;
    lines += request.dump() + "\n";
  }
  return lines;
}

std::vector<json> answers_of(const std::string& out, std::size_t count) {
  std::istringstream lines(out);
  std::vector<json> answers;
  for (std::string line; std::getline(lines, line);) answers.push_back(json::parse(line));
  EXPECT_EQ(answers.size(), count);
  answers.resize(count);
  return answers;
}

}  // namespace keyline::app_test

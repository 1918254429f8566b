#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"

/// A command line read by described records: no option is stated twice.
namespace keyline::app {

class Arguments {
 public:
  /// The fields a command line may name.
  explicit Arguments(const std::vector<const core::Type*>& records);

  /// Options --field VALUE… or --field=VALUE into what was given; other words are files.
  core::Result<void> parse(std::span<const std::string> words);

  /// What was given of the i-th record, as JSON for its reader.
  nlohmann::json& of(std::size_t record) { return given_[record]; }
  std::vector<std::string> files;

  /// One line for each field of the i-th record.
  std::string help(std::size_t record) const;

 private:
  struct Known {
    core::Field field;
    const void* member;
    std::size_t record;
  };
  const Known* known_as(const std::string& option) const;
  static bool takes(const Known& known, std::size_t have, const std::string& word);
  core::Result<void> put(const Known& known, const std::vector<std::string>& values);
  std::string nearest(const std::string& option) const;

  std::vector<std::shared_ptr<void>> owners_;
  std::vector<Known> fields_;
  std::vector<nlohmann::json> given_;
};

}  // namespace keyline::app

#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"

#include "option_files.h"
#include "words.h"

/// A command line read by described records: no option is stated twice.
namespace keyline::app {

/// A record whose fields are options.
struct OptionGroup {
  std::string title;
  const core::Type* record;
  std::vector<std::string_view> without = {};  ///< fields that are no options here
};

/// The options of a group.
struct OptionTexts {
  std::string title;
  std::vector<OptionText> options;
};

class Arguments {
 public:
  /// `takes_files`: words that belong to no option are files.
  explicit Arguments(const std::vector<OptionGroup>& groups, bool takes_files = true);

  /// Options --field VALUE…, --field=VALUE or, of what is true or false, --no-field into what was
  /// given; an option may be shortened to what only it begins with. "--" ends the options.
  core::Result<void> parse(std::span<const std::string> words);

  /// What was given of the i-th record, as JSON for its reader. A field that several records have
  /// goes to all of them.
  nlohmann::json& of(std::size_t record) { return given_[record]; }
  const nlohmann::json& of(std::size_t record) const { return given_[record]; }
  std::vector<std::string> files;

  /// Whether there is an option of that name, "--alpha".
  bool has(const std::string& option) const;

  /// Files that options name.
  const OptionFiles& option_files() const { return option_files_; }

  /// What was typed, option and value, for reports.
  const std::vector<std::pair<std::string, std::string>>& typed() const { return typed_; }

  /// A line for each option, group by group.
  std::string help() const;

  /// All options, group by group.
  std::vector<OptionTexts> texts() const;

 private:
  struct Known {
    core::Field field;
    const void* member;
    std::size_t record;
    bool shown = true;  ///< false: stands in an earlier group already
  };
  core::Result<std::size_t> read_option(std::span<const std::string> words, std::size_t at);
  core::Result<const Known*> known_as(const std::string& option) const;
  bool takes(const core::Field& field, std::size_t have, const std::string& word) const;
  core::Result<void> put(const Known& known, const std::vector<std::string>& values);
  std::string nearest(const std::string& option) const;

  bool takes_files_;
  std::vector<std::string> titles_;
  std::vector<std::shared_ptr<void>> owners_;
  std::vector<Known> fields_;
  std::vector<nlohmann::json> given_;
  std::vector<std::pair<std::string, std::string>> typed_;
  OptionFiles option_files_;
};

}  // namespace keyline::app

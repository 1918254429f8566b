#include "arguments.h"

#include <algorithm>

#include "keyline/core/nearest_word.h"

#include "words.h"

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::fail;
using core::Field;
using core::Result;
using nlohmann::json;
using Kind = core::Type::Kind;

const core::Type& kind_of(const Field& field) {
  const core::Type& type = field.type();
  return type.kind == Kind::optional ? type.item() : type;
}

bool is_flag(const Field& field) { return kind_of(field).kind == Kind::boolean; }

std::string long_name(const std::string& word) {
  if (word == "-o") return "--output";
  if (word == "-h") return "--help";
  return word;
}

}  // namespace

Arguments::Arguments(const std::vector<OptionGroup>& groups, bool takes_files)
    : takes_files_(takes_files) {
  for (const OptionGroup& group : groups) {
    titles_.push_back(group.title);
    owners_.push_back(group.record->make());
    core::visit_fields(*group.record, owners_.back().get(), [&](const Field& field, void* member) {
      if (std::ranges::find(group.without, field.name) != group.without.end()) return;
      const bool stands = std::ranges::any_of(
          fields_, [&](const Known& other) { return other.field.name == field.name; });
      fields_.push_back({field, member, owners_.size() - 1, !stands});
    });
  }
  given_.assign(groups.size(), json::object());
}

Result<void> Arguments::parse(std::span<const std::string> words) {
  bool ended = false;
  for (std::size_t i = 0; i < words.size();) {
    const std::string& word = words[i];
    if (!ended && word == "--") {
      ended = true;
      ++i;
    } else if (ended || word == "-" || !word.starts_with('-')) {
      files.push_back(words[i++]);
    } else {
      const auto next = read_option(words, i);
      if (!next) return std::unexpected(next.error());
      i = *next;
    }
  }
  return {};
}

/// Returns where the words after the option and its values begin.
Result<std::size_t> Arguments::read_option(std::span<const std::string> words, std::size_t at) {
  std::string option = long_name(words[at++]);
  std::vector<std::string> values;
  const std::size_t equals = option.find('=');
  const bool bound = equals != std::string::npos;
  if (bound) {
    values.push_back(option.substr(equals + 1));
    option.resize(equals);
  }
  auto known = known_as(option);
  if (!known && option.starts_with("--no-") && !bound) {
    const auto flag = known_as("--" + option.substr(5));
    if (flag && is_flag((*flag)->field)) {
      if (auto done = put(**flag, {"no"}); !done) return std::unexpected(done.error());
      return at;
    }
  }
  if (!known) return std::unexpected(known.error());
  if (!bound)
    while (at < words.size() && takes((*known)->field, values.size(), words[at]))
      values.push_back(words[at++]);
  if (auto done = put(**known, values); !done) return std::unexpected(done.error());
  return at;
}

Result<const Arguments::Known*> Arguments::known_as(const std::string& option) const {
  std::vector<const Known*> begun;
  for (const Known& known : fields_) {
    if (!known.shown) continue;
    const std::string name = option_name(known.field.name);
    if (name == option) return &known;
    if (option.size() > 3 && name.starts_with(option)) begun.push_back(&known);
  }
  if (begun.size() == 1) return begun.front();
  return fail(ErrorCode::bad_input, "there is no such option", nearest(option), option);
}

bool Arguments::has(const std::string& option) const {
  return std::ranges::any_of(
      fields_, [&](const Known& known) { return option_name(known.field.name) == option; });
}

/// Lists of numbers, points and the like take words as long as they are such; other lists, where
/// files stand among the options, one word. Flags take a word only where it says yes or no.
bool Arguments::takes(const Field& field, std::size_t have, const std::string& word) const {
  if (word.starts_with("--") || word == "-o" || word == "-h") return false;
  const core::Type& type = kind_of(field);
  if (type.kind == Kind::boolean) return have == 0 && (word == "yes" || word == "no");
  if (have == 0) return true;
  if (type.kind != Kind::list || field.name == "output" || have >= field.most) return false;
  return !takes_files_ || field.most < 100 || is_number_like(type.item(), word);
}

Result<void> Arguments::put(const Known& known, const std::vector<std::string>& values) {
  typed_.emplace_back(known.field.name, joined(values));
  for (const Known& same : fields_) {
    if (same.field.name != known.field.name) continue;
    auto value = value_of(same.field, values, option_files_);
    if (!value) return std::unexpected(value.error());
    json& to = given_[same.record][std::string(same.field.name)];
    if (to.is_array() && value->is_array() && kind_of(same.field).kind == Kind::list)
      to.insert(to.end(), value->begin(), value->end());
    else
      to = std::move(*value);
  }
  return {};
}

std::string Arguments::nearest(const std::string& option) const {
  std::vector<std::string> names;
  for (const Known& known : fields_) names.push_back(option_name(known.field.name));
  const auto extends = std::ranges::find_if(names, [&](const std::string& name) {
    return name.starts_with(option) || option.starts_with(name);
  });
  const std::vector<std::string_view> words(names.begin(), names.end());
  const std::string_view meant =
      extends != names.end() ? std::string_view(*extends) : core::nearest_word(option, words);
  return meant.empty() ? "" : "did you mean " + std::string(meant) + "?";
}

std::vector<OptionTexts> Arguments::texts() const {
  std::vector<OptionTexts> all;
  for (std::size_t i = 0; i < titles_.size(); ++i) {
    OptionTexts group{titles_[i], {}};
    for (const Known& known : fields_)
      if (known.record == i && known.shown)
        group.options.push_back(option_text(known.field, known.member));
    if (!group.options.empty()) all.push_back(std::move(group));
  }
  return all;
}

std::string Arguments::help() const {
  std::string text;
  for (const OptionTexts& group : texts()) {
    text += "\n" + group.title + ":\n";
    for (const OptionText& option : group.options) text += help_line(option);
  }
  return text;
}

}  // namespace keyline::app

#include "arguments.h"

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

}  // namespace

Arguments::Arguments(const std::vector<const core::Type*>& records) {
  for (const core::Type* record : records) {
    owners_.push_back(record->make());
    core::visit_fields(*record, owners_.back().get(), [&](const Field& field, void* member) {
      fields_.push_back({field, member, owners_.size() - 1});
    });
  }
  given_.assign(records.size(), json::object());
}

Result<void> Arguments::parse(std::span<const std::string> words) {
  for (std::size_t i = 0; i < words.size();) {
    std::string word = words[i] == "-o" ? "--output" : words[i];
    if (!word.starts_with("--")) {
      files.push_back(words[i++]);
      continue;
    }
    std::vector<std::string> values;
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos) {
      values.push_back(word.substr(equals + 1));
      word.resize(equals);
    }
    const Known* known = known_as(word);
    if (!known) return fail(ErrorCode::bad_input, "there is no such option", nearest(word), word);
    ++i;
    if (equals == std::string::npos)
      while (i < words.size() && takes(*known, values.size(), words[i]))
        values.push_back(words[i++]);
    if (auto done = put(*known, values); !done) return done;
  }
  return {};
}

std::string Arguments::help(std::size_t record) const {
  std::string text;
  for (const Known& known : fields_)
    if (known.record == record) text += help_line(known.field, known.member);
  return text;
}

const Arguments::Known* Arguments::known_as(const std::string& option) const {
  for (const Known& known : fields_)
    if (option_name(known.field.name) == option) return &known;
  return nullptr;
}

/// Lists take words up to the next option, flags a word only where it says yes or no.
bool Arguments::takes(const Known& known, std::size_t have, const std::string& word) {
  if (word.starts_with("--") || word == "-o") return false;
  const core::Type& type = kind_of(known.field);
  if (type.kind == Kind::boolean) return have == 0 && (word == "yes" || word == "no");
  if (known.field.name == "output") return have == 0;
  return have == 0 || type.kind == Kind::list;
}

Result<void> Arguments::put(const Known& known, const std::vector<std::string>& values) {
  auto value = value_of(known.field, values);
  if (!value) return std::unexpected(value.error());
  json& to = given_[known.record][std::string(known.field.name)];
  if (to.is_array() && value->is_array())
    to.insert(to.end(), value->begin(), value->end());
  else
    to = std::move(*value);
  return {};
}

std::string Arguments::nearest(const std::string& option) const {
  for (const Known& known : fields_) {
    const std::string name = option_name(known.field.name);
    if (name.starts_with(option) || option.starts_with(name)) return "did you mean " + name + "?";
  }
  return "--help lists them";
}

}  // namespace keyline::app

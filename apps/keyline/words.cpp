#include "words.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/operations/json_form.h"
#include "keyline/operations/perform.h"
#include "keyline/operations/schema.h"

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::fail;
using core::Field;
using core::Result;
using core::Type;
using nlohmann::json;
using Kind = Type::Kind;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(at, from), text.size());
    parts.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

/// Turns the words of one option into JSON.
class Words {
 public:
  Words(const Field& field, OptionFiles& files) : field_(field), files_(files) {}

  Result<json> value(const Type& type, const std::vector<std::string>& words) const {
    if (words.size() == 1 && (words[0].starts_with('[') || words[0].starts_with('{'))) {
      auto j = operations::parse_request(words[0]);
      if (!j) j.error().path = option_name(field_.name);
      return j;
    }
    if (type.kind == Kind::optional) return value(type.item(), words);
    if (words.empty()) {
      if (type.kind == Kind::boolean) return json(true);
      return wrong("", "give a value after it");
    }
    if (type.kind == Kind::list) return list(type, words);
    if (words.size() > 1) return wrong(words[1], "give one value");
    return single(type, words[0]);
  }

 private:
  std::unexpected<core::Failure> wrong(const std::string& word, const std::string& hint) const {
    return fail(ErrorCode::bad_input,
                word.empty() ? "a value is missing" : "\"" + word + "\" does not belong here", hint,
                option_name(field_.name));
  }

  Result<json> number(const std::string& word, bool whole) const {
    const auto value = core::parse_number(word);
    if (!value) return wrong(word, operations::bounds_in_words(field_.bounds, whole));
    if (whole && *value == std::floor(*value) && std::abs(*value) < 9e15)
      return json(static_cast<std::int64_t>(*value));
    return json(*value);
  }

  Result<json> numbers(const std::vector<std::string>& words) const {
    json all = json::array();
    for (const std::string& word : words) {
      auto value = number(word, false);
      if (!value) return value;
      all.push_back(std::move(*value));
    }
    return all;
  }

  Result<json> single(const Type& type, const std::string& word) const {
    switch (type.kind) {
      case Kind::boolean:
        if (word == "true" || word == "yes" || word == "on") return json(true);
        if (word == "false" || word == "no" || word == "off") return json(false);
        return wrong(word, "give yes or no");
      case Kind::integer:
        return number(word, true);
      case Kind::number:
        return number(word, false);
      case Kind::point:
      case Kind::point3:
        return numbers(split(word, ','));
      case Kind::interval: {
        const char at = word.find(':') != std::string::npos ? ':' : ',';
        return numbers(split(word, at));
      }
      case Kind::one_of:
        return one_of(type, word);
      case Kind::value:
        return files_.first(word, things_of(type), option_name(field_.name));
      case Kind::list:
        return list(type, {word});
      case Kind::text:
      case Kind::choice:
      case Kind::record:
      case Kind::optional:
        break;
    }
    return json(word);
  }

  Result<json> one_of(const Type& type, const std::string& word) const {
    for (std::size_t i = 0; i < type.alternative_count; ++i) {
      const Type& alternative = type.alternatives[i]();
      const bool numeric = alternative.kind == Kind::number || alternative.kind == Kind::integer;
      if (numeric && !core::parse_number(word)) continue;
      if (alternative.kind == Kind::choice &&
          std::find(alternative.words, alternative.words + alternative.word_count, word) ==
              alternative.words + alternative.word_count)
        continue;
      const bool point = alternative.kind == Kind::point || alternative.kind == Kind::point3;
      if (point && !numbers(split(word, ','))) continue;
      return single(alternative, word);
    }
    return json(word);
  }

  Result<json> list(const Type& type, const std::vector<std::string>& words) const {
    const Kind item =
        type.item().kind == Kind::optional ? type.item().item().kind : type.item().kind;
    if (item == Kind::value) return of_files(type.item(), words);
    const bool plain = item == Kind::number || item == Kind::integer || item == Kind::boolean ||
                       item == Kind::text || item == Kind::choice;
    json all = json::array();
    for (const std::string& word : words)
      for (const std::string& part : plain ? split(word, ',') : std::vector{word}) {
        if (type.item().kind == Kind::optional && (part == "auto" || part == "null")) {
          all.push_back(nullptr);
          continue;
        }
        auto value =
            single(type.item().kind == Kind::optional ? type.item().item() : type.item(), part);
        if (!value) return value;
        all.push_back(std::move(*value));
      }
    return all;
  }

  Result<json> of_files(const Type& type, const std::vector<std::string>& words) const {
    json all = json::array();
    for (const std::string& word : words) {
      const auto things = files_.all(word, things_of(type), option_name(field_.name));
      if (!things) return std::unexpected(things.error());
      for (const json& thing : *things) all.push_back(thing);
    }
    return all;
  }

  static OptionFiles::Kind things_of(const Type& type) {
    return type.name == "Surface" ? OptionFiles::Kind::surfaces : OptionFiles::Kind::curves;
  }

  const Field& field_;
  OptionFiles& files_;
};

/// One or another of `count` words.
template <class Word>
std::string joined(std::size_t count, const Word& word) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += (i > 0 ? "|" : "") + word(i);
  return all;
}

std::string placeholder(const Type& type) {
  switch (type.kind) {
    case Kind::boolean:
      return "";
    case Kind::integer:
      return "N";
    case Kind::number:
      return "NUMBER";
    case Kind::text:
      return "TEXT";
    case Kind::choice:
      return joined(type.word_count, [&](std::size_t i) { return std::string(type.words[i]); });
    case Kind::point:
      return "X,Y";
    case Kind::point3:
      return "X,Y,Z";
    case Kind::interval:
      return "LOW:HIGH";
    case Kind::optional:
      return placeholder(type.item());
    case Kind::list: {
      const std::string item = placeholder(type.item());
      if (type.item().kind == Kind::list) return item + " ...";
      return item.find(',') != std::string::npos || type.item().kind == Kind::value ? item + "..."
                                                                                    : item + ",...";
    }
    case Kind::record:
      return type.from_text ? "TEXT" : "JSON";
    case Kind::one_of:
      return joined(type.alternative_count,
                    [&](std::size_t i) { return placeholder(type.alternatives[i]()); });
    case Kind::value:
      return "FILE";
  }
  return "";
}

std::string range_text(const core::Bounds& b) {
  const auto text = [](double x) { return core::number_text(x, 6); };
  if (std::isfinite(b.low) && std::isfinite(b.high)) return text(b.low) + " to " + text(b.high);
  if (std::isfinite(b.low)) return (b.low_excluded ? "more than " : "at least ") + text(b.low);
  if (std::isfinite(b.high)) return (b.high_excluded ? "less than " : "at most ") + text(b.high);
  return "";
}

/// The option on the left, its text beside it in lines that fit on a page.
std::string in_columns(const std::string& left, const std::string& right) {
  constexpr std::size_t kLeft = 30;
  constexpr std::size_t kRight = 68;
  std::string text = "  " + left;
  std::size_t column = text.size();
  text.append(column < kLeft ? kLeft - column : 0, ' ');
  if (column >= kLeft) text += "\n" + std::string(kLeft, ' ');
  column = 0;
  std::istringstream words(right);
  for (std::string word; words >> word; column += word.size() + 1) {
    if (column > 0 && column + word.size() > kRight) {
      text += "\n" + std::string(kLeft, ' ');
      column = 0;
    }
    text += (column > 0 ? " " : "") + word;
  }
  return text + "\n";
}

/// As it would be given; empty for records, switches and nothing.
std::string default_text(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return core::number_text(value.get<double>(), 8);
  if (value.is_number()) return value.dump();
  std::string text;
  if (value.is_array())
    for (const json& item : value) text += (text.empty() ? "" : " ") + default_text(item);
  return text;
}

}  // namespace

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

std::string option_name(std::string_view field) {
  std::string name = "--" + std::string(field);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

Result<json> value_of(const Field& field, const std::vector<std::string>& words,
                      OptionFiles& files) {
  return Words(field, files).value(field.type(), words);
}

OptionText option_text(const Field& field, const void* member) {
  OptionText option{.name = option_name(field.name), .value = placeholder(field.type())};
  std::string more;
  const auto add = [&](const std::string& text) {
    if (!text.empty()) more += (more.empty() ? "" : "; ") + text;
  };
  add(std::string(field.unit));
  add(range_text(field.bounds));
  if (field.required) add("needed");
  const json value = operations::default_of(field, member);
  if (const std::string text = default_text(value); !text.empty()) add("default " + text);
  option.text = std::string(field.text) + (more.empty() ? "" : " (" + more + ")");
  const Type* type = &field.type();
  while (type->kind == Kind::optional || type->kind == Kind::list) type = &type->item();
  option.deniable = type->kind == Kind::boolean && value != json(false);
  if (type->kind == Kind::choice)
    option.choices.assign(type->words, type->words + type->word_count);
  option.file = type->kind == Kind::value || field.name == "output" || field.name == "file";
  return option;
}

std::string shown_name(const OptionText& option) {
  return option.deniable ? "--[no-]" + option.name.substr(2) : option.name;
}

std::string help_line(const OptionText& option) {
  return in_columns(shown_name(option) + (option.value.empty() ? "" : " " + option.value),
                    option.text);
}

bool is_number_like(const Type& item, const std::string& word) {
  switch (item.kind) {
    case Kind::optional:
      return word == "auto" || word == "null" || is_number_like(item.item(), word);
    case Kind::one_of:
      for (std::size_t i = 0; i < item.alternative_count; ++i)
        if (is_number_like(item.alternatives[i](), word)) return true;
      return false;
    case Kind::number:
    case Kind::integer:
    case Kind::point:
    case Kind::point3:
    case Kind::interval:
    case Kind::list:
      return !word.empty() && word.find_first_not_of("0123456789+-.,:eE") == std::string::npos;
    default:
      return false;
  }
}

core::Failure as_options(core::Failure failure,
                         const std::function<bool(const std::string&)>& is_option) {
  const std::size_t end = failure.path.find_first_of(".[:/ ");
  if (!is_option(option_name(failure.path.substr(0, end)))) return failure;
  if (end == std::string::npos && !failure.path.empty() && !failure.path.starts_with("--"))
    failure.path = option_name(failure.path);
  else if (end != std::string::npos && failure.path[end] == '[')
    failure.path = option_name(failure.path.substr(0, end)) + failure.path.substr(end);
  return failure;
}

}  // namespace keyline::app

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <nlohmann/json.hpp>

#include "keyline/core/coordinate.h"
#include "keyline/core/nearest_word.h"
#include "keyline/core/text.h"
#include "keyline/operations/json_form.h"

namespace keyline::operations {
namespace {

using core::Bounds;
using core::ErrorCode;
using core::Field;
using core::Result;
using core::Type;
using nlohmann::json;
using Kind = Type::Kind;

/// Where in the request: made into text only for a failure.
struct Place {
  const Place* parent = nullptr;
  std::string_view name;
  std::size_t index = 0;

  std::string text() const {
    if (!parent) return std::string(name);
    if (name.empty()) return parent->text() + "[" + std::to_string(index) + "]";
    const std::string above = parent->text();
    return above.empty() ? std::string(name) : above + "." + std::string(name);
  }
};

std::unexpected<core::Failure> wrong(const Place& place, std::string message, std::string hint) {
  return core::fail(ErrorCode::bad_input, std::move(message), std::move(hint), place.text());
}

std::unexpected<core::Failure> not_a(const Place& place, const char* wanted) {
  return wrong(place, std::string(wanted) + " is wanted here", "");
}

std::string in_quotes(std::string_view name) { return "\"" + std::string(name) + "\""; }

Result<void> read(const Type& type, const Field& field, const json& j, const Place& place,
                  void* value);

Result<void> within(const Bounds& bounds, double value, bool whole, const Place& place) {
  if (contains(bounds, value)) return {};
  const bool sign = bounds == core::kPositive;
  return wrong(
      place,
      core::number_text(value, 10) + (sign ? " is not greater than zero" : " is out of range"),
      bounds_in_words(bounds, whole));
}

Result<double> finite(const json& j, const Place& place) {
  if (!j.is_number()) return not_a(place, "a number");
  const double value = j.get<double>();
  if (!std::isfinite(value)) return wrong(place, "the number is not finite", "give a finite one");
  return core::with_all_digits(value);
}

Result<void> read_integer(const Type& type, const Field& field, const json& j, const Place& place,
                          void* value) {
  std::int64_t whole = 0;
  if (j.is_number_unsigned() && j.get<std::uint64_t>() > INT64_MAX)
    return wrong(place, in_quotes(place.text()) + " is out of range",
                 bounds_in_words(field.bounds, true));
  if (j.is_number_integer()) {
    whole = j.get<std::int64_t>();
  } else {
    const double given = j.is_number_float() ? j.get<double>() : NAN;
    if (!(given == std::floor(given) && std::abs(given) < 9e15))
      return not_a(place, "a whole number");
    whole = static_cast<std::int64_t>(given);
  }
  if (auto in = within(field.bounds, static_cast<double>(whole), true, place); !in) return in;
  if (!type.set_integer(value, whole))
    return wrong(place, in_quotes(place.text()) + " is out of range",
                 "give a smaller number, from 0");
  return {};
}

std::string listed(const std::string_view* words, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += i + 1 < count ? ", " : " or ";
    text += words[i];
  }
  return text;
}

Result<void> read_choice(const Type& type, const json& j, const Place& place, void* value) {
  if (!j.is_string()) return not_a(place, "a word");
  const auto& word = j.get_ref<const std::string&>();
  const auto* const end = type.words + type.word_count;
  const auto* const found = std::find(type.words, end, word);
  if (found == end)
    return wrong(place, in_quotes(word) + " is no choice here",
                 "give " + listed(type.words, type.word_count));
  type.choose(value, static_cast<std::size_t>(found - type.words));
  return {};
}

/// Coordinates into x, y (and z): all of them but a last one that may be left out, or must be 0.
Result<void> read_coordinates(const json& j, const Place& place, std::span<double* const> to) {
  const std::size_t count = to.size();
  if (!j.is_array() || j.size() < 2 || j.size() > 3)
    return wrong(place, "a point is wanted here", count == 2 ? "give [x, y]" : "give [x, y, z]");
  for (std::size_t i = 0; i < j.size(); ++i) {
    const auto number = finite(j[i], Place{&place, {}, i});
    if (!number) return std::unexpected(number.error());
    if (core::is_too_large(*number)) return core::coordinate_too_large(Place{&place, {}, i}.text());
    if (i >= count) {
      if (*number != 0)
        return core::fail(ErrorCode::unsupported, "a point in space where a planar one is wanted",
                          "project the points on a plane first", place.text());
      continue;
    }
    *to[i] = *number;
  }
  return {};
}

Result<void> read_number(const Field& field, const json& j, const Place& place, double& value) {
  const auto number = finite(j, place);
  if (!number) return std::unexpected(number.error());
  if (auto in = within(field.bounds, *number, false, place); !in) return in;
  value = *number;
  return {};
}

Result<void> read_interval(const Field& field, const json& j, const Place& place,
                           core::Interval& value) {
  if (!j.is_array() || j.size() != 2)
    return wrong(place, "a range is wanted here", "give [low, high]");
  double ends[2] = {};
  for (std::size_t i = 0; i < 2; ++i) {
    const Place here{&place, {}, i};
    if (auto done = read_number(field, j[i], here, ends[i]); !done) return done;
  }
  if (!(ends[0] <= ends[1]))
    return wrong(place, "the range ends before it starts", "give [low, high]");
  value = {ends[0], ends[1]};
  return {};
}

std::string count_in_words(std::size_t least, std::size_t most) {
  if (least == most) return "give " + std::to_string(least);
  if (most == std::numeric_limits<std::size_t>::max())
    return "give at least " + std::to_string(least);
  return "give " + std::to_string(least) + " to " + std::to_string(most);
}

Result<void> read_list(const Type& type, const Field& field, const json& j, const Place& place,
                       void* value) {
  const Type& item = type.item();
  Field each = field;
  each.least = 0;
  each.most = std::numeric_limits<std::size_t>::max();
  each.or_one = false;
  if (type.clear) type.clear(value);
  if (!j.is_array()) {
    if (!field.or_one) return not_a(place, "a list");
    return read(item, each, j, place, type.fixed > 0 ? type.at(value, 0) : type.append(value));
  }
  const std::size_t least = type.fixed > 0 ? type.fixed : field.least;
  const std::size_t most = type.fixed > 0 ? type.fixed : field.most;
  if (j.size() < least || j.size() > most)
    return wrong(
        place, in_quotes(place.text()) + " holds " + core::counted(j.size(), "item"),
        count_in_words(least, most) + (field.text.empty() ? "" : ": ") + std::string(field.text));
  for (std::size_t i = 0; i < j.size(); ++i) {
    void* const to = type.fixed > 0 ? type.at(value, i) : type.append(value);
    if (item.kind == Kind::optional && j[i].is_null()) continue;
    if (auto done = read(item, each, j[i], Place{&place, {}, i}, to); !done) return done;
  }
  return {};
}

/// Whether the value is of the kind at all, to tell the alternatives of a one_of apart.
bool resembles(const Type& type, const json& j) {
  switch (type.kind) {
    case Kind::boolean:
      return j.is_boolean();
    case Kind::integer:
    case Kind::number:
      return j.is_number();
    case Kind::text:
    case Kind::choice:
      return j.is_string();
    case Kind::point:
    case Kind::point3:
    case Kind::interval:
      return j.is_array() && !j.empty() && j[0].is_number();
    case Kind::optional:
      return j.is_null() || resembles(type.item(), j);
    case Kind::list:
      return j.is_array() && (j.empty() || resembles(type.item(), j[0]));
    case Kind::record:
      return j.is_object() || (j.is_string() && type.from_text);
    case Kind::value:
      return j.is_object();
    case Kind::one_of:
      break;
  }
  return false;
}

/// What an alternative is called in "… or … is wanted here".
std::string kind_in_words(const Type& type) {
  switch (type.kind) {
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "a whole number";
    case Kind::number:
      return "a number";
    case Kind::text:
      return "a string";
    case Kind::choice:
      return listed(type.words, type.word_count);
    case Kind::point:
      return "a point [x, y]";
    case Kind::point3:
      return "a point [x, y, z]";
    case Kind::interval:
      return "a range [low, high]";
    case Kind::optional:
      return kind_in_words(type.item());
    case Kind::list:
      return "a list";
    case Kind::record:
      return "an object";
    case Kind::value:
      return "a " + std::string(type.name);
    case Kind::one_of:
      break;
  }
  return "a value";
}

Result<void> read_one_of(const Type& type, const Field& field, const json& j, const Place& place,
                         void* value) {
  std::string wanted;
  for (std::size_t i = 0; i < type.alternative_count; ++i) {
    const Type& alternative = type.alternatives[i]();
    if (resembles(alternative, j)) return read(alternative, field, j, place, type.become(value, i));
    wanted += (wanted.empty() ? "" : ", or ") + kind_in_words(alternative);
  }
  return not_a(place, wanted.c_str());
}

/// The field of that name read where a record has it: true; false where none has.
Result<bool> read_member(std::span<const Part> parts, std::string_view name, const json& j,
                         const Place& parent) {
  Result<bool> found = false;
  for (const Part& part : parts)
    core::visit_fields(*part.type, part.record, [&](const Field& field, void* member) {
      if (field.name != name || !found || *found) return;
      found = true;
      auto done = read(field.type(), field, j, Place{&parent, field.name}, member);
      if (!done) found = std::unexpected(std::move(done.error()));
    });
  return found;
}

std::string nearest_name(std::span<const Part> parts, std::string_view name) {
  std::vector<std::string_view> names;
  for (const Part& part : parts)
    core::visit_fields(*part.type, part.record,
                       [&](const Field& field, void*) { names.push_back(field.name); });
  return std::string(core::nearest_word(name, names));
}

/// `subject`: what the fields are of, "lac.segment"; empty inside a request.
Result<void> read_records(const json& object, std::span<const Part> parts,
                          std::span<const std::string_view> passed, std::string_view subject,
                          const Place& place) {
  for (const auto& [name, value] : object.items()) {
    if (std::find(passed.begin(), passed.end(), name) != passed.end()) continue;
    const auto found = read_member(parts, name, value, place);
    if (!found) return std::unexpected(found.error());
    if (*found) continue;
    const std::string near = nearest_name(parts, name);
    std::string hint = near.empty() ? "" : "did you mean \"" + near + "\"?";
    if (!subject.empty())
      hint += (hint.empty() ? "keyline operations " : " keyline operations ") +
              std::string(subject) + " lists its fields";
    return wrong(Place{&place, name},
                 in_quotes(name) + " is not a field of " +
                     (subject.empty() ? in_quotes(place.text()) : std::string(subject)),
                 hint);
  }
  Result<void> complete;
  for (const Part& part : parts) {
    core::visit_fields(*part.type, part.record, [&](const Field& field, void*) {
      if (complete && field.required && !object.contains(field.name))
        complete = wrong(Place{&place, field.name}, in_quotes(field.name) + " is missing",
                         std::string(field.text));
    });
    if (!complete) return complete;
    if (!part.type->check) continue;
    if (auto sound = part.type->check(part.record); !sound) {
      const std::string above = place.text();
      if (!above.empty())
        sound.error().path = above + (sound.error().path.empty() ? "" : "." + sound.error().path);
      return sound;
    }
  }
  return complete;
}

Result<void> read_record(const Type& type, const json& j, const Place& place, void* value) {
  if (j.is_string() && type.from_text) {
    auto done = type.from_text(j.get_ref<const std::string&>(), value);
    if (!done) {
      done.error().path = place.text();
      return done;
    }
    return type.check ? type.check(value) : Result<void>{};
  }
  if (!j.is_object()) {
    if (!type.from_text) return not_a(place, "an object");
    return wrong(place, "an object or its text is wanted here", std::string(type.text_form));
  }
  const Part part{&type, value};
  return read_records(j, {&part, 1}, {}, {}, place);
}

Result<void> read_point(const json& j, const Place& place, core::Point2& p) {
  return read_coordinates(j, place, std::array{&p.x, &p.y});
}

Result<void> read_point(const json& j, const Place& place, core::Point3& p) {
  return read_coordinates(j, place, std::array{&p.x, &p.y, &p.z});
}

Result<void> read(const Type& type, const Field& field, const json& j, const Place& place,
                  void* value) {
  switch (type.kind) {
    case Kind::boolean:
      if (!j.is_boolean()) return not_a(place, "true or false");
      *static_cast<bool*>(value) = j.get<bool>();
      return {};
    case Kind::integer:
      return read_integer(type, field, j, place, value);
    case Kind::number:
      return read_number(field, j, place, *static_cast<double*>(value));
    case Kind::text:
      if (!j.is_string()) return not_a(place, "a string");
      *static_cast<std::string*>(value) = j.get<std::string>();
      return {};
    case Kind::choice:
      return read_choice(type, j, place, value);
    case Kind::point:
      return read_point(j, place, *static_cast<core::Point2*>(value));
    case Kind::point3:
      return read_point(j, place, *static_cast<core::Point3*>(value));
    case Kind::interval:
      return read_interval(field, j, place, *static_cast<core::Interval*>(value));
    case Kind::optional:
      return read(type.item(), field, j, place, type.emplace(value));
    case Kind::list:
      return read_list(type, field, j, place, value);
    case Kind::record:
      return read_record(type, j, place, value);
    case Kind::one_of:
      return read_one_of(type, field, j, place, value);
    case Kind::value:
      return static_cast<const ValueForm*>(type.form)->read(j, place.text(), value);
  }
  return {};
}

}  // namespace

Result<void> read_json(const json& object, std::span<const Part> parts,
                       std::span<const std::string_view> passed, std::string_view subject) {
  if (!object.is_object())
    return core::fail(ErrorCode::bad_input, "the request is not a JSON object", "give {…}");
  return read_records(object, parts, passed, subject, Place{});
}

}  // namespace keyline::operations

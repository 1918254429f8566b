#include "keyline/exchange/occt/value_check.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "keyline/core/leading_number.h"
#include "keyline/core/text.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/byte_lines.h"

namespace keyline::exchange::occt {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool is_letter(char c) {  // or the mark of a name of the user's own
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '!';
}

std::string told(std::size_t line, std::string_view value) {
  return "line " + std::to_string(line) + ": \"" + core::on_one_line(value.substr(0, 40)) +
         "\" is no value";
}

/// Goes through the words of a STEP file.
class StepValues {
 public:
  explicit StepValues(std::string_view text) : text_(text) {}

  std::string bad() {
    for (at_ = std::min(text_.find("DATA;"), text_.size()); at_ < text_.size();) {
      const char c = text_[at_];
      if (c == '\'' || c == '"') {
        skip_quoted(c);
      } else if (text_.substr(at_, 2) == "/*") {
        at_ = std::min(text_.find("*/", at_ + 2), text_.size() - 1) + 1;
      } else if (is_start(c)) {
        const std::size_t from = at_;
        const std::string_view value = word();
        if (!is_value(value)) return told(line_of(from), value);
        if (depth_ > 0 && is_loose(value)) loose_.push_back(from);
        if (is_fourth(value))
          return "line " + std::to_string(line_of(from)) +
                 ": a point or direction of more than three coordinates";
      } else if (is_gap(c)) {
        return told(line_of(at_), {});
      } else {
        depth_ += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (c == ';') depth_ = listed_ = 0;
        ++at_;
      }
    }
    return {};
  }

  /// The text with the loose numbers that were met as they are to be written; empty where none was.
  std::string mended() const {
    std::string text;
    if (loose_.empty()) return text;
    std::size_t done = 0;
    for (const std::size_t from : loose_) {
      const std::size_t power = text_.find_first_of("eE", from);
      text += text_.substr(done, power - done);
      if (text_.substr(from, power - from).find('.') == text_.npos) text += '.';
      text += 'E';
      done = power + 1;
    }
    return text += text_.substr(done);
  }

 private:
  static constexpr std::string_view kMarks = "(),;=/'\"$*";

  static bool is_start(char c) { return !is_space(c) && kMarks.find(c) == kMarks.npos; }

  /// What is left out has a mark of its own, $; nothing between two commas is a value lost.
  bool is_gap(char c) const {
    if (depth_ == 0 || (c != ',' && c != ')')) return false;
    std::size_t before = at_;
    while (before > 0 && is_space(text_[before - 1])) --before;
    return before > 0 && (text_[before - 1] == ',' || (c == ',' && text_[before - 1] == '('));
  }

  /// A quote within is doubled: it ends one string and starts the next.
  void skip_quoted(char quote) { at_ = std::min(text_.find(quote, at_ + 1), text_.size() - 1) + 1; }

  std::string_view word() {
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_space(text_[at_]) && kMarks.find(text_[at_]) == kMarks.npos)
      ++at_;
    return text_.substr(from, at_ - from);
  }

  /// Outside brackets words are keywords and numbers of instances; within, names stand before a
  /// bracket of their own.
  bool is_value(std::string_view word) const {
    if (depth_ == 0 || word.starts_with('#')) return true;
    const bool enumeration = word.size() > 2 && word.starts_with('.') && word.ends_with('.');
    if (enumeration) return true;
    if (!is_letter(word.front())) return core::parse_number(word).has_value();
    std::size_t next = at_;
    while (next < text_.size() && is_space(text_[next])) ++next;
    return next < text_.size() && text_[next] == '(';
  }

  /// A number with a small e, or a power of ten without a point: OCCT takes it for 0.
  static bool is_loose(std::string_view word) {
    if (is_letter(word.front()) || word.front() == '#') return false;
    const std::size_t power = word.find_first_of("eE");
    if (power == word.npos || word.ends_with('.')) return false;
    return word[power] == 'e' || word.substr(0, power).find('.') == word.npos;
  }

  /// A number behind the third of a point's or direction's, as a decimal comma makes it.
  bool is_fourth(std::string_view word) {
    if (word == "CARTESIAN_POINT" || word == "DIRECTION") {
      listed_ = depth_ + 2;
      coordinates_ = 0;
    }
    const bool counts = depth_ == listed_ && listed_ > 0 && !is_letter(word.front());
    return counts && ++coordinates_ > 3;
  }

  std::size_t line_of(std::size_t place) const {
    return detail::line_of(text_, static_cast<std::ptrdiff_t>(place));
  }

  std::string_view text_;
  std::vector<std::size_t> loose_;  ///< where such numbers begin
  std::size_t at_ = 0;
  int depth_ = 0;
  int listed_ = 0;  ///< depth of the coordinates of the point or direction last met
  int coordinates_ = 0;
};

constexpr std::size_t kSection = 72;  // column of an IGES line's section, from 0

/// A number as Fortran writes it too, with D before the exponent.
bool is_iges_number(std::string_view word) {
  std::string plain(word);
  for (char& c : plain)
    if (c == 'D' || c == 'd') c = 'E';
  return core::parse_number(plain).has_value();
}

using Words = std::vector<std::string_view>;

/// The parameters of one entity, its type first; of strings what is behind them, as nothing.
Words words_of(std::string_view text) {
  Words words;
  for (std::size_t at = 0; at < text.size();) {
    at = std::min(text.find_first_not_of(" \t", at), text.size());
    std::string_view behind = text.substr(at);
    const auto length = core::take_whole<std::size_t>(behind);
    if (length && behind.starts_with('H'))  // a string
      at = text.size() - behind.size() + 1 + std::min(*length, behind.size() - 1);
    const std::size_t stop = std::min(text.find_first_of(",;", at), text.size());
    std::string_view word = text.substr(at, stop - at);
    while (word.ends_with(' ')) word.remove_suffix(1);
    words.push_back(word);
    if (stop < text.size() && text[stop] == ';') break;  // a remark may follow
    at = stop + 1;
  }
  return words;
}

/// A count among the parameters: 0 where it is left out, none where it is no count.
std::optional<std::size_t> count_at(const Words& words, std::size_t place) {
  if (place >= words.size() || words[place].empty()) return 0;
  const auto count = core::parse_whole<std::size_t>(words[place]);
  return count && *count <= words.size() ? count : std::nullopt;
}

/// How many parameters an entity of fixed length has, its type among them (IGES 5.3, 4.3 to 4.36).
std::optional<std::size_t> fixed_count_of(int type) {
  static const std::map<int, std::size_t> kCounts = {
      {100, 8}, {104, 12}, {108, 10}, {110, 7}, {116, 5},  {118, 5}, {120, 5},
      {122, 5}, {123, 4},  {124, 13}, {125, 7}, {130, 15}, {140, 6}, {142, 6}};
  const auto found = kCounts.find(type);
  return found == kCounts.end() ? std::nullopt : std::optional(found->second);
}

/// How many parameters an entity has by the counts it tells, its type among them (IGES 5.3, 4.4,
/// 4.6, 4.14, 4.23, 4.24, 4.33, 4.34); none of types without.
std::optional<std::size_t> count_of(int type, const Words& words) {
  if (const auto fixed = fixed_count_of(type)) return fixed;
  const auto a = count_at(words, 1), b = count_at(words, 2), c = count_at(words, 3),
             d = count_at(words, 4);
  if (type == 102 && a) return 2 + *a;
  if (type == 143 && c) return 4 + *c;
  if (type == 144 && c) return 5 + *c;
  if (!a || !b) return std::nullopt;
  if (type == 106 && *a >= 1 && *a <= 3) return *a == 1 ? 4 + 2 * *b : 3 + (*a == 2 ? 3 : 6) * *b;
  if (type == 126) return 18 + 5 * *a + *b;  // of index a and degree b
  if (!c || !d) return std::nullopt;
  if (type == 112) return 18 + 13 * *d;
  if (type == 128) return 18 + *a + *b + *c + *d + 4 * (*a + 1) * (*b + 1);
  return std::nullopt;
}

/// What may stand behind an entity's own parameters: twice a count and so many pointers (IGES 5.3,
/// 2.2.4.5.2) to first lines of the directory, which have odd numbers. No writer ends with a count
/// of none by itself: what a decimal comma leaves over may look like one.
bool are_pointers(std::span<const std::string_view> words) {
  if (words.size() == 1) return words[0].empty();
  const auto is_pointer = [](std::string_view word) {
    return core::parse_whole<std::size_t>(word).value_or(0) % 2 == 1;
  };
  for (int list = 0; list < 2 && !words.empty(); ++list) {
    const auto count = words[0].empty() ? 0 : core::parse_whole<std::size_t>(words[0]);
    if (!count || *count >= words.size()) return false;
    if (!std::ranges::all_of(words.subspan(1, *count), is_pointer)) return false;
    words = words.subspan(1 + *count);
  }
  return words.empty();
}

/// What is wrong with the parameters of one entity, which start in that line; empty where nothing
/// is: all are numbers, strings or absent, and no more than there are of its type.
std::string wrong_with(std::string_view text, std::size_t line) {
  const std::string_view kind = detail::trimmed(text.substr(0, text.find_first_of(",;")));
  if (kind.empty()) return {};
  const auto type = core::parse_whole<int>(kind);
  if (!type) return told(line, kind);
  if (*type < 100 || *type >= 200) return {};
  const Words words = words_of(text);
  for (const std::string_view word : words)
    if (!word.empty() && !is_iges_number(word)) return told(line, word);
  const std::size_t own = count_of(*type, words).value_or(words.size());
  if (words.size() <= own || are_pointers(std::span(words).subspan(own))) return {};
  return "line " + std::to_string(line) + ": more numbers than an entity of type " +
         std::to_string(*type) + " has";
}

/// The first of a directory line's nine fields of eight columns that is no whole number (IGES 5.3,
/// 2.2.4.4): of a second line from its 6th on they are reserved, or a label and its subscript.
std::string_view bad_directory_field(std::string_view line, bool second) {
  constexpr std::size_t kWidth = 8;
  constexpr std::size_t kStatus = 8;  // of the first line: pairs of digits, or blanks for zeros
  for (std::size_t k = 0; k < 9; ++k) {
    if (second && k >= 5) continue;
    std::string_view field = detail::trimmed(line.substr(k * kWidth, kWidth));
    const bool status = !second && k == kStatus;
    if (status && field.find_first_not_of("0123456789 ") == field.npos) continue;
    if (!field.empty() && !core::parse_whole<long>(field)) return field;
  }
  return {};
}

/// A blank where the line ends before it.
char section_of(std::string_view line) { return line.size() > kSection ? line[kSection] : ' '; }

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\x1a") == line.npos; }

/// The global section starts with its separators, "1H,,1H;,", or leaves out the usual ones, ",,".
bool has_usual_separators(std::string_view text) {
  detail::ByteLines lines(text);
  for (std::string_view line; lines.next(line);)
    if (section_of(line) == 'G') return line.starts_with(",,") || line.starts_with("1H,,1H;,");
  return false;
}

}  // namespace

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

StepCheck check_step_values(std::string_view text) {
  StepValues values(text);
  std::string bad = values.bad();
  if (!bad.empty()) return {.bad = std::move(bad), .mended = {}};
  return {.bad = {}, .mended = values.mended()};
}

std::string missing_iges_end(std::string_view text) {
  std::size_t parameters = 0;
  std::string_view last;
  detail::ByteLines lines(text);
  for (std::string_view line; lines.next(line);) {
    if (is_blank(line)) continue;
    last = line;
    parameters += section_of(line) == 'P';
  }
  if (section_of(last) != 'T')
    return "the rest of the file: it is cut off before its last line (section T)";
  std::string_view count = last.substr(last.find('P') + 1);
  count.remove_prefix(std::min(count.find_first_not_of(' '), count.size()));
  const auto told = core::take_whole<std::size_t>(count);
  if (!told || *told <= parameters) return {};
  return core::counted(*told - parameters, "parameter line") + " of " + std::to_string(*told) +
         " that are not in the file";
}

std::string endless_iges_lines(std::string_view text) {
  constexpr std::size_t kWidth = 8, kForm = 4 * kWidth;  // fields of a directory line
  std::size_t endless = 0;
  bool second = true;
  detail::ByteLines lines(text);
  for (std::string_view line; lines.next(line);) {
    if (section_of(line) != 'D' || !(second = !second)) continue;
    const std::string_view form = detail::trimmed(line.substr(kForm, kWidth));
    endless += detail::trimmed(line.substr(0, kWidth)) == "110" && (form == "1" || form == "2");
  }
  if (endless == 0) return {};
  return "what lies beyond the two points of " + core::counted(endless, "line") + " without end";
}

std::string odd_iges_line(std::string_view text) {
  detail::ByteLines lines(text);
  for (std::string_view line; lines.next(line);) {
    if (is_blank(line)) continue;
    const char section = section_of(line);
    if (section == 'T') break;
    if (std::string_view("SGDP").find(section) == std::string_view::npos)
      return lines.place() +
             ": it has no letter of a section in column 73; it and what belongs to it";
  }
  return {};
}

std::string unordered_iges_line(std::string_view text) {
  constexpr std::size_t kNumber = kSection + 1, kDigits = 7;
  std::map<char, std::size_t> last;  // number of every section
  detail::ByteLines lines(text);
  for (std::string_view line; lines.next(line);) {
    if (is_blank(line)) continue;
    const char section = section_of(line);
    if (section == 'T') break;
    const std::string_view number =
        detail::trimmed(line.substr(std::min(kNumber, line.size()), kDigits));
    const std::size_t next = ++last[section];
    if (!number.empty() && core::parse_whole<std::size_t>(number) != next)
      return lines.place() + ": line " + std::to_string(next) + " of section " + section +
             " should stand here";
  }
  return {};
}

std::string bad_iges_value(std::string_view text) {
  constexpr std::size_t kData = 64;  // columns of a parameter line; the entity's number follows
  // Other separators than "," and ";" are named at the start of the global section.
  if (!has_usual_separators(text)) return {};
  std::string parameters;
  std::string_view owner;
  std::size_t first = 1;
  bool second = true;  // of the two lines of an entity's directory
  std::string found;
  const auto check = [&] {
    if (found.empty()) found = wrong_with(parameters, first);
    parameters.clear();
  };
  detail::ByteLines lines(text);
  for (std::string_view line; found.empty() && lines.next(line);) {
    const char section = section_of(line);
    if (section == 'D') {
      const std::string_view bad = bad_directory_field(line, second = !second);
      if (!bad.empty()) return told(lines.number(), bad);
    }
    if (section != 'P') continue;
    if (line.substr(kData, 8) != owner) {
      check();
      owner = line.substr(kData, 8);
      first = lines.number();
    }
    parameters += line.substr(0, kData);
  }
  check();
  return found;
}

}  // namespace keyline::exchange::occt

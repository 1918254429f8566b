#include "options.h"

#include <algorithm>
#include <iterator>

#include "keyline/core/leading_number.h"

namespace keyline::studio {
namespace {

using core::Result;

/// One option: what it is called, and what it does with its value (with "" where it takes none).
struct Option {
  const char* name;
  const char* value;  ///< what the help calls it; null: it takes none
  const char* text;
  /// Null, or what is wrong with the value.
  const char* (*set)(Options& options, const std::string& value);
};

const char* set_port(Options& options, const std::string& value) {
  const auto port = core::parse_whole<decltype(options.port)>(value);
  if (!port) return "a port is a number up to 65535";
  options.port = *port;
  return nullptr;
}

const char* set_token(Options& options, const std::string& value) {
  constexpr std::size_t kLeast = 16;
  const bool plain = std::ranges::all_of(value, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
           c == '_';
  });
  options.token = value;
  return plain && value.size() >= kLeast ? nullptr
                                         : "a token has 16 or more letters, digits, - or _";
}

constexpr Option kOptions[] = {
    {"--port", "PORT", "port to listen on; 0: any that is free (default)", set_port},
    {"--listen", "ADDRESS", "address to listen on, for other machines; needs --token (127.0.0.1)",
     [](Options& o, const std::string& v) -> const char* {
       o.address = v;
       return nullptr;
     }},
    {"--token", "TOKEN", "secret that a browser must give; made up unless given", set_token},
    {"--host", "NAME", "name the server is reached by, with --listen; may be repeated",
     [](Options& o, const std::string& v) -> const char* {
       o.hosts.push_back(v);
       return nullptr;
     }},
    {"--no-browser", nullptr, "print the address, open nothing",
     [](Options& o, const std::string&) -> const char* {
       o.no_browser = true;
       return nullptr;
     }},
    {"--quiet", nullptr, "no messages but errors",
     [](Options& o, const std::string&) -> const char* {
       o.quiet = true;
       return nullptr;
     }},
    {"--version", nullptr, "print the version and exit",
     [](Options& o, const std::string&) -> const char* {
       o.version = true;
       return nullptr;
     }},
    {"--help", nullptr, "print this and exit",
     [](Options& o, const std::string&) -> const char* {
       o.help = true;
       return nullptr;
     }},
};

std::unexpected<core::Failure> wrong(const std::string& word, const std::string& what) {
  return core::fail(core::ErrorCode::bad_input, word + ": " + what, "see keyline studio --help");
}

}  // namespace

Result<Options> read_options(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!words[i].starts_with("-") || words[i] == "-") {
      options.files.push_back(words[i]);
      continue;
    }
    const std::size_t mark = words[i].find('=');
    const std::string name = words[i] == "-h" ? "--help" : words[i].substr(0, mark);
    const auto* const option =
        std::ranges::find_if(kOptions, [&](const Option& o) { return name == o.name; });
    if (option == std::end(kOptions)) return wrong(name, "there is no such option");
    std::string value;
    if (mark != std::string::npos)
      value = words[i].substr(mark + 1);
    else if (option->value != nullptr && ++i < words.size())
      value = words[i];
    if ((option->value == nullptr) != value.empty())
      return wrong(name, option->value ? "a value is missing" : "it takes no value");
    if (const char* what = option->set(options, value)) return wrong(name, what);
  }
  return options;
}

std::vector<OptionLine> option_lines() {
  std::vector<OptionLine> lines;
  for (const Option& option : kOptions) lines.push_back({option.name, option.value, option.text});
  return lines;
}

const char* help_text() {
  return "Keyline Studio: draw, see the curvature, fair it, take it home.";
}

const char* help_example() {
  return "FILE: to open at the start: points, curves, drawings, surfaces.\n"
         "Example: keyline studio examples/bonnet-scan.csv\n"
         "Files are read and written in the folder it is started in, and nowhere else.\n";
}

std::string help() {
  std::string text =
      std::string(help_text()) + "\n\nkeyline studio [FILE...] [options]\n\nOptions:\n";
  for (const OptionLine& option : option_lines()) {
    std::string head = std::string("  ") + option.name;
    if (option.value) head += std::string(" ") + option.value;
    head.resize(std::max<std::size_t>(head.size() + 1, 20), ' ');
    text += head + option.text + "\n";
  }
  return text + "\n" + help_example();
}

}  // namespace keyline::studio

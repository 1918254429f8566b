#pragma once

#include <string>
#include <vector>

#include "keyline/core/error.h"

/// The words after `keyline studio`.
namespace keyline::studio {

struct Options {
  std::vector<std::string> files = {};
  std::string address = "127.0.0.1";
  unsigned short port = 0;  ///< 0: any that is free
  std::string token = {};   ///< empty: one is made
  std::vector<std::string> hosts = {};
  bool no_browser = false;
  bool quiet = false;
  bool help = false;
  bool version = false;
};

/// Fails: bad_input, with the option it is about.
core::Result<Options> read_options(const std::vector<std::string>& words);

/// What the help says before the options, and after them.
const char* help_text();
const char* help_example();
std::string help();

/// An option as help, completion and manual pages tell it.
struct OptionLine {
  const char* name;   ///< "--port"
  const char* value;  ///< null: it takes none
  const char* text;
};
std::vector<OptionLine> option_lines();

}  // namespace keyline::studio

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

std::string help();

/// All of them, as they are typed: for completion.
std::vector<std::string> option_names();

}  // namespace keyline::studio

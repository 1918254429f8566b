#pragma once

#include <string>
#include <vector>

#include "keyline/core/error.h"

#include "arguments.h"

/// What the declarations say of the commands, for shells and for man: nothing is told twice.
namespace keyline::app {

/// A command as its help tells it.
struct Manual {
  std::string command;  ///< "fair"
  std::string words;    ///< "FILE... ": what stands before the options
  std::string text;
  std::vector<OptionTexts> groups;
  std::string more = {};  ///< example and formats
};

std::vector<std::string> option_names(const Manual& manual);

/// Every command, tool and operation, in the order of the help.
std::vector<Manual> manuals();

/// Every word that may stand first: commands, tools, operations, then their rooms ("library") and
/// "help", "man", "completion".
std::vector<std::string> first_words(const std::vector<Manual>& manuals);

/// A script for "bash", "zsh" or "fish". Fails: bad_input.
core::Result<std::string> completion(const std::string& shell);

/// The page of section 1 in roff: of the command, or of keyline itself where it is empty.
/// Fails: bad_input.
core::Result<std::string> manual_page(const std::string& command);

/// Writes keyline.1 and keyline-COMMAND.1 of every command into the folder, which is made.
/// Fails: io.
core::Result<void> write_manual_pages(const std::string& folder);

}  // namespace keyline::app

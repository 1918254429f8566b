#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}

namespace keyline::app {

/// A subcommand as the parser knows it, and what runs it; the argument is the line that was typed.
struct Command {
  CLI::App* parser;
  std::function<int(const std::string&)> run;
};

/// Declares every command with its options. The commands keep their options alive.
std::vector<Command> add_commands(CLI::App& app);

}  // namespace keyline::app

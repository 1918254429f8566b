#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string_view>
#include <system_error>

#include <CLI/CLI.hpp>

#include "command_line.h"
#include "operation_command.h"
#include "terminal.h"

namespace keyline::app {
namespace {

/// A word as a shell has to be given it: in quotes where it holds more than plain characters.
std::string as_typed(const std::string& word) {
  constexpr const char* kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./,:=+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

bool has_command(const std::vector<Command>& commands, const std::string& name) {
  return std::ranges::any_of(commands,
                             [&](const Command& c) { return c.parser->get_name() == name; });
}

/// The command's exit status, or that of a failure if what was printed did not arrive: a full disk
/// or a closed output shows only once everything is flushed.
int once_printed(int status) {
  errno = 0;
  std::cout.flush();
  const bool printed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  if (printed || status == kIo) return status;
  const std::string reason = errno == 0 ? "" : ": " + std::generic_category().message(errno);
  return report_failure({core::ErrorCode::io, "standard output cannot be written" + reason,
                         "check where it goes to", ""});
}

/// Changes of one letter (added, dropped, another) that lead from one word to the other.
std::size_t letters_apart(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t other = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({other, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

/// "did you mean --tolerance? " for a word that is nearly an option of the command, else nothing.
std::string likely_option(const CLI::App& command, const std::string& message) {
  const std::size_t at = message.find("--");
  if (at == std::string::npos || message.find("expected") == std::string::npos) return "";
  const std::string word = message.substr(at, message.find_first_of(" =", at) - at);
  std::string best;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames())
      if (word.size() < 40 && letters_apart(word, "--" + name) <= 2) best = "--" + name;
  return best.empty() ? "" : "did you mean " + best + "? ";
}

int report_usage(const std::vector<Command>& commands, const CLI::ParseError& e,
                 const std::string& first) {
  const std::string what = e.what();
  for (const Command& c : commands)
    if (c.parser->get_name() == first)
      return report_failure({core::ErrorCode::bad_input, what,
                             likely_option(*c.parser, what) + "see keyline " + first + " --help",
                             ""});
  const bool none = dynamic_cast<const CLI::RequiredError*>(&e) != nullptr;
  return report_failure(
      {core::ErrorCode::bad_input, none ? "a command is missing" : what, "see keyline --help", ""});
}

int run(int argc, char** argv) {
  CLI::App app{"Keyline: aesthetic curves. Measured points in, a faired key-line out."};
  app.set_version_flag("--version", "keyline " KEYLINE_VERSION);
  app.require_subcommand(1);
  app.footer(tools_help() +
             "keyline completion bash prints completion for the shell. keyline COMMAND --help "
             "tells more. Exit status: 0 done, 1 no such answer, 2 bad "
             "input, 3 file trouble, 130 cancelled.");
  const std::vector<Command> commands = add_commands(app);

  if (argc > 2 && is_operation_command(std::string(argv[1]) + "." + argv[2]))
    return run_operation_command(std::string(argv[1]) + "." + argv[2], {argv + 3, argv + argc});
  const int named = argc > 2 && argv[1] == std::string_view("perform") ? 2 : 1;
  if (argc > 1 && (named == 2 || !has_command(commands, argv[1])) &&
      is_operation_command(argv[named]))
    return run_operation_command(argv[named], {argv + named + 1, argv + argc});
  if (argc == 3 && argv[1] == std::string_view("completion") &&
      argv[2] == std::string_view("bash")) {
    std::vector<std::string> names;
    for (const Command& c : commands) names.push_back(c.parser->get_name());
    std::fputs(bash_completion(names).c_str(), stdout);
    return kDone;
  }
  if (argc > 1 && argv[1][0] != '-' && !has_command(commands, argv[1]))
    return report_failure({core::ErrorCode::bad_input,
                           std::string("there is no command \"") + argv[1] + "\"",
                           "keyline --help lists them", ""});
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& e) {
    return app.exit(e);
  } catch (const CLI::CallForVersion& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return report_usage(commands, e, argc > 1 ? argv[1] : "");
  }
  std::string typed = "keyline";
  for (int i = 1; i < argc; ++i) typed += " " + as_typed(argv[i]);
  const auto chosen =
      std::ranges::find_if(commands, [](const Command& c) { return c.parser->parsed(); });
  return chosen->run(typed);
}

}  // namespace
}  // namespace keyline::app

int main(int argc, char** argv) {
  try {
    return keyline::app::once_printed(keyline::app::run(argc, argv));
  } catch (const std::bad_alloc&) {
    return keyline::app::report_failure(
        {keyline::core::ErrorCode::internal, "out of memory", "give a smaller input", ""});
  } catch (const std::exception& e) {
    if (std::ferror(stdout) != 0) return keyline::app::once_printed(keyline::app::kDone);
    return keyline::app::report_failure(
        {keyline::core::ErrorCode::internal, e.what(), "please report this", ""});
  }
}

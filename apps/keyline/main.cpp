#include <algorithm>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>

#include "command_line.h"
#include "terminal.h"

namespace keyline::app {
namespace {

bool has_command(const std::vector<Command>& commands, const std::string& name) {
  return std::ranges::any_of(commands,
                             [&](const Command& c) { return c.parser->get_name() == name; });
}

int run(int argc, char** argv) {
  CLI::App app{"Keyline: aesthetic curves. Measured points in, a faired key-line out."};
  app.set_version_flag("--version", "keyline " KEYLINE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "keyline COMMAND --help tells more. Exit status: 0 done, 1 no such answer, 2 bad "
      "input, 3 file trouble, 130 cancelled.");
  const std::vector<Command> commands = add_commands(app);

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
    return report_failure({core::ErrorCode::bad_input, e.what(), "see keyline --help", ""});
  }
  std::string typed = "keyline";
  for (int i = 1; i < argc; ++i) typed += std::string(" ") + argv[i];
  const auto chosen =
      std::ranges::find_if(commands, [](const Command& c) { return c.parser->parsed(); });
  return chosen->run(typed);
}

}  // namespace
}  // namespace keyline::app

int main(int argc, char** argv) {
  try {
    return keyline::app::run(argc, argv);
  } catch (const std::bad_alloc&) {
    return keyline::app::report_failure(
        {keyline::core::ErrorCode::internal, "out of memory", "give a smaller input", ""});
  } catch (const std::exception& e) {
    return keyline::app::report_failure(
        {keyline::core::ErrorCode::internal, e.what(), "please report this", ""});
  }
}

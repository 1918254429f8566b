#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <system_error>

#include <fmt/format.h>

#include "keyline/core/version.h"
#include "keyline/operations/perform.h"

#include "commands.h"
#include "manual.h"
#include "terminal.h"

namespace keyline::app {
namespace {

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

std::string help() {
  std::string text =
      "Keyline: aesthetic curves. Measured points in, a faired key-line out.\n\n"
      "keyline COMMAND [FILE...] [options]\n\nCommands:\n";
  for (const Command& command : commands())
    text += fmt::format("  {:<12} {}\n", command.name, command.text);
  text += "\nOn curves of files:\n";
  for (const Tool& tool : tools())
    text += fmt::format("  {:<12} {}\n", tool.name,
                        operations::find_operation(tool.operation)->summary);
  return text +
         "\nEvery operation is a command too (keyline perform NAME, or its name alone):\n"
         "  keyline lac.segment --points 0,0 2,0 3,1.5 --alpha -1\n"
         "  keyline library find --rhythm accelerating --slope -1±0.2\n\n"
         "keyline COMMAND --help tells more, keyline man COMMAND as a page for man (--all FOLDER: "
         "all\nof them); keyline completion bash, zsh or fish prints completion for the "
         "shell.\nExit status: 0 done, 1 no such answer, 2 bad input, 3 file trouble, 130 "
         "cancelled.\n";
}

/// Prints what was made, or says why not.
int print(const core::Result<std::string>& text) {
  if (!text) return report_failure(text.error());
  fmt::print("{}", *text);
  return kDone;
}

/// keyline man [COMMAND], keyline man --all FOLDER
int run_man(const Words& words) {
  if (words.size() == 2 && words.front() == "--all") {
    const auto written = write_manual_pages(words.back());
    return written ? kDone : report_failure(written.error());
  }
  if (words.size() > 1)
    return report_failure({core::ErrorCode::bad_input, "one command at a time",
                           "keyline man COMMAND, or keyline man --all FOLDER", words[1]});
  return print(manual_page(words.empty() ? "" : words.front()));
}

/// The operations of a room, "library" say, a line each; empty where there is no such room.
std::string help_of_room(const std::string& room) {
  std::string text;
  for (const operations::Operation& operation : operations::operations())
    if (operation.name.starts_with(room + "."))
      text += fmt::format("  {:<22} {}\n", operation.name, operation.summary);
  return text;
}

/// "lac.segment", "perform lac.segment" and "lac segment" alike.
int run_named(const std::string& first, Words words) {
  std::string name = first;
  if (name == "perform" && !words.empty()) {
    name = words.front();
    words.erase(words.begin());
  } else if (!words.empty() && operations::find_operation(first + "." + words.front())) {
    name += "." + words.front();
    words.erase(words.begin());
  }
  if (operations::find_operation(name)) return run_plain(name, words);
  const std::string room = help_of_room(name);
  const bool option_next = !words.empty() && words.front().starts_with('-');
  if (!room.empty() && option_next && (words.front() == "--help" || words.front() == "-h")) {
    fmt::print("{}\nkeyline OPERATION --help tells more.\n", room);
    return kDone;
  }
  const std::string lists = room.empty() ? "keyline --help" : "keyline " + name + " --help";
  const std::string asked =
      room.empty() || option_next || words.empty() ? name : name + " " + words.front();
  return report_failure({core::ErrorCode::bad_input, "there is no command \"" + asked + "\"",
                         lists + " lists them", ""});
}

int run(const Words& all) {
  if (all.empty())
    return report_failure(
        {core::ErrorCode::bad_input, "a command is missing", "see keyline --help", ""});
  const std::string& first = all.front();
  const Words words(all.begin() + 1, all.end());
  if (first == "--help" || first == "-h" || first == "help") {
    fmt::print("{}", help());
    return kDone;
  }
  if (first == "--version") {
    fmt::print("keyline {}\n", core::version());
    return kDone;
  }
  if (first == "completion") return print(completion(words.size() == 1 ? words.front() : ""));
  if (first == "man") return run_man(words);
  for (const Command& command : commands())
    if (first == command.name) return command.run(words);
  for (const Tool& tool : tools())
    if (first == tool.name) return run_tool(tool, words);
  return run_named(first, words);
}

}  // namespace
}  // namespace keyline::app

int main(int argc, char** argv) {
  try {
    return keyline::app::once_printed(keyline::app::run({argv + 1, argv + argc}));
  } catch (const std::bad_alloc&) {
    return keyline::app::report_failure(
        {keyline::core::ErrorCode::internal, "out of memory", "give a smaller input", ""});
  } catch (const std::exception& e) {
    if (std::ferror(stdout) != 0) return keyline::app::once_printed(keyline::app::kDone);
    return keyline::app::report_failure(
        {keyline::core::ErrorCode::internal, e.what(), "please report this", ""});
  }
}

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "keyline/core/nearest_word.h"
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

bool asks_for_help(const Words& words) {
  return !words.empty() && (words.front() == "--help" || words.front() == "-h");
}

constexpr const char* kManHelp =
    "Manual pages, from the commands' own declarations.\n\n"
    "keyline man            the page about keyline, for man -l -\n"
    "keyline man COMMAND    that of a command: keyline man fair | man -l -\n"
    "keyline man --all FOLDER\n"
    "                       writes all pages into the folder\n";

constexpr const char* kCompletionHelp =
    "Completion of commands, options and their choices for a shell.\n\n"
    "bash    source <(keyline completion bash)\n"
    "zsh     source <(keyline completion zsh)\n"
    "fish    keyline completion fish | source\n";

/// keyline completion SHELL
int run_completion(const Words& words) {
  if (asks_for_help(words)) return print(std::string(kCompletionHelp));
  return print(completion(words.size() == 1 ? words.front() : ""));
}

/// keyline man [COMMAND], keyline man ROOM OPERATION, keyline man --all FOLDER
int run_man(const Words& words) {
  if (asks_for_help(words)) return print(std::string(kManHelp));
  if (words.size() == 2 && words.front() == "--all") {
    const auto written = write_manual_pages(words.back());
    return written ? kDone : report_failure(written.error());
  }
  if (words.size() == 2 && operations::find_operation(words[0] + "." + words[1]))
    return print(manual_page(words[0] + "." + words[1]));
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

/// The command or room that was probably meant: "; did you mean …?" or nothing.
std::string guess(const std::string& given) {
  const std::vector<std::string> names = first_words(manuals());
  const std::vector<std::string_view> words(names.begin(), names.end());
  const std::string_view meant = core::nearest_word(given, words);
  return meant.empty() ? "" : fmt::format("did you mean {}? ", meant);
}

std::string lists_them(const std::string& command) {
  return "keyline " + (command.empty() ? "" : command + " ") + "--help lists them";
}

int without_such(const std::string& name) {
  return report_failure({core::ErrorCode::bad_input, "there is no command \"" + name + "\"",
                         guess(name) + lists_them(""), ""});
}

/// "library", the room, and words behind it that are no operation of it.
int run_room(const std::string& room, const std::string& help, const Words& words) {
  if (asks_for_help(words)) {
    fmt::print("{}\nkeyline OPERATION --help tells more.\n", help);
    return kDone;
  }
  if (words.empty() || words.front().starts_with('-'))
    return report_failure(
        {core::ErrorCode::bad_input, "a command is missing behind it", lists_them(room), room});
  return report_failure({core::ErrorCode::bad_input,
                         "there is no command \"" + room + " " + words.front() + "\"",
                         lists_them(room), ""});
}

/// "lac.segment", "perform lac.segment" and "lac segment" alike.
int run_named(const std::string& first, Words words) {
  std::string name = first;
  if (name == "perform") {
    if (words.empty())
      return report_failure({core::ErrorCode::bad_input, "an operation is missing behind it",
                             "keyline operations lists them", name});
    name = words.front();
    words.erase(words.begin());
  } else if (!words.empty() && operations::find_operation(first + "." + words.front())) {
    name += "." + words.front();
    words.erase(words.begin());
  }
  if (operations::find_operation(name)) return run_plain(name, words);
  if (const std::string help = help_of_room(name); !help.empty())
    return run_room(name, help, words);
  return without_such(name);
}

int run(const Words& all) {
  if (all.empty())
    return report_failure(
        {core::ErrorCode::bad_input, "a command is missing", "see keyline --help", ""});
  const std::string& first = all.front();
  const Words words(all.begin() + 1, all.end());
  if (first == "help" && !words.empty() && !words.front().starts_with('-')) {
    Words asked = words;
    asked.emplace_back("--help");
    return run(asked);
  }
  if (first == "--help" || first == "-h" || first == "help") {
    fmt::print("{}", help());
    return kDone;
  }
  if (first == "--version") {
    fmt::print("keyline {}\n", core::version());
    return kDone;
  }
  if (first == "completion") return run_completion(words);
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

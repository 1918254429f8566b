#include "manual.h"

#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "keyline/core/version.h"
#include "keyline/operations/perform.h"

#include "commands.h"

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;

/// Text as roff reads it: no line is taken for a request, hyphens stay as typed.
std::string roff(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (all.empty() || all.back() == '\n')
      if (c == '.' || c == '\'') all += "\\&";
    if (c == '\\')
      all += "\\e";
    else if (c == '-')
      all += "\\-";
    else
      all += c;
  }
  return all;
}

std::string heading(const std::string& name, const std::string& text) {
  std::string upper = name;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return fmt::format(
      ".TH {} 1 \"\" \"Keyline {}\" \"Keyline\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n", roff(upper),
      core::version(), roff(name), roff(text.substr(0, text.find('\n'))));
}

constexpr const char* kStatus =
    ".SH EXIT STATUS\n0 done; 1 understood, but there is no such answer; 2 bad usage or bad input; "
    "3 a file could not be read or written; 130 cancelled.\n";

std::string page_of(const Manual& manual) {
  std::string page = heading("keyline-" + manual.command, manual.text);
  page += fmt::format("\\fBkeyline {}\\fR {}[options]\n.SH DESCRIPTION\n{}\n", roff(manual.command),
                      roff(manual.words), roff(manual.text));
  for (const OptionTexts& group : manual.groups) {
    page += fmt::format(".SH \"{}\"\n", roff(group.title));
    for (const OptionText& option : group.options)
      page += fmt::format(".TP\n\\fB{}\\fR {}\n{}\n", roff(shown_name(option)), roff(option.value),
                          roff(option.text));
  }
  if (!manual.more.empty()) page += ".SH MORE\n" + roff(manual.more) + "\n";
  return page + kStatus + ".SH SEE ALSO\n\\fBkeyline\\fR(1)\n";
}

std::string main_page() {
  std::string page = heading("keyline", "aesthetic curves: measured points in, a key-line out");
  page += "\\fBkeyline\\fR COMMAND [FILE...] [options]\n.SH COMMANDS\n";
  for (const Manual& manual : manuals())
    page +=
        fmt::format(".TP\n\\fBkeyline\\-{}\\fR(1)\n{}\n", roff(manual.command), roff(manual.text));
  return page + kStatus;
}

}  // namespace

std::vector<std::string> option_names(const Manual& manual) {
  std::vector<std::string> names;
  for (const OptionTexts& group : manual.groups)
    for (const OptionText& option : group.options) names.push_back(option.name);
  return names;
}

std::vector<Manual> manuals() {
  std::vector<Manual> all;
  for (const Command& command : commands()) all.push_back(command.manual());
  for (const Tool& tool : tools()) all.push_back(tool_manual(tool));
  for (const auto& operation : operations::operations())
    if (operation.name.find('.') != std::string::npos)  // `fair` is a command of that name
      all.push_back(plain_manual(operation.name));
  return all;
}

Result<std::string> manual_page(const std::string& command) {
  if (command.empty()) return main_page();
  for (const Manual& manual : manuals())
    if (manual.command == command) return page_of(manual);
  return fail(ErrorCode::bad_input, "there is no command \"" + command + "\"",
              "keyline --help lists them");
}

Result<void> write_manual_pages(const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  const auto write = [&](const std::string& name, const std::string& page) -> Result<void> {
    const std::string file = folder + "/" + name + ".1";
    std::ofstream out(file);
    out << page << std::flush;
    if (out) return {};
    return fail(ErrorCode::io, "the page cannot be written", "name a folder to write to", file);
  };
  if (auto done = write("keyline", main_page()); !done) return done;
  for (const Manual& manual : manuals())
    if (auto done = write("keyline-" + manual.command, page_of(manual)); !done) return done;
  return {};
}

}  // namespace keyline::app

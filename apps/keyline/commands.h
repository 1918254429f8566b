#pragma once

#include <span>
#include <string>
#include <vector>

#include "manual.h"

/// The commands: each reads its words by the declarations of the operations it performs.
namespace keyline::app {

/// Words after a command's name.
using Words = std::vector<std::string>;

struct Command {
  const char* name;
  const char* text;
  int (*run)(const Words& words);  ///< returns the exit status
  Manual (*manual)();
};

/// All commands, in the order of the help.
std::span<const Command> commands();

int run_fair(const Words& words);
int run_analyze(const Words& words);
int run_edit(const Words& words);
int run_draw(const Words& words);
int run_sketch(const Words& words);
int run_convert(const Words& words);
int run_list(const Words& words);
int run_batch(const Words& words);
/// Becomes the program keyline-studio, which stands beside this one.
int run_studio(const Words& words);
int run_operations(const Words& words);

Manual fair_manual();
Manual analyze_manual();
Manual edit_manual();
Manual draw_manual();
Manual sketch_manual();
Manual convert_manual();
Manual list_manual();
Manual batch_manual();
Manual studio_manual();
Manual operations_manual();

/// A command on curves of files: its operation takes them as "curve", one by one, as "curves", or
/// those of a first file as "along_u" and of a second as "along_v".
struct Tool {
  const char* name;
  const char* operation;
  const char* words = "FILE... ";
  const char* more = "";  ///< example
};
std::span<const Tool> tools();
int run_tool(const Tool& tool, const Words& words);
Manual tool_manual(const Tool& tool);

/// An operation by its own name: every field an option.
int run_plain(const std::string& operation, const Words& words);
Manual plain_manual(const std::string& operation);

}  // namespace keyline::app

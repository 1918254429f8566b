#pragma once

#include <span>
#include <string>
#include <vector>

/// The commands: each reads its words by the declarations of the operations it performs.
namespace keyline::app {

/// Words after a command's name.
using Words = std::vector<std::string>;

struct Command {
  const char* name;
  const char* text;
  int (*run)(const Words& words);  ///< returns the exit status
  std::vector<std::string> (*options)();
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

std::vector<std::string> fair_options();
std::vector<std::string> analyze_options();
std::vector<std::string> edit_options();
std::vector<std::string> draw_options();
std::vector<std::string> sketch_options();
std::vector<std::string> convert_options();
std::vector<std::string> list_options();
std::vector<std::string> batch_options();
std::vector<std::string> studio_options();
std::vector<std::string> operations_options();

/// A command on curves of files: its operation takes them as "curve", one by one, or as "curves".
struct Tool {
  const char* name;
  const char* operation;
};
std::span<const Tool> tools();
int run_tool(const Tool& tool, const Words& words);
std::vector<std::string> tool_options(const Tool& tool);

/// An operation by its own name: every field an option.
int run_plain(const std::string& operation, const Words& words);
std::vector<std::string> plain_options(const std::string& operation);

}  // namespace keyline::app

#pragma once

#include <string>
#include <vector>

/// Commands made from operations: every operation by its own name, and the tools for curves of a
/// file (offset, join, …).
namespace keyline::app {

/// Whether `name` is an operation or a tool.
bool is_operation_command(const std::string& name);

/// Runs it: `arguments` are the words after the name.
int run_operation_command(const std::string& name, const std::vector<std::string>& arguments);

/// The tools with a sentence each, for the help.
std::string tools_help();

/// Completion for bash: every command and its options.
std::string bash_completion(const std::vector<std::string>& other_commands);

}  // namespace keyline::app

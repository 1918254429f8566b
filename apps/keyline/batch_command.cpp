#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/operations/operation.h"

#include "commands.h"
#include "terminal.h"

namespace keyline::app {
namespace {

constexpr std::size_t kLongestLine = 256u << 20;

/// Reads one line of bounded length; what is beyond the bound is dropped and `cut` set.
bool read_line(std::istream& in, std::string& line, bool& cut) {
  line.clear();
  cut = false;
  bool any = false;
  for (int c = in.get(); c != EOF; c = in.get()) {
    any = true;
    if (c == '\n') return true;
    if (line.size() < kLongestLine)
      line.push_back(static_cast<char>(c));
    else
      cut = true;
  }
  return any;
}

bool is_blank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

}  // namespace

int run_batch(const CommonOptions& common) {
  std::ios::sync_with_stdio(false);
  operations::Context context;
  context.threads = common.threads;
  context.progress = interactive_progress(true);
  std::string line;
  bool cut = false;
  while (read_line(std::cin, line, cut)) {
    if (is_blank(line)) continue;
    if (cut) line = "the line is longer than 256 MB";
    std::cout << operations::answer_line(line, context) << '\n' << std::flush;
    if (context.progress.stop_requested()) return kCancelled;
    if (!std::cout)
      return report_failure({core::ErrorCode::io, "standard output cannot be written", "", ""});
  }
  return kDone;
}

int run_operations(const OperationsCommand& command) {
  if (command.name.empty()) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& operation : operations::operations()) {
      if (command.common.json)
        list.push_back({{"name", operation.name}, {"summary", operation.summary}});
      else
        fmt::print("{:<18} {}\n", operation.name, operation.summary);
    }
    if (command.common.json) fmt::print("{}\n", list.dump());
    return kDone;
  }
  const operations::Operation* operation = operations::find_operation(command.name);
  if (!operation)
    return report_failure({core::ErrorCode::bad_input,
                           "there is no operation \"" + command.name + "\"",
                           "keyline operations lists them", ""});
  fmt::print("{}\n", operations::request_schema(*operation).dump(2));
  return kDone;
}

}  // namespace keyline::app

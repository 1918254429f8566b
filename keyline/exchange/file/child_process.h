#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/progress.h"

namespace keyline::exchange {

struct ChildLimits {
  double seconds = 60;                        ///< of wall clock
  std::size_t memory = std::size_t{2} << 30;  ///< bytes of address space
  std::size_t output = std::size_t{4} << 30;  ///< bytes on standard output
};

struct ChildResult {
  int status = 0;  ///< exit status; -1 where a signal ended it
  int signal = 0;  ///< that signal, or 0
  bool out_of_time = false;
  bool cancelled = false;  ///< killed because the caller asked for it
  std::string output;      ///< standard output
  std::string errors;      ///< standard error, its first 64 kB
};

/// Runs a program to its end, `input` on its standard input. It gets no other open file than the
/// three standard ones, and is killed where it passes a limit, within a tenth of a second of
/// `cancellation`, and (on Linux) with the thread that waits for it. Ctrl-C, which a terminal sends
/// to it too, is left to the caller. Safe in programs with threads: between fork and exec only
/// async-signal-safe functions run.
/// Fails: io where no process can be started.
core::Result<ChildResult> run_child(const std::filesystem::path& program,
                                    const std::vector<std::string>& arguments,
                                    std::string_view input, const ChildLimits& limits,
                                    const core::CancellationToken& cancellation = {});

}  // namespace keyline::exchange

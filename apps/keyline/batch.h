#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "keyline/core/error.h"
#include "keyline/core/progress.h"

#include "workers.h"

/// Lines in, answers out in the same order, by several processes (docs/design/batch.md).
namespace keyline::app {

struct BatchOptions {
  int workers = 1;
  double time_limit = 0;    ///< seconds a line may take; 0: as long as it likes
  std::uint64_t skip = 0;   ///< answers there are already: of the first lines
  core::Progress progress;  ///< its token ends the batch
};

struct BatchReport {
  std::uint64_t lines = 0;    ///< answered
  std::uint64_t crashed = 0;  ///< lines that brought their worker down
  std::uint64_t expired = 0;  ///< lines over the time limit
  double seconds = 0;
  bool cancelled = false;
};

/// What is answered in place of a worker.
struct BatchAnswers {
  std::string (*too_long)();
  std::string (*crashed)(const std::string& line);
  std::string (*expired)(const std::string& line, double seconds);
};

/// Reads lines from `in` (blank ones get no answer) and writes one answer for each to `out`, in
/// their order, as soon as all before it are there. Memory is bounded: reading waits while 64 MB of
/// lines and answers are held. A line that brings its worker down gets `crashed`, its neighbours
/// are asked again.
/// Fails: io where `out` cannot be written.
core::Result<BatchReport> run_lines(int in, int out, const WorkerMain& main,
                                    const BatchAnswers& answers, const BatchOptions& options);

}  // namespace keyline::app

#pragma once

#include <string>

#include "keyline/core/error.h"
#include "keyline/core/progress.h"

/// What the command line says to a person: one line per failure, a bar on a terminal, Ctrl-C.
namespace keyline::app {

/// Exit statuses of the public interface.
inline constexpr int kDone = 0;
inline constexpr int kNoAnswer = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kIo = 3;
inline constexpr int kCancelled = 130;

int exit_of(core::ErrorCode code);

/// Prints "keyline: PATH: MESSAGE; HINT" on standard error and returns the exit status.
/// `subject` (a file name, say) stands before the failure's own path; either may be empty.
int report_failure(const core::Failure& failure, const std::string& subject = {});

/// A message on standard error unless quiet.
void say(bool quiet, const std::string& text);

/// Progress that draws a bar on standard error where that is a terminal (and not quiet), and a
/// token that Ctrl-C cancels; a second Ctrl-C ends the program at once.
core::Progress interactive_progress(bool quiet);

/// Clears the bar.
void end_progress();

}  // namespace keyline::app

#pragma once

#include <cstddef>
#include <string>
#include <vector>

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

/// Each line after `lead`; of more than ten the first, and how many more: `rest` says of what.
void say_some(bool quiet, const std::string& lead, const std::vector<std::string>& lines,
              const std::string& rest);

/// Progress that draws a bar on standard error where that is a terminal (and not quiet), and a
/// token that Ctrl-C cancels; a second Ctrl-C ends the program at once.
core::Progress interactive_progress(bool quiet);

/// Of work on `count` things, that on the one of that index: its bar is a part of the whole one and
/// tells "3 of 59".
core::Progress one_of_many(const core::Progress& whole, std::size_t index, std::size_t count);

/// "cancelled, 3 of 59 done" for a failure that is a cancellation; else as it is.
core::Failure told_how_far(core::Failure failure, std::size_t done, std::size_t wanted);

/// Clears the bar.
void end_progress();

/// Leaves standard output to a file written there ("-"): what is printed from now on goes to
/// standard error.
void leave_standard_output();

}  // namespace keyline::app

#pragma once

#include <cstddef>
#include <functional>

#include "keyline/core/progress.h"

/// Work on many things at a time.
namespace keyline::operations {

/// Calls work(i, progress) once for each i below count, on up to `threads` threads (0: all of the
/// machine's), begun in this order. Where one returns false, or the whole is cancelled, no more are
/// begun; those at work come to their end. So whatever i the work was not begun for, it was begun
/// for every i before.
///
/// progress: of the one thing; its reports become a bar of the whole that tells "3 of 59": the
/// third is at work, two have ended.
void work_on_all(const core::Progress& whole, std::size_t count, int threads,
                 const std::function<bool(std::size_t, const core::Progress&)>& work);

}  // namespace keyline::operations

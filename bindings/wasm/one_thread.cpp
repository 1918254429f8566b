// Loops of numeric/parallel.h in a page, which has one thread.
#include "keyline/numeric/parallel.h"

namespace keyline::numeric {

int thread_count(int) { return 1; }

namespace detail {

void run_parallel(std::size_t count, int, const std::function<void(std::size_t, int)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i, 0);
}

}  // namespace detail
}  // namespace keyline::numeric

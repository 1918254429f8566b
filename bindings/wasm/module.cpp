// What the page's worker calls (web/src/worker.ts): requests and answers as text, as a line of
// `keyline batch` has them.
#include <string>

#include <emscripten.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"
#include "keyline/operations/references.h"

namespace {

EM_JS(void, tell_progress, (double fraction, const char* doing), {
  if (Module["onProgress"]) Module["onProgress"](fraction, UTF8ToString(doing));
});

/// Emscripten begins with a mask under which nobody may read a new file.
[[maybe_unused]] const mode_t first_mask = ::umask(022);

/// Kept until the next call: who calls copies it.
const char* kept(std::string text) {
  static std::string last;
  last = std::move(text);
  return last.c_str();
}

}  // namespace

extern "C" {

/// The answer to {"op": …, …}.
EMSCRIPTEN_KEEPALIVE const char* keyline_answer(const char* request) {
  keyline::core::Progress progress;
  progress.sink = [](double fraction, std::string_view doing) {
    tell_progress(fraction, std::string(doing).c_str());
  };
  return kept(keyline::operations::answer_line(request, {1, progress}));
}

/// The names of what can be asked for, a JSON array.
EMSCRIPTEN_KEEPALIVE const char* keyline_operations() {
  nlohmann::json names = nlohmann::json::array();
  for (const auto& operation : keyline::operations::operations()) names.push_back(operation.name);
  return kept(names.dump());
}
}

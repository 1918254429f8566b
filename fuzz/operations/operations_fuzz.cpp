// Lines of `keyline batch`: any line gives an answer of the public form, soon after it was asked
// to stop if not before.
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"

namespace {

using keyline::core::CancellationToken;

/// Long lines ask for long work, which is no finding.
constexpr std::size_t kLongestLine = 4096;

/// Asks for a stop half a second after it was made, unless it is gone by then.
class Watch {
 public:
  explicit Watch(const CancellationToken& token)
      : thread_([token](const std::stop_token& stop) {
          std::mutex mutex;
          std::condition_variable_any ending;
          std::unique_lock lock(mutex);
          ending.wait_for(lock, stop, std::chrono::milliseconds(500), [] { return false; });
          token.request_stop();
        }) {}

 private:
  std::jthread thread_;
};

bool has_form(const nlohmann::json& answer) {
  if (!answer.is_object() || !answer.contains("id") || !answer.contains("ok")) return false;
  if (answer["ok"] == true) return answer.contains("result");
  const auto& error = answer["error"];
  return error.is_object() && error["code"] != "internal" &&
         !error["message"].get<std::string>().empty();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string line(reinterpret_cast<const char*>(data), size);
  // A request may name a file, and a fuzzer must not open whatever it comes to write there.
  if (size > kLongestLine || line.find("file") != std::string::npos) return 0;
  keyline::operations::Context context;
  context.threads = 1;
  context.progress.cancellation = CancellationToken::make();
  const Watch watch(context.progress.cancellation);
  const std::string answer = keyline::operations::answer_line(line, context);
  if (!has_form(nlohmann::json::parse(answer, nullptr, false))) std::abort();
  return 0;
}

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "keyline/core/progress.h"

/// What is asked of the studio and answered, without the library that carries it.
namespace keyline::studio {

/// A request's first lines; those headers that are looked at, empty where they were not sent.
struct RequestHead {
  std::string method = {};
  std::string path = {};   ///< of the target, before "?"
  std::string query = {};  ///< after it
  std::string host = {};
  std::string origin = {};
  std::string fetch_site = {};  ///< Sec-Fetch-Site
  std::string authorization = {};
  std::string protocols = {};  ///< Sec-WebSocket-Protocol
  std::string content_type = {};
  std::string accept = {};
  std::string job = {};  ///< Keyline-Job: a name to cancel the work by
};

struct Reply {
  int status = 200;
  std::string type = "application/json";
  std::string body = {};
  std::vector<std::pair<std::string, std::string>> headers = {};
};

/// Why a request is not served.
struct Refusal {
  int status = 400;
  std::string reason = {};
};

/// The way back to whoever asked. Any thread may use it; after reply() or end() nothing more is
/// sent. An object that goes without either closes the connection.
class Responder {
 public:
  virtual ~Responder() = default;
  virtual void reply(Reply reply) = 0;
  /// A stream of Server-Sent Events in place of one reply; `data` is one line.
  virtual void event(std::string name, std::string data) = 0;
  virtual void end() = 0;
  /// Stopped when the other side leaves.
  virtual core::CancellationToken gone() const = 0;
};

/// What the server asks of what it serves.
struct Service {
  /// Before a body is read; empty reason: served.
  std::function<Refusal(const RequestHead&)> refuse;
  std::function<void(const RequestHead&, std::string body, std::shared_ptr<Responder>)> serve;
  /// A message of a socket; the answer may come from any thread.
  std::function<void(std::string message, std::function<void(std::string)> answer)> message;
  std::function<void(const std::string& line)> log;
};

}  // namespace keyline::studio

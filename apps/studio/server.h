#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

#include "keyline/core/error.h"

#include "http.h"

/// HTTP/1.1 and WebSocket on one port, by Boost.Beast (docs/design/studio.md says why).
namespace keyline::studio {

struct Limits {
  std::size_t head = 16 << 10;  ///< bytes of a request's first lines
  std::size_t body = 64 << 20;
  std::size_t message = 8 << 20;         ///< of a socket
  std::chrono::seconds head_time{20};    ///< from one request to the next one's last header
  std::chrono::seconds crowded_time{2};  ///< the same when three of four connections are taken
  std::chrono::seconds body_time{60};
  std::size_t connections = 512;
};

class Server {
 public:
  /// Listens at once. Fails: io, with the system's reason.
  static core::Result<std::unique_ptr<Server>> listen(const std::string& address,
                                                      unsigned short port, Service service,
                                                      Limits limits = {});
  virtual ~Server() = default;
  virtual unsigned short port() const = 0;
  /// Serves until stop(); once. Connections are served by the calling thread.
  virtual void run() = 0;
  /// Takes no more requests, sends what is being answered for at most two seconds. Any thread.
  virtual void stop() = 0;
};

}  // namespace keyline::studio

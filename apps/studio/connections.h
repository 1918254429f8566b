#pragma once

#include <cstddef>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include "server.h"

/// What the server's own parts share; nobody else includes it.
namespace keyline::studio {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

/// What all connections share; of the serving thread alone, which connections end on too.
struct Shared {
  Service service;
  Limits limits;
  std::size_t connections = 0;
  std::size_t owed = 0;  ///< answers that somebody waits for
  bool stopping = false;
  asio::io_context io{1};  // the last, so that it goes first, and all connections with it

  /// To be called where `stopping` or `owed` changes: without answers to give it need not wait.
  void stop_if_idle() {
    if (stopping && owed == 0) io.stop();
  }
  bool crowded() const { return 4 * connections > 3 * limits.connections; }
};

/// One of `connections` as long as it lives.
class Counted {
 public:
  explicit Counted(Shared& shared) : shared_(shared) { ++shared_.connections; }
  ~Counted() { --shared_.connections; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  Shared& shared_;
};

/// One of `owed` as long as it lives.
class Owed {
 public:
  explicit Owed(Shared& shared) : shared_(shared) { ++shared_.owed; }
  ~Owed() {
    --shared_.owed;
    shared_.stop_if_idle();
  }
  Owed(const Owed&) = delete;
  Owed& operator=(const Owed&) = delete;

 private:
  Shared& shared_;
};

/// A socket that stays open: one message is answered before the next is read.
void serve_socket(Shared& shared, beast::tcp_stream stream,
                  http::request<http::string_body> request);

}  // namespace keyline::studio

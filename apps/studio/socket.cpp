#include <optional>

#include <boost/asio/post.hpp>
#include <boost/beast/websocket.hpp>

#include "connections.h"

namespace keyline::studio {
namespace {

namespace websocket = beast::websocket;
using boost::system::error_code;

class SocketSession : public std::enable_shared_from_this<SocketSession> {
 public:
  SocketSession(Shared& shared, beast::tcp_stream stream)
      : shared_(shared), counted_(shared), socket_(std::move(stream)) {}

  void accept(http::request<http::string_body> request) {
    request_ = std::move(request);
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
      response.set(http::field::sec_websocket_protocol, "keyline.v1");
    }));
    socket_.read_message_max(shared_.limits.message);
    socket_.async_accept(request_, [self = shared_from_this()](error_code failed) {
      if (!failed) self->read();
    });
  }

 private:
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](error_code failed, std::size_t) {
      if (failed) return;
      self->owed_.emplace(self->shared_);
      std::string message = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      self->shared_.service.message(std::move(message), [self](std::string answer) {
        asio::post(self->shared_.io, [self, answer = std::move(answer)]() mutable {
          self->write(std::move(answer));
        });
      });
    });
  }

  /// One message is answered before the next is read: who drags sends the newest, not a queue.
  void write(std::string answer) {
    answer_ = std::move(answer);
    socket_.text(true);
    socket_.async_write(asio::buffer(answer_),
                        [self = shared_from_this()](error_code failed, std::size_t) {
                          self->owed_.reset();
                          if (!failed && !self->shared_.stopping) self->read();
                        });
  }

  Shared& shared_;
  Counted counted_;
  std::optional<Owed> owed_;
  websocket::stream<beast::tcp_stream> socket_;
  http::request<http::string_body> request_;  ///< that opened it
  beast::flat_buffer buffer_;
  std::string answer_;
};

}  // namespace

void serve_socket(Shared& shared, beast::tcp_stream stream,
                  http::request<http::string_body> request) {
  std::make_shared<SocketSession>(shared, std::move(stream))->accept(std::move(request));
}

}  // namespace keyline::studio

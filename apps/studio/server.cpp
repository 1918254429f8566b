#include "server.h"

#include <deque>
#include <optional>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "connections.h"

namespace keyline::studio {
namespace {

namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
using Parser = http::request_parser<http::string_body>;

constexpr auto kDrain = std::chrono::seconds(2);
constexpr auto kLastReplies = std::chrono::seconds(4);  // to works that were told to end

std::string text(beast::string_view v) { return {v.data(), v.size()}; }

RequestHead head_of(const http::request_header<>& request) {
  RequestHead head;
  head.method = text(request.method_string());
  const std::string target = text(request.target());
  const std::size_t mark = target.find('?');
  head.path = target.substr(0, mark);
  if (mark != std::string::npos) head.query = target.substr(mark + 1);
  head.host = request.count(http::field::host) == 1 ? text(request[http::field::host]) : "";
  head.origin = text(request[http::field::origin]);
  head.fetch_site = text(request["Sec-Fetch-Site"]);
  head.authorization = text(request[http::field::authorization]);
  head.protocols = text(request[http::field::sec_websocket_protocol]);
  head.content_type = text(request[http::field::content_type]);
  head.accept = text(request[http::field::accept]);
  head.job = text(request["Keyline-Job"]);
  return head;
}

// ---- requests and replies --------------------------------------------------------------------

class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(Shared& shared, tcp::socket socket)
      : shared_(shared), counted_(shared), stream_(std::move(socket)) {
    error_code ignored;
    stream_.socket().set_option(tcp::no_delay(true), ignored);
    const auto from = stream_.socket().remote_endpoint(ignored);
    from_ = ignored ? "?" : from.address().to_string();
  }

  void read_head() {
    if (shared_.stopping) return close();
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(shared_.limits.head));
    parser_->body_limit(shared_.limits.body);
    stream_.expires_after(shared_.crowded() ? shared_.limits.crowded_time
                                            : shared_.limits.head_time);
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](error_code failed, std::size_t) { self->on_head(failed); });
  }

  void reply(Reply reply) {
    auto response = std::make_shared<http::response<http::string_body>>(
        static_cast<http::status>(reply.status), 11);
    response->set(http::field::content_type, reply.type);
    for (const auto& [name, value] : reply.headers) response->set(name, value);
    response->body() = std::move(reply.body);
    response->keep_alive(keep_alive_ && !shared_.stopping);
    response->prepare_payload();
    answering_ = false;
    stream_.expires_after(shared_.limits.body_time);
    http::async_write(stream_, *response,
                      [self = shared_from_this(), response](error_code failed, std::size_t) {
                        self->owed_.reset();
                        if (failed) return self->close();
                        if (response->need_eof()) return self->leave();
                        self->read_head();
                      });
  }

  /// A part of a stream of events; empty: its end.
  void stream(std::string part) {
    if (!streaming_) {
      streaming_ = true;
      parts_.push_back(
          "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n"
          "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
          "Transfer-Encoding: chunked\r\n\r\n");
    }
    char size[24];
    std::snprintf(size, sizeof size, "%zx\r\n", part.size());
    const bool last = part.empty();
    parts_.push_back(size + std::move(part) + "\r\n");
    if (last) answering_ = false;
    if (!writing_) write_part();
  }

  /// Nobody will answer that request: the connection is of no more use.
  void abandon(unsigned asked) {
    if (answering_ && asked_ == asked) close();
  }
  unsigned asked() const { return asked_; }

  const core::CancellationToken& gone() const { return gone_; }
  Shared& shared() { return shared_; }

 private:
  void on_head(error_code failed) {
    if (failed == http::error::end_of_stream || failed == asio::error::eof) return close();
    if (failed == beast::error::timeout) return drop("no request within the time allowed");
    if (failed == http::error::body_limit) return refuse({413, "the body is larger than allowed"});
    if (failed) return refuse({400, "malformed request: " + failed.message()});
    head_ = head_of(parser_->get());
    keep_alive_ = parser_->get().keep_alive();
    if (const Refusal refusal = shared_.service.refuse(head_); !refusal.reason.empty())
      return refuse(refusal);
    if (websocket::is_upgrade(parser_->get())) return upgrade();
    stream_.expires_after(shared_.limits.body_time);
    if (beast::iequals(parser_->get()[http::field::expect], "100-continue")) return invite_body();
    read_body();
  }

  void invite_body() {
    static constexpr beast::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
    asio::async_write(stream_, asio::buffer(kContinue.data(), kContinue.size()),
                      [self = shared_from_this()](error_code failed, std::size_t) {
                        if (failed) return self->close();
                        self->read_body();
                      });
  }

  void read_body() {
    http::async_read(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](error_code failed, std::size_t) { self->on_body(failed); });
  }

  void on_body(error_code failed);

  void upgrade() {
    stream_.expires_never();
    serve_socket(shared_, std::move(stream_), parser_->release());
  }

  /// While work goes on, an end of the stream means that nobody waits for the answer.
  void watch() {
    stream_.socket().async_wait(tcp::socket::wait_read,
                                [self = shared_from_this(), asked = asked_](error_code failed) {
                                  if (failed || !self->answering_ || self->asked_ != asked) return;
                                  error_code unread;
                                  if (self->stream_.socket().available(unread) == 0)
                                    self->gone_.request_stop();
                                });
  }

  void write_part() {
    if (parts_.empty()) {
      writing_ = false;
      if (!answering_) {
        streaming_ = false;
        owed_.reset();
        read_head();
      }
      return;
    }
    writing_ = true;
    stream_.expires_after(shared_.limits.body_time);
    asio::async_write(stream_, asio::buffer(parts_.front()),
                      [self = shared_from_this()](error_code failed, std::size_t) {
                        self->parts_.pop_front();
                        if (!failed) return self->write_part();
                        self->gone_.request_stop();
                        self->close();
                      });
  }

  void refuse(const Refusal& refusal) {
    log(refusal.reason);
    keep_alive_ = false;
    Reply said{refusal.status, "text/plain; charset=utf-8", refusal.reason + "\n", {}};
    said.headers.emplace_back("X-Content-Type-Options", "nosniff");
    reply(std::move(said));
  }

  void drop(const std::string& reason) {
    if (buffer_.size() > 0) log(reason);  // an idle connection that ends is nothing to tell
    close();
  }

  /// What is still being sent is read and dropped for a moment: closing on it would take back the
  /// reply that says why.
  void leave() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(kDrain);
    drain();
  }

  void drain() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(1 << 16),
                            [self = shared_from_this()](error_code failed, std::size_t) {
                              if (failed) return self->close();
                              self->drain();
                            });
  }

  void log(const std::string& reason) const {
    shared_.service.log("refused " + from_ + " " + head_.method + " " + head_.path + ": " + reason);
  }

  void close() {
    owed_.reset();
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_both, ignored);
    stream_.close();
  }

  Shared& shared_;
  Counted counted_;
  std::optional<Owed> owed_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  RequestHead head_;
  std::string from_;
  bool keep_alive_ = false;
  bool answering_ = false;
  bool streaming_ = false;
  bool writing_ = false;
  unsigned asked_ = 0;
  core::CancellationToken gone_;
  std::deque<std::string> parts_;
};

/// Carries what other threads say to the thread that serves.
class Back : public Responder {
 public:
  explicit Back(std::shared_ptr<Session> session)
      : session_(std::move(session)), gone_(session_->gone()), asked_(session_->asked()) {}
  /// Hands the session over too: it is the serving thread's to end.
  ~Back() override {
    asio::io_context& io = session_->shared().io;
    asio::post(io, [session = std::move(session_), asked = asked_] { session->abandon(asked); });
  }
  Back(const Back&) = delete;
  Back& operator=(const Back&) = delete;

  void reply(Reply reply) override {
    on_session([reply = std::move(reply)](Session& s) mutable { s.reply(std::move(reply)); });
  }
  void event(std::string name, std::string data) override {
    std::string part = "event: " + name + "\ndata: " + std::move(data) + "\n\n";
    on_session([part = std::move(part)](Session& s) mutable { s.stream(std::move(part)); });
  }
  void end() override {
    on_session([](Session& s) { s.stream({}); });
  }
  core::CancellationToken gone() const override { return gone_; }

 private:
  template <class Work>
  void on_session(Work work) {
    asio::post(session_->shared().io,
               [session = session_, work = std::move(work)]() mutable { work(*session); });
  }

  std::shared_ptr<Session> session_;
  core::CancellationToken gone_;
  unsigned asked_;
};

void Session::on_body(error_code failed) {
  if (failed == http::error::body_limit) return refuse({413, "the body is larger than allowed"});
  if (failed == beast::error::timeout) return refuse({408, "the body did not come in time"});
  if (failed) return refuse({400, "malformed request: " + failed.message()});
  stream_.expires_never();
  gone_ = core::CancellationToken::make();
  answering_ = true;
  owed_.emplace(shared_);
  ++asked_;
  watch();
  shared_.service.serve(head_, std::move(parser_->get().body()),
                        std::make_shared<Back>(shared_from_this()));
}

// ---- the listening port ----------------------------------------------------------------------

class BeastServer : public Server {
 public:
  BeastServer(Service service, Limits limits) : acceptor_(shared_.io), last_(shared_.io) {
    shared_.service = std::move(service);
    shared_.limits = limits;
  }

  error_code open(const std::string& address, unsigned short port) {
    error_code failed;
    const auto ip = asio::ip::make_address(address, failed);
    if (failed) return failed;
    const tcp::endpoint at(ip, port);
    acceptor_.open(at.protocol(), failed);
    if (!failed) acceptor_.set_option(asio::socket_base::reuse_address(true), failed);
    if (!failed) acceptor_.bind(at, failed);
    if (!failed) acceptor_.listen(asio::socket_base::max_listen_connections, failed);
    return failed;
  }

  unsigned short port() const override { return acceptor_.local_endpoint().port(); }

  void run() override {
    accept();
    shared_.io.run();
    shared_.stopping = false;  // what ends with io is not to stop it
  }

  void stop() override {
    asio::post(shared_.io, [this] {
      shared_.stopping = true;
      acceptor_.close();
      shared_.stop_if_idle();
      last_.expires_after(kLastReplies);
      last_.async_wait([this](error_code) { shared_.io.stop(); });
    });
  }

 private:
  void accept() {
    acceptor_.async_accept([this](error_code failed, tcp::socket socket) {
      if (shared_.stopping) return;
      if (!failed && shared_.connections < shared_.limits.connections)
        std::make_shared<Session>(shared_, std::move(socket))->read_head();
      else if (!failed)
        shared_.service.log("refused a connection: " + std::to_string(shared_.connections) +
                            " are open");
      accept();
    });
  }

  Shared shared_;
  tcp::acceptor acceptor_;
  asio::steady_timer last_;
};

}  // namespace

core::Result<std::unique_ptr<Server>> Server::listen(const std::string& address,
                                                     unsigned short port, Service service,
                                                     Limits limits) {
  auto server = std::make_unique<BeastServer>(std::move(service), limits);
  if (const error_code failed = server->open(address, port))
    return core::fail(
        core::ErrorCode::io,
        address + " port " + std::to_string(port) + " cannot be listened on: " + failed.message(),
        "choose another --port, or 0 for any that is free");
  return server;
}

}  // namespace keyline::studio

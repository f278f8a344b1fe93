// SPDX-License-Identifier: Apache-2.0
#include "devices/haply_link.h"

#include <fmt/core.h>
#include <sys/socket.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <mutex>
#include <optional>

#include "core/check.h"
#include "core/farewell.h"

namespace afm::haptics {

namespace {

using boost::asio::ip::tcp;
using ErrorCode = boost::beast::error_code;
using Stream = boost::beast::websocket::stream<tcp::socket>;

constexpr std::size_t kLongestMessage = 65'536;
constexpr auto kHandshakePatience = std::chrono::seconds(2);
constexpr auto kSendPatience = std::chrono::milliseconds(20);
constexpr auto kLeavePatience = std::chrono::milliseconds(100);

}  // namespace

struct HaplyLink::Socket {
  boost::asio::io_context context;
  std::optional<Stream> stream;
  std::mutex changing;  // guard of `stream` and `interrupted` against interrupt()
  bool interrupted = false;

  boost::beast::flat_buffer incoming;
  bool reading = false;  // true: a read is pending, possibly across calls of receive()
  bool ended = true;

  // Runs pending operations until `done`. Returns false if that takes longer than `patience`.
  bool run_until(const bool& done, std::chrono::microseconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    context.restart();
    while (!done && context.run_one_until(end) > 0) {
    }
    return done;
  }

  // Starts an operation and waits until it ends; cuts the connection after `patience`.
  template <class Start>
  ErrorCode finish(Start&& start, std::chrono::microseconds patience) {
    bool done = false;
    ErrorCode error;
    start([&](const ErrorCode& result, auto&&...) {
      error = result;
      done = true;
    });
    if (run_until(done, patience)) return error;
    cut();
    return boost::asio::error::timed_out;
  }

  // Ends all pending operations.
  void cut() {
    ErrorCode ignored;
    {
      const std::lock_guard lock(changing);
      // a duplicate of the descriptor keeps the connection open, so close() alone may not end it
      if (stream) ignored = stream->next_layer().shutdown(tcp::socket::shutdown_both, ignored);
      if (stream) ignored = stream->next_layer().close(ignored);
    }
    context.restart();
    context.run();
  }

  void read_on() {
    if (reading || ended) return;
    reading = true;
    // in pieces: a peer that sends too much can still be sent zero force, which Beast's own limit would prevent
    stream->async_read_some(incoming, kLongestMessage + 1 - incoming.size(),
                            [this](const ErrorCode& error, std::size_t) {
                              reading = false;
                              ended = ended || error || incoming.size() > kLongestMessage;
                              if (!ended && !stream->is_message_done()) read_on();
                            });
  }
};

HaplyLink::HaplyLink() : socket_(std::make_unique<Socket>()) {}
HaplyLink::~HaplyLink() = default;

core::Result<void> HaplyLink::connect(std::uint16_t port) {
  const auto refused = [port](const ErrorCode& error) {
    return core::failure(
        core::ErrorCategory::DeviceMissing,
        fmt::format("no haply inverse service at port {} of this machine ({}): start it and plug the device in", port,
                    error.message()));
  };
  Socket& socket = *socket_;
  socket.cut();
  {
    const std::lock_guard lock(socket.changing);
    if (socket.interrupted) return refused(boost::asio::error::operation_aborted);
    ErrorCode ignored;
    socket.stream.emplace(socket.context);
    ignored = socket.stream->next_layer().open(tcp::v4(), ignored);
  }
  socket.incoming.clear();
  socket.ended = true;
  tcp::socket& tcp_socket = socket.stream->next_layer();
  // local machine only: a force must not depend on a network
  const tcp::endpoint service(boost::asio::ip::address_v4::loopback(), port);
  ErrorCode error =
      socket.finish([&](auto done) { tcp_socket.async_connect(service, std::move(done)); }, kHandshakePatience);
  if (error) return refused(error);
  error = tcp_socket.set_option(tcp::no_delay(true), error);
  socket.stream->read_message_max(0);  // no limit by the library, because read_on() has its own
  socket.stream->text(true);
  const std::string host = fmt::format("localhost:{}", port);
  error =
      socket.finish([&](auto done) { socket.stream->async_handshake(host, "/", std::move(done)); }, kHandshakePatience);
  if (error) return refused(error);
  socket.ended = false;
  return {};
}

std::optional<std::string> HaplyLink::receive(std::chrono::microseconds patience) {
  Socket& socket = *socket_;
  socket.read_on();
  const auto end = std::chrono::steady_clock::now() + patience;
  socket.context.restart();
  while (socket.reading && (socket.context.poll_one() > 0 || socket.context.run_one_until(end) > 0)) {
  }
  if (socket.reading || socket.ended) return std::nullopt;
  std::string message(static_cast<const char*>(socket.incoming.cdata().data()), socket.incoming.size());
  socket.incoming.clear();
  return message;
}

bool HaplyLink::ended() const { return socket_->ended; }

bool HaplyLink::send(const std::string& message) {
  Socket& socket = *socket_;
  if (!socket.stream || !socket.stream->is_open()) return false;
  const ErrorCode error = socket.finish(
      [&](auto done) { socket.stream->async_write(boost::asio::buffer(message), std::move(done)); }, kSendPatience);
  socket.ended = socket.ended || error;
  return !error;
}

void HaplyLink::leave() {
  if (const int open = descriptor(); open >= 0) core::take_leave(open, kLeavePatience);
  socket_->cut();
  socket_->ended = true;
}

int HaplyLink::descriptor() const {
  return socket_->stream && socket_->stream->next_layer().is_open() ? socket_->stream->next_layer().native_handle()
                                                                    : -1;
}

void HaplyLink::interrupt() {
  const std::lock_guard lock(socket_->changing);
  socket_->interrupted = true;
  // closing would free the number while the other thread still reads from it
  if (socket_->stream && socket_->stream->next_layer().is_open())
    ::shutdown(socket_->stream->next_layer().native_handle(), SHUT_RDWR);
}

std::string text_frame(std::string_view text) {
  AFM_CHECK(text.size() <= 0xFFFF);
  constexpr char kFinalText = '\x81';
  constexpr int kMasked = 0x80, kLongestShort = 125, kTwoByteLength = 126;
  std::string frame{kFinalText};
  if (text.size() <= kLongestShort) {
    frame += static_cast<char>(kMasked | static_cast<int>(text.size()));
  } else {
    frame += static_cast<char>(kMasked | kTwoByteLength);
    frame += static_cast<char>(text.size() >> 8U);
    frame += static_cast<char>(text.size() & 0xFFU);
  }
  frame.append(4, '\0');  // masking key of zeros
  frame += text;
  return frame;
}

}  // namespace afm::haptics

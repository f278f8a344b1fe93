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

namespace afm::haptics {

namespace {

using boost::asio::ip::tcp;
using ErrorCode = boost::beast::error_code;
using Stream = boost::beast::websocket::stream<tcp::socket>;

constexpr std::size_t kLongestMessage = 65'536;
constexpr auto kHandshakePatience = std::chrono::seconds(2);

}  // namespace

struct HaplyLink::Socket {
  boost::asio::io_context context;
  std::optional<Stream> stream;
  std::mutex changing;  // of `stream` and `interrupted`, against interrupt()
  bool interrupted = false;
};

HaplyLink::HaplyLink() : socket_(std::make_unique<Socket>()) {}
HaplyLink::~HaplyLink() = default;

core::Result<void> HaplyLink::connect(std::uint16_t port) {
  const auto refused = [port](const ErrorCode& error) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("no haply inverse service at port {} of this machine ({}): start it, and plug the "
                                     "device in",
                                     port, error.message()));
  };
  ErrorCode error;
  {
    const std::lock_guard lock(socket_->changing);
    if (socket_->interrupted) return refused(boost::asio::error::operation_aborted);
    socket_->stream.emplace(socket_->context);
    auto& tcp_socket = socket_->stream->next_layer();
    // this machine alone: a force must not depend on a network
    tcp_socket.connect({boost::asio::ip::address_v4::loopback(), port}, error);
    if (error) return refused(error);
    tcp_socket.set_option(tcp::no_delay(true), error);
  }
  socket_->stream->read_message_max(kLongestMessage);
  socket_->stream->text(true);

  error = boost::asio::error::timed_out;
  socket_->stream->async_handshake(fmt::format("localhost:{}", port), "/",
                                   [&](const ErrorCode& done) { error = done; });
  socket_->context.restart();
  socket_->context.run_for(kHandshakePatience);
  if (error) {
    ErrorCode ignored;
    socket_->stream->next_layer().shutdown(tcp::socket::shutdown_both, ignored);
    const ErrorCode reason = error;
    socket_->context.run();  // the handshake ends now, if it has not
    return refused(reason);
  }
  return {};
}

std::optional<std::string> HaplyLink::receive() {
  boost::beast::flat_buffer buffer;
  ErrorCode error;
  socket_->stream->read(buffer, error);
  if (error) return std::nullopt;
  return std::string(static_cast<const char*>(buffer.cdata().data()), buffer.size());
}

bool HaplyLink::send(const std::string& message) {
  ErrorCode error;
  socket_->stream->write(boost::asio::buffer(message), error);
  return !error;
}

void HaplyLink::interrupt() {
  const std::lock_guard lock(socket_->changing);
  socket_->interrupted = true;
  // closing would free the number while the other thread still reads from it
  if (socket_->stream) ::shutdown(socket_->stream->next_layer().native_handle(), SHUT_RDWR);
}

}  // namespace afm::haptics

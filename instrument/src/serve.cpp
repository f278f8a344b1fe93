// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/log.h"
#include "core/system_error.h"
#include "instrument/listener.h"

namespace afm::instrument {
namespace {

constexpr std::size_t kBytesAtOnce = 65536;

// Waits like poll(), but continues after signals.
int wait_for(std::span<pollfd> watched, int milliseconds) {
  int ready = 0;
  do {
    ready = ::poll(watched.data(), watched.size(), milliseconds);
  } while (ready < 0 && errno == EINTR);
  return ready;
}

// A connected client, or none. Holds no answer, so that a slow reader costs no memory.
class Client {
 public:
  Client() = default;
  explicit Client(core::FileDescriptor socket) : socket_(std::move(socket)) {}

  int descriptor() const noexcept { return socket_.get(); }
  bool is_here() const noexcept { return socket_.is_open(); }
  void leave() { *this = Client(); }

  // Reads what has come and answers every whole request. Afterwards the client may have left.
  Door::Then answer_all(Door& door) {
    read();
    door.look_with([this, &door] {
      if (!ended_ && buffer_.size() <= door.most_request_bytes()) read();
      return std::string_view(buffer_);
    });
    for (std::optional<std::size_t> size; (size = next_size(door));) {
      const std::string request = buffer_.substr(0, *size);
      buffer_.erase(0, *size);
      const auto then = door.answer(request, [this](std::string_view bytes) { return send(bytes); });
      if (then == Door::Then::Quit) return then;
      if (gone_) break;
    }
    const bool too_long = buffer_.size() > door.most_request_bytes() || door.announces_too_much(buffer_);
    if (too_long) send(door.too_long());
    if (ended_ || gone_ || too_long) leave();
    return Door::Then::GoOn;
  }

 private:
  std::optional<std::size_t> next_size(const Door& door) {
    const auto size = door.request_size(buffer_);
    if (size || !ended_ || buffer_.empty()) return size;
    buffer_ += door.omitted_end();
    return door.request_size(buffer_);
  }

  void read() {
    std::array<char, kBytesAtOnce> bytes;
    const ssize_t count = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
    if (count > 0) buffer_.append(bytes.data(), static_cast<std::size_t>(count));
    ended_ = count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
  }

  bool send(std::string_view bytes) {
    while (!bytes.empty() && !gone_) {
      const ssize_t count = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count >= 0) {
        bytes.remove_prefix(static_cast<std::size_t>(count));
      } else if (errno == EAGAIN) {
        std::array watched{pollfd{.fd = socket_.get(), .events = POLLOUT, .revents = 0}};
        if (wait_for(watched, kPatienceS * 1000) > 0) continue;
        core::log_line(fmt::format("a client has not read its answers for {} s; it is given up", kPatienceS));
        gone_ = true;
      } else if (errno != EINTR) {
        gone_ = true;
      }
    }
    return !gone_;
  }

  core::FileDescriptor socket_;
  std::string buffer_;
  bool ended_ = false;  // true: no more input can arrive
  bool gone_ = false;
};

}  // namespace

core::Result<void> serve(std::span<const OpenDoor> doors, bool once) {
  std::vector<Client> clients(doors.size());
  std::vector<pollfd> watched(doors.size());
  for (;;) {
    // while one client is served, the next waits in the kernel's queue
    for (std::size_t i = 0; i < doors.size(); ++i) {
      const int descriptor = clients[i].is_here() ? clients[i].descriptor() : doors[i].listener->descriptor();
      watched[i] = {.fd = descriptor, .events = POLLIN, .revents = 0};
    }
    if (wait_for(watched, -1) < 0) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("cannot wait for a client: {}", core::system_error(errno)));
    }
    for (std::size_t i = 0; i < doors.size(); ++i) {
      if (watched[i].revents == 0) continue;
      if (!clients[i].is_here()) {
        clients[i] = Client(doors[i].listener->accept());
        continue;
      }
      if (clients[i].answer_all(*doors[i].door) == Door::Then::Quit) return {};
      if (once && !clients[i].is_here()) return {};
    }
  }
}

}  // namespace afm::instrument

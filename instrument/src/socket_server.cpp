// SPDX-License-Identifier: Apache-2.0
#include "instrument/socket_server.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <string_view>
#include <utility>

#include "core/interruption.h"
#include "core/log.h"
#include "core/system_error.h"
#include "core/trusted_peer.h"

namespace afm::instrument {
namespace {

constexpr int kWaitingClients = 8;
constexpr std::size_t kBytesAtOnce = 65536;

core::Result<sockaddr_un> address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) {
    return core::wrong_usage(fmt::format("--socket {}: give a path of 1 to {} letters", path, sizeof(address.sun_path) - 1));
  }
  std::copy(path.begin(), path.end(), address.sun_path);
  return address;
}

const sockaddr* as_socket_address(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

// A socket that a program left behind when it was killed.
bool is_abandoned(const std::string& path, const sockaddr_un& address) {
  struct stat facts{};
  if (::lstat(path.c_str(), &facts) != 0 || !S_ISSOCK(facts.st_mode) || facts.st_uid != ::getuid()) return false;
  const core::FileDescriptor visitor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  return visitor.is_open() && ::connect(visitor.get(), as_socket_address(address), sizeof(address)) != 0 &&
         errno == ECONNREFUSED;
}

// Waits for the events, and returns whether one came. EINTR does not end the wait.
bool wait_for(int descriptor, short events, int milliseconds) {
  pollfd watched{.fd = descriptor, .events = events, .revents = 0};
  int ready = 0;
  do {
    ready = ::poll(&watched, 1, milliseconds);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

// One connected client. Holds one answer at a time, so that a slow reader costs no memory.
class Client {
 public:
  explicit Client(core::FileDescriptor socket) : socket_(std::move(socket)) {}

  // The next request without its end, which is valid until the next call; empty: the client has left or is given up.
  std::optional<std::string_view> next() {
    buffer_.erase(0, used_);
    used_ = 0;
    for (std::size_t searched = 0;;) {
      const std::size_t end = buffer_.find('\n', searched);
      if (end != std::string::npos) {
        used_ = end + 1;
        return std::string_view(buffer_).substr(0, end);
      }
      searched = buffer_.size();
      if (buffer_.size() > kMostRequestBytes) {
        send(fmt::format(R"({{"id":null,"ok":false,"error":"a request has more than {} bytes"}})", kMostRequestBytes));
        return std::nullopt;
      }
      if (!read()) return std::nullopt;
    }
  }

  bool send(std::string_view line) {
    return gone_ ? false : write(line) && write("\n");
  }

 private:
  bool read() {
    std::array<char, kBytesAtOnce> bytes;
    if (gone_ || !wait_for(socket_.get(), POLLIN, -1)) return false;
    const ssize_t count = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return true;
    if (count <= 0) return false;
    buffer_.append(bytes.data(), static_cast<std::size_t>(count));
    return true;
  }

  bool write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count >= 0) {
        bytes.remove_prefix(static_cast<std::size_t>(count));
      } else if (errno == EAGAIN) {
        if (wait_for(socket_.get(), POLLOUT, kPatienceS * 1000)) continue;
        core::log_line(fmt::format("the client has not read its answers for {} s; it is given up", kPatienceS));
        gone_ = true;
      } else if (errno != EINTR) {
        gone_ = true;
      }
      if (gone_) return false;
    }
    return true;
  }

  core::FileDescriptor socket_;
  std::string buffer_;
  std::size_t used_ = 0;  // bytes of the request that was returned last
  bool gone_ = false;
};

}  // namespace

// Removes the socket at the end, whichever it is.
struct SocketServer::Path {
  explicit Path(std::string given) : name(std::move(given)), on_interruption([this] { ::unlink(name.c_str()); }) {}
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;
  ~Path() { ::unlink(name.c_str()); }

  const std::string name;
  core::OnInterruption on_interruption;
};

SocketServer::SocketServer(std::unique_ptr<Path> path, core::FileDescriptor listener)
    : path_(std::move(path)), listener_(std::move(listener)) {}
SocketServer::~SocketServer() = default;

core::Result<SocketServer> SocketServer::listen(const std::string& path) {
  const auto address = address_of(path);
  if (!address) return tl::unexpected(address.error());
  core::FileDescriptor listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (is_abandoned(path, *address)) ::unlink(path.c_str());
  const mode_t mask = ::umask(0177);  // 0600 from the first moment on
  const bool bound = listener.is_open() && ::bind(listener.get(), as_socket_address(*address), sizeof(*address)) == 0;
  const int error = errno;
  ::umask(mask);
  if (!bound && error == EADDRINUSE) {
    return core::wrong_usage(fmt::format("--socket {}: there is already such a file or server; choose another path", path));
  }
  auto kept = bound ? std::make_unique<Path>(path) : nullptr;
  if (!bound || ::listen(listener.get(), kWaitingClients) != 0) {
    return core::failure(core::ErrorCategory::Failed, fmt::format("cannot listen on the socket {}: {}", path,
                                                                  core::system_error(bound ? errno : error)));
  }
  return SocketServer(std::move(kept), std::move(listener));
}

core::Result<void> SocketServer::run(JsonDoor& door, Clients clients) {
  for (;;) {
    if (!wait_for(listener_.get(), POLLIN, -1)) {
      return core::failure(core::ErrorCategory::Failed, fmt::format("cannot wait for a client on the socket {}: {}",
                                                                    path_->name, core::system_error(errno)));
    }
    core::FileDescriptor socket(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!socket.is_open()) continue;
    if (!core::trusted_peer(socket.get(), ::getuid())) {
      core::log_line("refused a client of another user");
      continue;
    }
    Client client(std::move(socket));
    while (const auto request = client.next()) {
      const auto then = door.answer(*request, [&client](std::string_view line) { return client.send(line); });
      if (then == JsonDoor::Then::Quit) return {};
    }
    if (clients == Clients::One) return {};
  }
}

}  // namespace afm::instrument

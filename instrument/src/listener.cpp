// SPDX-License-Identifier: Apache-2.0
#include "instrument/listener.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "core/interruption.h"
#include "core/log.h"
#include "core/system_error.h"
#include "core/trusted_peer.h"

namespace afm::instrument {
namespace {

constexpr int kWaitingClients = 128;

template <class Address>
const sockaddr* as_address(const Address& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}
template <class Address>
sockaddr* as_address(Address& address) {
  return reinterpret_cast<sockaddr*>(&address);
}

core::Result<sockaddr_un> address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) {
    return core::wrong_usage(
        fmt::format("--socket {}: give a path of 1 to {} letters", path, sizeof(address.sun_path) - 1));
  }
  std::copy(path.begin(), path.end(), address.sun_path);
  return address;
}

// True for a socket left behind by a killed program.
bool is_abandoned(const std::string& path, const sockaddr_un& address) {
  struct stat facts{};
  if (::lstat(path.c_str(), &facts) != 0 || !S_ISSOCK(facts.st_mode) || facts.st_uid != ::getuid()) return false;
  const core::FileDescriptor visitor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  return visitor.is_open() && ::connect(visitor.get(), as_address(address), sizeof(address)) != 0 &&
         errno == ECONNREFUSED;
}

// Address in the form of /proc/net/tcp: "0100007F:1965".
std::string entry_of(const sockaddr_in& address) {
  return fmt::format("{:08X}:{:04X}", address.sin_addr.s_addr, ntohs(address.sin_port));
}

// User of the process at the other end of a connection within this machine; empty if the system does not say.
std::optional<uid_t> user_of_peer(int socket) {
  sockaddr_in here{}, there{};
  socklen_t here_size = sizeof(here), there_size = sizeof(there);
  if (::getsockname(socket, as_address(here), &here_size) != 0) return std::nullopt;
  if (::getpeername(socket, as_address(there), &there_size) != 0) return std::nullopt;
  const std::string local = entry_of(there), remote = entry_of(here);
  std::ifstream table("/proc/net/tcp");
  for (std::string line; std::getline(table, line);) {
    // sl, local, remote, state, queues, timer, retransmits, user
    std::istringstream words(line);
    std::string number, its_local, its_remote, state, queues, timer, retransmits;
    uid_t user = 0;
    if (words >> number >> its_local >> its_remote >> state >> queues >> timer >> retransmits >> user &&
        its_local == local && its_remote == remote) {
      return user;
    }
  }
  return std::nullopt;
}

core::Error cannot_listen(const std::string& where, int error) {
  return {core::ErrorCategory::Failed,
          fmt::format("cannot listen on {}: {}; choose another one", where, core::system_error(error))};
}

}  // namespace

// Removes the socket at the end, whichever it is.
struct Listener::Path {
  explicit Path(std::string given) : name(std::move(given)), on_interruption([this] { ::unlink(name.c_str()); }) {}
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;
  ~Path() { ::unlink(name.c_str()); }

  const std::string name;
  core::OnInterruption on_interruption;
};

Listener::Listener(core::FileDescriptor socket, std::unique_ptr<Path> path)
    : path_(std::move(path)), socket_(std::move(socket)) {}
Listener::Listener(Listener&&) noexcept = default;
Listener::~Listener() = default;

core::Result<Listener> Listener::on_socket(const std::string& path) {
  const auto address = address_of(path);
  if (!address) return tl::unexpected(address.error());
  core::FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (is_abandoned(path, *address)) ::unlink(path.c_str());
  const mode_t mask = ::umask(0177);  // mode 0600 from the beginning
  const bool bound = socket.is_open() && ::bind(socket.get(), as_address(*address), sizeof(*address)) == 0;
  const int error = errno;
  ::umask(mask);
  if (!bound && error == EADDRINUSE) {
    return core::wrong_usage(
        fmt::format("--socket {}: there is already such a file or server; choose another path", path));
  }
  if (!bound) return tl::unexpected(cannot_listen("the socket " + path, error));
  auto kept = std::make_unique<Path>(path);
  if (::listen(socket.get(), kWaitingClients) != 0) return tl::unexpected(cannot_listen("the socket " + path, errno));
  return Listener(std::move(socket), std::move(kept));
}

core::Result<Listener> Listener::on_loopback(std::uint16_t port) {
  core::FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int again = 1;  // lets a port be used again as soon as its last server has ended
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool open =
      socket.is_open() && ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &again, sizeof(again)) == 0 &&
      ::bind(socket.get(), as_address(address), sizeof(address)) == 0 && ::listen(socket.get(), kWaitingClients) == 0;
  if (!open) return tl::unexpected(cannot_listen(fmt::format("port {} of 127.0.0.1", port), errno));
  return Listener(std::move(socket), nullptr);
}

std::uint16_t Listener::port() const {
  sockaddr_in address{};
  socklen_t size = sizeof(address);
  return ::getsockname(socket_.get(), as_address(address), &size) == 0 ? ntohs(address.sin_port) : std::uint16_t{0};
}

core::FileDescriptor Listener::accept() const {
  core::FileDescriptor client(::accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!client.is_open()) return {};
  const bool trusted =
      path_ ? core::trusted_peer(client.get(), ::getuid()).has_value() : user_of_peer(client.get()) == ::getuid();
  if (trusted) return client;
  core::log_line("refused a client of another user");
  return {};
}

}  // namespace afm::instrument

// SPDX-License-Identifier: Apache-2.0
#include "servo/servo_handover.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string_view>
#include <utility>

#include "core/system_error.h"
#include "descriptor_letter.h"

namespace afm::servo {

namespace {

constexpr int kPatienceMs = 1000;
constexpr char kStay = 'S';
constexpr char kSeparator = '\n';

struct Address {
  sockaddr_un name{};
  socklen_t size = 0;
};

// Two builds on one machine have two paths, and never meet.
Address address_of(const std::string& program) {
  std::error_code unused;
  const std::string path = std::filesystem::weakly_canonical(program, unused).string();
  const std::string name = fmt::format("touchafm-servo-{}-{:x}", ::getuid(), std::hash<std::string>{}(path));
  Address address;
  address.name.sun_family = AF_UNIX;
  std::copy(name.begin(), name.end(), address.name.sun_path + 1);  // after a zero: abstract, gone with its socket
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return address;
}

core::FileDescriptor seqpacket_socket() {
  return core::FileDescriptor(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
}

// Who is at the other end, if it is a process of this user.
std::optional<pid_t> trusted_peer(int socket) {
  ucred peer{};
  socklen_t size = sizeof(peer);
  const bool known = ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
  return known && peer.uid == ::getuid() ? std::optional(peer.pid) : std::nullopt;
}

bool readable_within(int descriptor, int milliseconds) {
  pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
  int ready = 0;
  do {
    ready = ::poll(&watched, 1, milliseconds);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

std::string joined(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) text += argument + kSeparator;
  return text;
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t end = 0; (end = text.find(kSeparator)) != std::string_view::npos; text.remove_prefix(end + 1)) {
    parts.emplace_back(text.substr(0, end));
  }
  return parts;
}

}  // namespace

std::vector<std::string> servo_arguments(const haptics::ServoSettings& settings, const std::string& device) {
  return {"--rate",      fmt::format("{}", settings.rate_hz),    "--spin",    std::to_string(settings.spin_ns),
          "--dead-man",  settings.dead_man ? "1" : "0",          "--haptics", device,
          "--max-force", fmt::format("{}", settings.max_force_n)};
}

core::Result<HandoverPort> HandoverPort::open(const std::string& program) {
  core::FileDescriptor listener = seqpacket_socket();
  const Address address = address_of(program);
  const auto* name = reinterpret_cast<const sockaddr*>(&address.name);
  if (!listener.is_open() || ::bind(listener.get(), name, address.size) != 0 || ::listen(listener.get(), 4) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot wait for another renderer: {}", core::system_error(errno)));
  }
  return HandoverPort(std::move(listener));
}

HandoverPort::Answer HandoverPort::receive(int segment, const std::vector<std::string>& arguments,
                                           core::FileDescriptor& lifeline) const {
  const core::FileDescriptor visitor(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  if (!visitor.is_open() || !trusted_peer(visitor.get())) return Answer::Nobody;
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return Answer::Nobody;
  core::FileDescriptor ours(ends[0]);
  core::FileDescriptor theirs(ends[1]);
  const std::array handed{segment, theirs.get()};
  if (!Letter().send(visitor.get(), joined(arguments), handed)) return Answer::Nobody;
  theirs.close();

  char answer = 0;
  const bool stays = readable_within(ours.get(), kPatienceMs) && ::read(ours.get(), &answer, 1) == 1 && answer == kStay;
  if (!stays) return Answer::Leave;
  lifeline = std::move(ours);
  return Answer::Stay;
}

void WaitingServo::stay() const {
  // a servo that is gone by now is seen dead in the next frame
  [[maybe_unused]] const auto sent = ::send(lifeline.get(), &kStay, 1, MSG_NOSIGNAL);
}

std::optional<WaitingServo> find_waiting_servo(const std::string& program) {
  const core::FileDescriptor socket = seqpacket_socket();
  const Address address = address_of(program);
  const auto* name = reinterpret_cast<const sockaddr*>(&address.name);
  if (!socket.is_open() || ::connect(socket.get(), name, address.size) != 0) return std::nullopt;
  const auto servo = trusted_peer(socket.get());
  if (!servo) return std::nullopt;
  core::FileDescriptor process(static_cast<int>(::syscall(SYS_pidfd_open, *servo, 0)));
  std::array<core::FileDescriptor, 2> descriptors;
  Letter letter;
  if (!readable_within(socket.get(), kPatienceMs)) return std::nullopt;
  const auto text = letter.read(socket.get(), descriptors);
  if (!process.is_open() || !text || !descriptors[0].is_open()) return std::nullopt;
  return WaitingServo{.segment = std::move(descriptors[0]),
                      .lifeline = std::move(descriptors[1]),
                      .process = std::move(process),
                      .arguments = split(*text)};
}

bool process_ended_within(const core::FileDescriptor& process, int milliseconds) {
  return readable_within(process.get(), milliseconds);
}

}  // namespace afm::servo

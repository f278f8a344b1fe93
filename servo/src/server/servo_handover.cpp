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
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/fnv1a.h"
#include "core/system_error.h"
#include "core/trusted_peer.h"
#include "descriptor_letter.h"
#include "haptics/servo_loop.h"
#include "private_folder.h"

namespace afm::servo {

namespace {

namespace fs = std::filesystem;

constexpr int kPatienceMs = 1000;
constexpr int kWaitingVisitors = 4;
constexpr char kStay = 'S';
constexpr char kSeparator = '\n';

std::string joined(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) text += argument + kSeparator;
  return text;
}

core::Result<sockaddr_un> address_of(const fs::path& socket) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& name = socket.native();
  if (name.size() >= sizeof(address.sun_path)) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("the socket name {} is longer than {} bytes: choose a shorter XDG_RUNTIME_DIR",
                                     name, sizeof(address.sun_path) - 1));
  }
  std::copy(name.begin(), name.end(), address.sun_path);
  return address;
}

const sockaddr* as_socket_address(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

// Name prefix from the program's path: two builds on one machine never meet.
std::string prefix_of(const std::string& program) {
  std::error_code unused;
  return fmt::format("servo-{:016x}-", core::fnv1a(fs::weakly_canonical(program, unused).native()));
}

std::string name_of(const std::string& program, std::uint64_t scene_digest, const std::vector<std::string>& arguments) {
  return fmt::format("{}{:016x}-", prefix_of(program), scene_digest ^ core::fnv1a(joined(arguments)));
}

core::FileDescriptor seqpacket_socket() {
  return core::FileDescriptor(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

bool readable_within(int descriptor, int milliseconds) {
  pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
  int ready = 0;
  do {
    ready = ::poll(&watched, 1, milliseconds);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
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

core::Result<HandoverPort> HandoverPort::open(const std::string& program, std::uint64_t scene_digest,
                                              const std::vector<std::string>& arguments) {
  const auto folder = private_folder();
  if (!folder) return tl::unexpected(folder.error());
  const fs::path path = *folder / (name_of(program, scene_digest, arguments) + std::to_string(::getpid()));
  // hidden until it can answer
  const fs::path unready = *folder / fmt::format(".{}", ::getpid());
  const auto address = address_of(path);
  const auto unready_address = address_of(unready);
  if (!address) return tl::unexpected(address.error());
  if (!unready_address) return tl::unexpected(unready_address.error());
  core::FileDescriptor listener = seqpacket_socket();
  ::unlink(unready.c_str());
  if (!listener.is_open() || ::bind(listener.get(), as_socket_address(*unready_address), sizeof(sockaddr_un)) != 0 ||
      ::listen(listener.get(), kWaitingVisitors) != 0 || ::rename(unready.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(unready.c_str());
    return core::failure(core::ErrorCategory::Failed, fmt::format("cannot wait for a new renderer at {}: {}",
                                                                  path.string(), core::system_error(error)));
  }
  return HandoverPort(std::move(listener), path);
}

HandoverPort::~HandoverPort() {
  if (listener_.is_open()) ::unlink(path_.c_str());
}

HandoverPort::Answer HandoverPort::receive(int segment, const std::vector<std::string>& arguments,
                                           core::FileDescriptor& lifeline) const {
  const core::FileDescriptor visitor(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!visitor.is_open() || !core::trusted_peer(visitor.get(), ::getuid())) return Answer::Nobody;
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return Answer::Nobody;
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
  // a servo that has gone in the meantime is noticed in the next frame
  [[maybe_unused]] const auto sent = ::send(lifeline.get(), &kStay, 1, MSG_NOSIGNAL);
}

std::vector<fs::path> find_waiting_servos(const std::string& program, std::uint64_t scene_digest,
                                          const std::vector<std::string>& arguments) {
  std::vector<fs::path> found;
  const auto folder = private_folder();
  if (!folder) return found;
  const std::string any = prefix_of(program), own = name_of(program, scene_digest, arguments);
  std::error_code error;
  for (fs::directory_iterator entry(*folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().native().starts_with(any)) found.push_back(entry->path());
  }
  std::partition(found.begin(), found.end(),
                 [&](const fs::path& path) { return path.filename().native().starts_with(own); });
  return found;
}

std::optional<WaitingServo> visit_servo(const fs::path& path) {
  const core::FileDescriptor socket = seqpacket_socket();
  const auto address = address_of(path);
  if (!socket.is_open() || !address) return std::nullopt;
  if (::connect(socket.get(), as_socket_address(*address), sizeof(sockaddr_un)) != 0) {
    if (errno == ECONNREFUSED) ::unlink(path.c_str());  // socket left by a killed servo
    return std::nullopt;
  }
  const auto servo = core::trusted_peer(socket.get(), ::getuid());
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

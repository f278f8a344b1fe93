// SPDX-License-Identifier: Apache-2.0
#include "support/network/lossy_network.h"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <new>
#include <random>
#include <span>
#include <stdexcept>

#include "support/run_program.h"

namespace afm::support {
namespace {

constexpr const char* kInterface = "t0";
constexpr std::uint32_t kSeed = 20'261'124;

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
  throw std::runtime_error("cannot make the network of the test: " + what + ": " + why +
                           "; network namespaces and /dev/net/tun need root");
}
[[noreturn]] void refuse(const std::string& what) { refuse(what, std::strerror(errno)); }

void run(const std::string& command) {
  const ProgramResult result = run_program(command);
  if (result.exit_code == 0) return;
  std::string said = result.out + result.err;
  while (said.ends_with('\n')) said.pop_back();
  refuse(command, said);
}

// The end of a TAP interface in a namespace, as a child that has entered it opens it.
int open_tap(const std::string& space) {
  const int own = ::open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
  const int other = ::open(("/run/netns/" + space).c_str(), O_RDONLY | O_CLOEXEC);
  if (own < 0 || other < 0 || ::setns(other, CLONE_NEWNET) != 0) refuse("namespace " + space);
  const int tap = ::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
  ifreq request{};
  std::strncpy(request.ifr_name, kInterface, IFNAMSIZ - 1);
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  const bool made = tap >= 0 && ::ioctl(tap, TUNSETIFF, &request) == 0;
  if (::setns(own, CLONE_NEWNET) != 0 || !made) refuse("interface in " + space);
  ::close(own);
  ::close(other);
  return tap;
}

// True for a frame to a group, but not to all: questions for addresses go to all.
bool is_multicast(std::span<const char> ethernet_frame) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(ethernet_frame[i]); };
  return (byte(0) & 1U) != 0 && byte(0) != 0xff;
}

struct Waiting {
  std::size_t to = 0;
  std::vector<char> bytes;
};

}  // namespace

std::string LossyNetwork::name(std::size_t machine) const {
  return "afm" + std::to_string(::getpid()) + "-" + std::to_string(machine);
}

void LossyNetwork::add_machine(std::size_t machine) {
  const std::string space = name(machine);
  run("ip netns add " + space);
  taps_.push_back(open_tap(space));
  run("ip -n " + space + " addr add " + address(machine) + "/24 dev " + kInterface);
  run("ip -n " + space + " link set " + kInterface + " up");
  run("ip -n " + space + " link set lo up");
}

LossyNetwork::LossyNetwork(const std::vector<Line>& machines, Multicast multicast) {
  void* memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (machines.size() > kMost || memory == MAP_FAILED) refuse("memory");
  shared_ = new (memory) Shared();
  try {
    for (std::size_t i = 0; i < machines.size(); ++i) add_machine(i);
  } catch (...) {
    remove();
    throw;
  }
  switch_ = ::fork();
  if (switch_ != 0) return;

  // the switch: every frame goes to all others, sooner or later or not at all
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  std::multimap<std::int64_t, Waiting> waiting;
  std::vector<pollfd> ends;
  for (const int tap : taps_) ends.push_back({.fd = tap, .events = POLLIN, .revents = 0});
  for (;;) {
    const std::int64_t wait_ns =
        waiting.empty() ? 1'000'000'000 : std::max<std::int64_t>(0, waiting.begin()->first - now_ns());
    const timespec timeout{.tv_sec = wait_ns / 1'000'000'000, .tv_nsec = wait_ns % 1'000'000'000};
    ::ppoll(ends.data(), ends.size(), &timeout, nullptr);
    for (std::size_t from = 0; from < taps_.size(); ++from) {
      std::array<char, 2048> frame;
      ssize_t size = 0;
      while ((size = ::read(taps_[from], frame.data(), frame.size())) > 0) {
        if (multicast == Multicast::Forbidden && is_multicast(frame)) continue;
        for (std::size_t to = 0; to < taps_.size(); ++to) {
          if (to == from) continue;
          if (shared_->out[from] || shared_->out[to]) continue;
          if (chance(random) < machines[from].lost || chance(random) < machines[to].lost) {
            ++shared_->lost;
            continue;
          }
          double delay_ms = 0;
          for (const std::size_t end : {from, to}) {
            delay_ms += machines[end].delay_ms + machines[end].jitter_ms * (2.0 * chance(random) - 1.0);
          }
          waiting.emplace(now_ns() + static_cast<std::int64_t>(1e6 * std::max(0.0, delay_ms)),
                          Waiting{to, {frame.begin(), frame.begin() + size}});
        }
      }
    }
    while (!waiting.empty() && waiting.begin()->first <= now_ns()) {
      const Waiting& next = waiting.begin()->second;
      [[maybe_unused]] const auto written = ::write(taps_[next.to], next.bytes.data(), next.bytes.size());
      waiting.erase(waiting.begin());
    }
  }
}

LossyNetwork::~LossyNetwork() { remove(); }

void LossyNetwork::remove() {
  if (switch_ > 0) {
    ::kill(switch_, SIGKILL);
    ::waitpid(switch_, nullptr, 0);
  }
  for (const int tap : taps_) ::close(tap);
  for (std::size_t i = 0; i <= taps_.size(); ++i) run_program("ip netns del " + name(i));
  if (shared_ != nullptr) ::munmap(shared_, sizeof(Shared));
}

std::vector<std::string> LossyNetwork::on(std::size_t machine, const std::vector<std::string>& command) const {
  std::vector<std::string> whole{"/usr/bin/env", "ip", "netns", "exec", name(machine)};
  whole.insert(whole.end(), command.begin(), command.end());
  return whole;
}

}  // namespace afm::support

// SPDX-License-Identifier: Apache-2.0
// Invariant: renderer, servo and watchdog may be killed, stopped or hung up in any order: the rest release the hand
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "haply_hand.h"
#include "haptics/devices/haply_service.h"
#include "live_renderer.h"
#include "servo/servo_client.h"
#include "servo/watchdog.h"
#include "support/deep.h"
#include "support/stall_watch.h"

// Faults that take the guard and the guarded together: renderer, servo and watchdog are killed, stopped, terminated or
// hung up in every order, with force on the hand. Who is left has to release it. Two devices: Haply's service, which
// holds the last force it was sent and which other processes can reach, and the simulated hand, which nobody but the
// servo can reach, like a device behind a vendor's library.
namespace afm::servo {
namespace guard_faults_test {

using namespace test;
using std::chrono::milliseconds;

enum class Victim { Renderer, Servo, Watchdog };
constexpr std::array kVictims{Victim::Renderer, Victim::Servo, Victim::Watchdog};
constexpr std::array kSignals{SIGKILL, SIGSTOP, SIGTERM, SIGHUP};
constexpr int kSpacingMs = 50;  // time between two faults

struct Fault {
  Victim victim;
  int signal;
};
using Faults = std::vector<Fault>;

std::string text_of(const Faults& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    text += fmt::format("{}{}:{}", text.empty() ? "" : " ", "vsw"[static_cast<int>(fault.victim)],
                        ::sigabbrev_np(fault.signal));
  }
  return text;
}

// All sequences of `count` different victims, each with each signal.
std::vector<Faults> every(std::size_t count) {
  std::vector<Faults> all{{}};
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Faults> longer;
    for (const Faults& begun : all) {
      for (const Victim victim : kVictims) {
        if (std::any_of(begun.begin(), begun.end(), [&](const Fault& fault) { return fault.victim == victim; }))
          continue;
        for (const int signal : kSignals) {
          longer.push_back(begun);
          longer.back().push_back({victim, signal});
        }
      }
    }
    all = std::move(longer);
  }
  return all;
}

// The manual's table, "What dies, and when the force is gone", in ms from the first fault; empty where nobody is left
// but the device's own watchdog. A fade that the next fault may interrupt does not count.
class Table {
 public:
  // `reachable`: by other processes than the servo.
  explicit constexpr Table(bool reachable) : reachable_(reachable) {}

  std::optional<int> operator()(const Faults& faults) const { return released_ms(faults, true); }

  // Whether the hand is released only by the renderer's death, which a killed process needs processor time for.
  bool waits_for_death(const Faults& faults) const { return released_ms(faults, true) != released_ms(faults, false); }

 private:
  std::optional<int> released_ms(const Faults& faults, bool by_death) const {
    constexpr int kNever = 1'000'000;
    std::array<int, 3> stopped_ms{kNever, kNever, kNever}, dead_ms{kNever, kNever, kNever};
    int told_ms = kNever;
    for (std::size_t i = 0; i < faults.size(); ++i) {
      const auto [victim, signal] = faults[i];
      const int at_ms = static_cast<int>(i) * kSpacingMs;
      const bool ends = signal != SIGSTOP;
      if (victim == Victim::Servo && ends && signal != SIGKILL) {
        told_ms = at_ms;
      } else if (victim != Victim::Watchdog || signal == SIGKILL || signal == SIGSTOP) {
        (ends ? dead_ms : stopped_ms)[static_cast<std::size_t>(victim)] = at_ms;
      }
    }
    const auto lost_ms = [&](Victim v) {
      return std::min(stopped_ms[static_cast<std::size_t>(v)], dead_ms[static_cast<std::size_t>(v)]);
    };
    const int renderer_ms = lost_ms(Victim::Renderer), servo_ms = lost_ms(Victim::Servo),
              watchdog_ms = lost_ms(Victim::Watchdog);
    std::vector<int> released{kNever};
    const auto by_servo = [&](int from_ms, int takes_ms) {
      if (from_ms + takes_ms + kSpacingMs / 2 <= servo_ms) released.push_back(from_ms + takes_ms);
    };
    // 20 on a quiet machine; a busy one closes a dead process's sockets late
    if (by_death) by_servo(dead_ms[static_cast<std::size_t>(Victim::Renderer)], 100);
    by_servo(stopped_ms[static_cast<std::size_t>(Victim::Renderer)], 340);
    by_servo(dead_ms[static_cast<std::size_t>(Victim::Watchdog)], 90);
    by_servo(stopped_ms[static_cast<std::size_t>(Victim::Watchdog)], 190);
    by_servo(told_ms, 90);
    const bool killed = dead_ms[static_cast<std::size_t>(Victim::Servo)] < kNever;
    const auto by_guard = [&](int guard_ms, int takes_ms, int kills_ms) {
      // a dead servo closes its device at once, on a busy machine a little later
      const int until_ms = reachable_ ? takes_ms : killed ? 30 : kills_ms;
      if (servo_ms < kNever && servo_ms + until_ms + kSpacingMs / 2 <= guard_ms)
        released.push_back(servo_ms + until_ms);
    };
    by_guard(watchdog_ms, 25, 1000);
    by_guard(renderer_ms, 80, 1520);
    // the kernel continues a stopped servo whose renderer has died, and hangs up
    const int orphaned_ms = dead_ms[static_cast<std::size_t>(Victim::Renderer)];
    if (by_death && !killed && servo_ms < orphaned_ms && orphaned_ms < kNever) released.push_back(orphaned_ms + 100);
    const int first_ms = *std::min_element(released.begin(), released.end());
    return first_ms < kNever ? std::optional(first_ms) : std::nullopt;
  }

  bool reachable_;
};

// The only child of a process, or -1.
pid_t child_of(pid_t process) {
  std::ifstream children(fmt::format("/proc/{}/task/{}/children", process, process));
  pid_t child = -1;
  children >> child;
  return child;
}

// Renderer, servo and watchdog in a session of their own, with force on the hand.
class Chain {
 public:
  explicit Chain(bool haply) : haply_(haply) {
    const int port = service_.port();
    EXPECT_EQ(::write(port_in_, &port, sizeof port), ssize_t{sizeof port});
    ::close(port_in_);
    eventually([&] { return (servo_ = child_of(renderer_)) > 0 && (watchdog_ = child_of(servo_)) > 0; });
    attached_ = eventually([&] {
      if (!renderer_lives() || ended(servo_)) return true;
      return haply_ ? attach(service_, side_, [] {}) : holds(side_);
    });
  }
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;
  ~Chain() {
    for (const pid_t process : {renderer_, servo_, watchdog_}) {
      if (process > 0) ::kill(process, SIGKILL);
    }
    while (::waitpid(-1, nullptr, 0) > 0) {
    }
  }

  bool attached() const { return attached_; }
  bool renderer_lives() const { return !ended(renderer_); }

  void raise(const Fault& fault) const {
    const std::array processes{renderer_, servo_, watchdog_};
    ::kill(processes[static_cast<std::size_t>(fault.victim)], fault.signal);
  }

  // Force at the device: as the service holds it; of the simulated hand, as long as its servo lives.
  double force_n() {
    if (haply_) return force_at(service_);
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    if (ended(servo_)) return 0.0;
    if (const auto state = side_.tip_state()) hand_n_ = std::abs(state->hand.force_n[1]);
    return hand_n_;
  }

 private:
  // A zombie's device is closed.
  static bool ended(pid_t process) {
    std::ifstream stat(fmt::format("/proc/{}/stat", process));
    std::string number, name, state;
    return !(stat >> number >> name >> state) || state == "Z" || state == "X";
  }

  // Before the service and its thread: a child of several threads cannot be trusted to start threads.
  pid_t start_renderer() {
    EXPECT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1UL, 0UL, 0UL, 0UL), 0);
    std::array<int, 2> port{};
    EXPECT_EQ(::pipe2(port.data(), O_CLOEXEC), 0);
    const pid_t renderer = ::fork();
    if (renderer == 0) {
      ::close(port[1]);
      draw(port[0]);
    }
    ::close(port[0]);
    port_in_ = port[1];
    return renderer;
  }

  [[noreturn]] void draw(int port_out) {
    ::setsid();
    int port = 0;
    if (::read(port_out, &port, sizeof port) != ssize_t{sizeof port}) ::_exit(1);
    ::setenv("TOUCHAFM_HAPLY_PORT", std::to_string(port).c_str(), 1);
    scene::RendererSide side = segment_.renderer_side();
    auto servo = ServoProcess::spawn(kServoProgram, segment_, side, {.rate_hz = kRateHz}, haply_ ? "haply" : "sim");
    if (!servo) ::_exit(1);
    LiveRenderer renderer(side);
    side.store(scene::Selection{.material = kMica, .revision = 1});
    if (!haply_ && !renderer.hold_attached()) ::_exit(1);
    // like the program, which looks for its servo's end in each frame
    while ((*servo)->alive()) {
      renderer.beat();
      wait_a_little();
    }
    for (;;) ::pause();
  }

  bool haply_;
  scene::SharedSegment segment_ = create_segment();
  scene::RendererSide side_ = segment_.renderer_side();
  int port_in_ = -1;  // write end of a pipe for the service's port
  pid_t renderer_ = start_renderer(), servo_ = -1, watchdog_ = -1;
  HaplyService service_;
  double hand_n_ = 1.0;
  bool attached_ = false;
};

// Time from the first fault to the renderer's.
milliseconds killed_after(const Faults& faults) {
  const auto at =
      std::find_if(faults.begin(), faults.end(), [](const Fault& f) { return f.victim == Victim::Renderer; });
  return milliseconds(kSpacingMs) * (at - faults.begin());
}

// Time from the first fault to the first moment without force, or `limit`; without the time that a killed renderer
// takes to die where the release waits for that.
support::Timed time_of_force(Chain& chain, const Faults& faults, bool waits_for_death, milliseconds limit) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kMostDying{10};
  Clock::duration dying{};
  Clock::duration lasted{};
  support::Timed seen = support::timed([&] {
    const auto begin = Clock::now();
    bool gone = false, dead = false;
    std::thread raiser([&] {
      for (std::size_t i = 0; i < faults.size(); ++i) {
        std::this_thread::sleep_until(begin + milliseconds(kSpacingMs) * static_cast<int>(i));
        chain.raise(faults[i]);
      }
    });
    while (!gone && Clock::now() < begin + limit + std::min<Clock::duration>(dying, kMostDying)) {
      gone = chain.force_n() == 0.0;
      if (waits_for_death && !dead) {
        dead = !chain.renderer_lives();
        if (Clock::now() > begin + killed_after(faults)) dying = Clock::now() - begin - killed_after(faults);
      }
      if (!gone) wait_a_little();
    }
    lasted = Clock::now() - begin;
    raiser.join();  // end of the faults that come after the release
  });
  seen.took = lasted - dying;
  return seen;
}

// Expects a release within doubled bounds, as in other tests of real processes.
void expect_release(bool haply, const Faults& faults) {
  SCOPED_TRACE(fmt::format("{} {}", haply ? "haply" : "simulated", text_of(faults)));
  const Table table(haply);
  const auto bound_ms = table(faults);
  if (!bound_ms) {
    std::printf("%s %s: nobody is left but the device's own watchdog\n", haply ? "haply" : "simulated",
                text_of(faults).c_str());
    return;
  }
  std::printf("%s %s: ", haply ? "haply" : "simulated", text_of(faults).c_str());
  const milliseconds bound(2 * *bound_ms + 20);
  support::expect_within(bound, [&]() -> support::Timed {
    Chain chain(haply);
    EXPECT_TRUE(chain.attached());
    if (testing::Test::HasFailure()) return {};
    return time_of_force(chain, faults, table.waits_for_death(faults), 3 * bound);
  });
}

TEST(GuardFaults, AreNamedByTheManualsTable) {
  constexpr Table haply(true), library(false);
  const Faults servo_and_watchdog{{Victim::Servo, SIGKILL}, {Victim::Watchdog, SIGKILL}};
  EXPECT_EQ(haply(servo_and_watchdog), 25);
  EXPECT_EQ(library(servo_and_watchdog), 30);
  const Faults stopped{{Victim::Watchdog, SIGSTOP}, {Victim::Servo, SIGSTOP}};
  EXPECT_EQ(haply(stopped), kSpacingMs + 80);
  EXPECT_EQ(library(stopped), kSpacingMs + 1520);
  const Faults all{{Victim::Watchdog, SIGSTOP}, {Victim::Renderer, SIGSTOP}, {Victim::Servo, SIGSTOP}};
  EXPECT_EQ(haply(all), std::nullopt);
  EXPECT_FALSE(haply.waits_for_death(stopped));
  EXPECT_TRUE(
      haply.waits_for_death({{Victim::Watchdog, SIGSTOP}, {Victim::Servo, SIGSTOP}, {Victim::Renderer, SIGKILL}}));
  EXPECT_EQ(every(2).size(), 96U);
  EXPECT_EQ(every(3).size(), 384U);
}

// The worst that the program itself can meet.
class WorstGuardFaults : public testing::TestWithParam<Faults> {};

TEST_P(WorstGuardFaults, LeaveNoForce) { expect_release(true, GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Of, WorstGuardFaults,
    testing::Values(Faults{{Victim::Watchdog, SIGSTOP}}, Faults{{Victim::Watchdog, SIGKILL}, {Victim::Servo, SIGKILL}},
                    Faults{{Victim::Watchdog, SIGSTOP}, {Victim::Servo, SIGSTOP}},
                    Faults{{Victim::Watchdog, SIGSTOP}, {Victim::Servo, SIGSTOP}, {Victim::Renderer, SIGKILL}}),
    [](const auto& parameter) {
      std::string name = text_of(parameter.param);
      name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c == ' ' || c == ':'; }), name.end());
      return name;
    });

// A draw of the pairs and triples, on both devices in turn: 40 in the deep checks. AFM_ALL_GUARD_FAULTS: all of them on
// both, which takes two hours.
TEST(GuardFaults, LeaveNoForceInAnyOrder) {
  std::vector<Faults> all = every(2);
  const std::vector<Faults> triples = every(3);
  all.insert(all.end(), triples.begin(), triples.end());
  const bool whole = std::getenv("AFM_ALL_GUARD_FAULTS") != nullptr;
  if (!whole) {
    std::shuffle(all.begin(), all.end(), std::mt19937(34));
    all.resize(support::deep() ? 40 : 2);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (whole || i % 2 == 0) expect_release(true, all[i]);
    if (whole || i % 2 == 1) expect_release(false, all[i]);
  }
}

}  // namespace guard_faults_test
}  // namespace afm::servo

// SPDX-License-Identifier: Apache-2.0
// A whole session with a wand through a real kernel's hidraw and the real libhidapi: plug, choose gold, unplug in
// mid-drag, plug again, navigate, home; and a mouse of the same maker is no wand. It runs in a virtual machine (see
// run_guest.sh) and says "session passed" at its end.
// Invariant: hidapi opens, loses and reopens a wand with a real kernel
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

#include "core/clock.h"
#include "hid_guest/virtual_spacemouse.h"
#include "input/hid_source.h"
#include "input/navigation.h"
#include "input/selection.h"
#include "input/wand_source.h"

namespace {

using namespace afm;
using hid_guest::VirtualSpaceMouse;

constexpr std::uint32_t k3Dconnexion = 0x256f, kCompact = 0xc635, kCadMouse = 0xc650;
constexpr std::size_t kGold = 1;
constexpr double kPatienceS = 8.0;  // without a hardware clock's help a guest is slow
constexpr double kFrameS = 1.0 / 60.0;

// The frame loop of the live view, as far as the wand goes.
class Loop {
 public:
  Loop() : navigation_({0.0, 1.65, 0.0}) {
    for (const double x : {-0.8, 0.4, 1.6}) swatches_.push_back({{x, 1.2, -0.5}, 0.15});
    auto source = input::HidSource::open({}, {.position_m = {0.4, 1.2, 2.0}, .forward = {-0.6, 0.0, -1.0}}, clock_);
    if (!source) throw std::runtime_error(source.error().message);
    wand_thread_ = std::make_unique<input::WandThread>(std::move(*source));
  }

  void frame() {
    wand_ = wand_thread_->newest();
    const auto pointing = selector_.update(wand_, {0.0, 1.65, 2.5}, swatches_);
    hovered_ = pointing.hovered;
    if (pointing.chosen) chosen_ = pointing.chosen;
    navigation_.update(wand_, kFrameS, false);
    std::this_thread::sleep_for(std::chrono::duration<double>(kFrameS));
  }

  void until(const char* what, const std::function<bool()>& done) {
    for (double waited_s = 0.0; !done(); waited_s += kFrameS) {
      if (waited_s > kPatienceS) throw std::runtime_error(std::string("in vain: ") + what);
      frame();
    }
    std::printf("ok: %s\n", what);
  }

  void frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }

  const input::WandState& wand() const { return wand_; }
  std::optional<std::size_t> hovered() const { return hovered_; }
  std::optional<std::size_t> chosen() const { return chosen_; }
  glm::dmat4 place() const { return navigation_.room_from_scene(); }
  double moved_m() const { return glm::length(glm::dvec3(place()[3])); }

 private:
  core::MonotonicClock clock_;
  std::vector<input::Target> swatches_;
  input::Selector selector_;
  input::Navigation navigation_;
  input::WandState wand_;
  std::optional<std::size_t> hovered_;
  std::optional<std::size_t> chosen_;
  std::unique_ptr<input::WandThread> wand_thread_;
};

void require(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(std::string("not so: ") + what);
  std::printf("ok: %s\n", what);
}

void session() {
  Loop loop;
  loop.frames(10);
  require(!loop.wand().connected, "no wand before it is plugged in");

  auto mouse = std::make_unique<VirtualSpaceMouse>(k3Dconnexion, kCompact, "SpaceMouse Compact");
  loop.until("the wand is taken up", [&] { return loop.wand().connected; });
  require(loop.hovered() != kGold, "it does not point at gold yet");
  mouse->push(350, 0, 0);
  loop.until("steered to the right it reaches gold", [&] { return loop.hovered() == kGold; });
  mouse->push(0, 0, 0);
  loop.frames(5);
  mouse->press(1);
  loop.until("a press chooses gold", [&] { return loop.chosen() == kGold; });
  mouse->press(0);
  loop.until("the button is up", [&] { return loop.wand().buttons == 0; });

  mouse->press(2);
  mouse->push(0, 350, 0);
  loop.until("the scene is dragged", [&] { return loop.moved_m() > 0.1; });
  mouse.reset();
  loop.until("unplugged in mid-drag it is gone", [&] { return !loop.wand().connected; });
  require(loop.wand().buttons == 0 && !loop.wand().orientation_valid, "its buttons are up and it points nowhere");
  const glm::dmat4 left = loop.place();
  loop.frames(20);
  require(loop.place() == left, "the scene stays where it was left");

  mouse = std::make_unique<VirtualSpaceMouse>(k3Dconnexion, kCompact, "SpaceMouse Compact");
  loop.until("plugged in again it is taken up", [&] { return loop.wand().connected; });
  require(loop.wand().buttons == 0 && loop.place() == left, "with nothing pressed and nothing moved");
  mouse->press(2);
  mouse->push(0, 350, 0);
  const double before_m = loop.moved_m();
  loop.until("the scene is dragged on", [&] { return loop.moved_m() > before_m + 0.1; });
  mouse->push(0, 0, 0);
  for (const unsigned buttons : {0U, 2U, 0U, 2U}) {
    mouse->press(buttons);
    loop.frames(3);
  }
  loop.until("two quick presses bring it home", [&] { return loop.place() == glm::dmat4(1.0); });

  mouse.reset();
  loop.until("it is unplugged", [&] { return !loop.wand().connected; });
  const VirtualSpaceMouse no_wand(k3Dconnexion, kCadMouse, "CadMouse");
  loop.frames(90);
  require(!loop.wand().connected, "a CadMouse is no wand");
}

}  // namespace

int main() {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  try {
    session();
  } catch (const std::exception& error) {
    std::printf("session failed: %s\n", error.what());
    return 1;
  }
  std::puts("session passed");
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "app/doctor/diagnosis.h"
#include "core/percentiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace afm::app {

namespace {

// Requirements on a well-configured lab machine: no missed tick in a minute, and at most one tick in a thousand later
// than this.
constexpr double kGoodLatenessUs = 200.0;

constexpr const char* kLogInAgain = ", then log in again";

std::string add_rule(const char* file, const std::string& rule) {
  return fmt::format(
      "echo '{}' | sudo tee /etc/udev/rules.d/{} && sudo udevadm control --reload && sudo udevadm trigger", rule, file);
}

std::string join_group(std::string_view groups) {
  return fmt::format("sudo usermod -aG {} \"$(id -un)\"{}", groups, kLogInAgain);
}

Finding priority(const MachineFacts& facts) {
  const int granted = facts.jitter.grant.priority;
  if (granted > 0)
    return {"real-time priority",
            Verdict::Good,
            fmt::format("SCHED_FIFO {} granted: to the servo, its watchdog and a driver's own thread", granted),
            {}};
  return {"real-time priority", Verdict::Limited,
          fmt::format("SCHED_FIFO {} refused: the limit is {}", haptics::kServoPriority, facts.priority_limit),
          haptics::limit_fix("rtprio", "80")};
}

Finding locked_memory(const MachineFacts& facts) {
  const std::string limit = facts.locked_memory_limit_bytes
                                ? fmt::format("limit {} KiB", *facts.locked_memory_limit_bytes / 1024)
                                : std::string("unlimited");
  if (facts.pages_can_be_locked) return {"locked memory", Verdict::Good, "pages can be locked, " + limit, {}};
  return {"locked memory", Verdict::Limited, "pages cannot be locked, " + limit,
          haptics::limit_fix("memlock", "unlimited")};
}

Finding wake_up(const MachineFacts& facts) {
  const SchedulingLatency& jitter = facts.jitter;
  const core::Percentiles late = core::percentiles(jitter.late_us, jitter.max_us);
  const bool good = late.p999 <= kGoodLatenessUs && jitter.missed == 0;
  return {"wake-up at 1 kHz", good ? Verdict::Good : Verdict::Limited,
          fmt::format("late by p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f} \u00b5s; {} of {} ticks missed",
                      late.p50, late.p99, late.p999, late.max, jitter.missed, jitter.ticks + jitter.missed),
          good ? std::string()
               : "close other programs; on Debian, install a real-time kernel: sudo apt install linux-image-rt-amd64"};
}

Finding graphics(const MachineFacts& facts) {
  const auto usable = [](const render::DeviceDescription& d) { return d.usable; };
  const auto gpu = [](const render::DeviceDescription& d) { return d.usable && d.kind != "CPU"; };
  const auto& all = facts.graphics;
  if (const auto best = std::find_if(all.begin(), all.end(), gpu); best != all.end()) {
    return {"graphics", Verdict::Good, fmt::format("{}, {}", best->name, best->driver), {}};
  }
  const auto closed = std::find_if(facts.render_nodes.begin(), facts.render_nodes.end(),
                                   [](const DeviceNode& node) { return !node.accessible; });
  const std::string fix = closed != facts.render_nodes.end()
                              ? join_group("render,video")
                              : "install the Vulkan driver of the GPU; for Intel and AMD: " +
                                    core::install_command(facts.packages, std::array{core::SystemPart::VulkanDriver});
  if (const auto cpu = std::find_if(all.begin(), all.end(), usable); cpu != all.end()) {
    return {"graphics", Verdict::Limited, fmt::format("no GPU: {} renders on the processor", cpu->name), fix};
  }
  return {"graphics", Verdict::Missing,
          all.empty() ? facts.graphics_refusal : fmt::format("{}: {}", all.front().name, all.front().reason), fix};
}

// Finding on the processor's drawing, for machines where the processor draws.
Finding drawing(const MachineFacts& facts) {
  constexpr const char* kCheck = "drawing priority";
  if (!facts.drawing_refused) {
    return {kCheck, Verdict::Good, fmt::format("nice {} granted to the drawing", haptics::kDrawingNice), {}};
  }
  const std::string refused = fmt::format("nice {} refused to the drawing", haptics::kDrawingNice);
  const auto gpu = [](const render::DeviceDescription& d) { return d.usable && d.kind != "CPU"; };
  if (std::any_of(facts.graphics.begin(), facts.graphics.end(), gpu)) {
    return {kCheck, Verdict::Good, refused + ", which a GPU does not need", {}};
  }
  return {kCheck, Verdict::Limited, refused + ": beside busy programs the picture slows down",
          haptics::limit_fix("nice", std::to_string(haptics::kDrawingNice).c_str())};
}

Finding display(const MachineFacts& facts) {
  constexpr const char* kLogIn = "log in to a desktop, or run: export DISPLAY=:0";
  if (facts.display.empty()) {
    return {"display", Verdict::Missing, "none: demo and render work, but view cannot open a window", kLogIn};
  }
  if (!facts.display_refusal.empty()) {
    return {"display", Verdict::Missing, fmt::format("{}: {}", facts.display, facts.display_refusal), kLogIn};
  }
  return {"display", Verdict::Good, facts.display, {}};
}

Finding saver(const MachineFacts& facts) {
  if (facts.display.empty() || !facts.display_refusal.empty()) {
    return {"screen saver", Verdict::Good, "no display to blank", {}};
  }
  if (facts.saver_stays_off) return {"screen saver", Verdict::Good, facts.saver, {}};
  return {"screen saver", Verdict::Limited, facts.saver, "xset s off -dpms"};
}

Finding headset(const MachineFacts& facts) {
  if (facts.headset_manifest.empty()) return {"headset", Verdict::Good, "none needed: no OpenXR runtime found", {}};
  if (!facts.headset.empty()) return {"headset", Verdict::Good, facts.headset, {}};
  if (!facts.headset_manifest_exists)
    return {"headset", Verdict::Limited, facts.headset_refusal, "unset XR_RUNTIME_JSON"};
  return {"headset", Verdict::Limited, facts.headset_refusal,
          fmt::format("connect the headset, and start the runtime of {}", facts.headset_manifest)};
}

Finding hid(const MachineFacts& facts) {
  const auto open =
      std::count_if(facts.hid_nodes.begin(), facts.hid_nodes.end(), [](const auto& n) { return n.accessible; });
  const std::string found = facts.hid_nodes.empty()
                                ? "no HID device is plugged in"
                                : fmt::format("{} of {} HID devices can be opened", open, facts.hid_nodes.size());
  if (open == static_cast<std::ptrdiff_t>(facts.hid_nodes.size())) return {"wands (HID)", Verdict::Good, found, {}};
  return {"wands (HID)", Verdict::Missing, found,
          add_rule("70-touchafm.rules", "KERNEL==\"hidraw*\", TAG+=\"uaccess\"")};
}

Finding haptic_port(const MachineFacts& facts) {
  const haptics::PortRights rights = haptics::judge_rights(facts.haptic_ports);
  constexpr const char* kCheck = "haptic port (USB)";
  if (rights.open) return {kCheck, Verdict::Good, rights.said, {}};
  return {kCheck, Verdict::Missing, rights.said,
          rights.group.empty() ? add_rule("70-touchafm-haptics.rules", rights.udev_rule) : join_group(rights.group)};
}

Finding haptic_device(const MachineFacts& facts) {
  std::optional<Finding> silent;
  for (const haptics::DeviceKind& kind : haptics::device_kinds()) {
    const auto line = std::find_if(facts.haptics.begin(), facts.haptics.end(),
                                   [&](const haptics::ProbeLine& tried) { return tried.subject == kind.subject; });
    if (line == facts.haptics.end()) continue;
    if (line->usable && kind.renders_force) return {"haptic device", Verdict::Good, line->said, {}};
    if (!line->usable && !kind.remedy.empty() && !silent) {
      silent = Finding{"haptic device", Verdict::Limited, line->said, std::string(kind.remedy)};
    }
  }
  if (silent) return *silent;
  const std::string plugged = facts.haptic_ports.empty() ? "" : facts.haptic_ports.front().device;
  return {
      "haptic device", Verdict::Limited,
      fmt::format("no driver is installed: a simulated hand is used instead{}",
                  plugged.empty() ? "" : fmt::format(", although a {} is plugged in", plugged)),
      fmt::format("install the driver of the device (OpenHaptics for a PHANTOM or Touch, a HID one too), or set {} or "
                  "{} to the path of its library (touchafm devices lists what was tried)",
                  haptics::kHdLibraryVariable, haptics::kFdLibraryVariable)};
}

Finding system_packages(const MachineFacts& facts) {
  constexpr const char* kCheck = "system packages";
  if (facts.missing_parts.empty()) return {kCheck, Verdict::Good, "all that TouchAFM can use", {}};
  std::vector<std::string_view> names;
  names.reserve(facts.missing_parts.size());
  for (const core::SystemPart part : facts.missing_parts) names.push_back(core::description_of(part));
  return {kCheck, Verdict::Limited, fmt::format("missing: {}", fmt::join(names, "; ")),
          core::install_command(facts.packages, facts.missing_parts)};
}

Finding servo_program(const MachineFacts& facts) {
  if (facts.missing_program.empty()) return {"servo program", Verdict::Good, facts.servo_program, {}};
  return {
      "servo program", Verdict::Missing, facts.missing_program + " does not exist or cannot be run",
      "reinstall touchafm, or build the targets touchafm-servo and touchafm-guard: its programs belong in one folder"};
}

}  // namespace

std::vector<Finding> diagnose(const MachineFacts& facts) {
  return {{"kernel", Verdict::Good, facts.kernel, {}},
          priority(facts),
          locked_memory(facts),
          wake_up(facts),
          servo_program(facts),
          system_packages(facts),
          graphics(facts),
          drawing(facts),
          display(facts),
          saver(facts),
          headset(facts),
          haptic_device(facts),
          haptic_port(facts),
          hid(facts)};
}

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::Good:
      return "good";
    case Verdict::Limited:
      return "limited";
    case Verdict::Missing:
      break;
  }
  return "missing";
}

}  // namespace afm::app

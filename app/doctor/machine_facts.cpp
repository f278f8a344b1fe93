// SPDX-License-Identifier: Apache-2.0
#include "app/doctor/machine_facts.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "app/headset/headset_runtime.h"
#include "app/view/speech_choice.h"
#include "render/saver_inhibition.h"
#include "render/window.h"
#include "servo/haptic_choice.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

std::string kernel() {
  utsname name{};
  if (::uname(&name) != 0) return "unknown";
  const std::string_view version = name.version;
  std::string text = name.release;
  for (const char* kind : {"PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT"}) {
    if (version.find(kind) == std::string_view::npos) continue;
    return text + ", " + kind;
  }
  return text + ", not preemptible";
}

std::uint64_t limit(__rlimit_resource resource) {
  rlimit value{};
  return ::getrlimit(resource, &value) == 0 ? value.rlim_cur : 0;
}

bool lock_pages() {
  const bool locked = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  ::munlockall();
  return locked;
}

std::vector<DeviceNode> nodes(const std::string& folder, std::string_view prefix) {
  std::vector<DeviceNode> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (!entry.path().filename().string().starts_with(prefix)) continue;
    const std::string path = entry.path().string();
    found.push_back({path, ::access(path.c_str(), R_OK | W_OK) == 0});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return found;
}

std::string display() {
  std::string names;
  for (const char* name : {"WAYLAND_DISPLAY", "DISPLAY"}) {
    const char* value = ::secure_getenv(name);
    if (value != nullptr && *value != '\0') names += fmt::format("{}{}={}", names.empty() ? "" : ", ", name, value);
  }
  return names;
}

// Parts that this machine lacks; an OpenXR loader only if a headset's runtime is installed.
std::vector<core::SystemPart> missing_parts(bool has_headset_runtime) {
  std::vector<core::SystemPart> parts = core::parts_without_libraries();
  if (!has_headset_runtime) std::erase(parts, core::SystemPart::OpenXrLoader);
  if (!choose_speech_program("en")) parts.push_back(core::SystemPart::EspeakNg);
  return parts;
}

}  // namespace

MachineFacts look_at_machine(const core::Clock& clock, const std::string& program, double jitter_seconds) {
  MachineFacts facts;
  facts.kernel = kernel();
  facts.priority_limit = limit(RLIMIT_RTPRIO);
  if (const std::uint64_t bytes = limit(RLIMIT_MEMLOCK); bytes != RLIM_INFINITY)
    facts.locked_memory_limit_bytes = bytes;
  facts.pages_can_be_locked = lock_pages();
  facts.jitter = measure_wake_jitter(clock, servo::kServoRateHz, jitter_seconds);
  facts.drawing_refused = !haptics::favour_drawing();

  if (const auto graphics = render::list_devices()) {
    facts.graphics = *graphics;
  } else {
    facts.graphics_refusal = graphics.error().message;
  }
  facts.display = display();
  if (!facts.display.empty()) {
    const render::SaverInhibition saver;  // open connection, which keeps a server alive that ends with its last client
    facts.saver = fmt::format("X's screen saver: {}; org.freedesktop.ScreenSaver: {}", saver.x_server().said,
                              saver.session().said);
    facts.saver_stays_off = saver.works();
    if (const auto checked = render::check_display(); !checked) facts.display_refusal = checked.error().message;
  }
  facts.headset_manifest = headset_manifest();
  if (!facts.headset_manifest.empty()) {
    facts.headset_manifest_exists = ::access(facts.headset_manifest.c_str(), F_OK) == 0;
    const auto headset = find_headset();
    facts.headset = headset ? text_of(*headset) : "";
    facts.headset_refusal = headset ? "" : headset.error().message;
  }
  facts.render_nodes = nodes("/dev/dri", "renderD");
  facts.hid_nodes = nodes("/dev", "hidraw");
  facts.haptic_ports = haptics::find_haptic_ports();
  facts.haptics = haptics::probe_devices(servo::environment());

  facts.packages = core::package_system_of(core::read_os_release());
  facts.missing_parts = missing_parts(!facts.headset_manifest.empty());

  facts.servo_program = std::filesystem::path(program).replace_filename("touchafm-servo").string();
  for (const char* name : {"touchafm-guard", "touchafm-servo"}) {
    const std::string path = std::filesystem::path(program).replace_filename(name).string();
    if (::access(path.c_str(), X_OK) != 0) facts.missing_program = path;
  }
  return facts;
}

}  // namespace afm::app

// SPDX-License-Identifier: Apache-2.0
#include "app/doctor/fault_bundle.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <utility>
#include <vector>

#include "app/doctor/private_words.h"
#include "core/printable.h"
#include "core/version.h"

namespace afm::app {

namespace {

// Value in the first line of the file that begins with `key`, without quotes.
std::string line_of(const char* path, std::string_view key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    std::string value = line.substr(std::min(line.find_first_of("=:") + 1, line.size()));
    std::erase(value, '"');
    value.erase(0, std::min(value.find_first_not_of(" \t"), value.size()));
    return core::printable(value);
  }
  return "unknown";
}

std::string nodes_text(const char* what, const std::vector<DeviceNode>& nodes) {
  std::string text;
  for (const DeviceNode& node : nodes) {
    text += fmt::format("{} {}: {}\n", what, node.path, node.accessible ? "accessible" : "not accessible");
  }
  return text;
}

// Names of the devices that were found, as printed before the figures in each line.
std::vector<std::string> names_of(const std::vector<haptics::ProbeLine>& lines) {
  std::vector<std::string> names;
  for (const haptics::ProbeLine& line : lines) {
    const std::string said = core::printable(line.said);
    const std::size_t end = said.find(": ");
    if (line.usable && end != std::string::npos && end > 0) names.push_back(said.substr(0, end));
  }
  return names;
}

}  // namespace

std::string fault_bundle(const MachineFacts& facts, const std::string& findings) {
  utsname machine{};
  ::uname(&machine);
  std::string text = fmt::format(
      "TouchAFM fault report\n"
      "=====================\n\n"
      "Please add: what you did, what you saw, what you expected, and everything that touchafm printed.\n"
      "This report leaves out the names of people and computers, of folders that are not the system's, and of devices "
      "beyond their model. Read it before you send it.\n\n");
  text += fmt::format("touchafm {}\ncompiler: {}\nsystem: {}, {}\nkernel: {}\nprocessor: {}, {} in use\nmemory: {}\n",
                      core::kVersion, __VERSION__, line_of("/etc/os-release", "PRETTY_NAME"), machine.machine,
                      facts.kernel, line_of("/proc/cpuinfo", "model name"), ::sysconf(_SC_NPROCESSORS_ONLN),
                      line_of("/proc/meminfo", "MemTotal"));
  text += fmt::format("display: {}\n\nGraphics\n--------\n", facts.display.empty() ? "none" : facts.display);
  for (const render::DeviceDescription& device : facts.graphics) {
    text += fmt::format("{}: {}, {}; {}\n", device.name, device.kind, device.driver,
                        device.usable ? "usable" : device.reason);
  }
  if (!facts.graphics_refusal.empty()) text += facts.graphics_refusal + "\n";
  text += "\nDevices\n-------\n" + nodes_text("graphics", facts.render_nodes) + nodes_text("HID", facts.hid_nodes) +
          fmt::format("haptic ports: {}\n", haptics::judge_rights(facts.haptic_ports).said);
  for (const haptics::ProbeLine& line : facts.haptics) {
    text += fmt::format("haptic {}: {}; {}\n", line.subject, line.usable ? "usable" : "not usable",
                        core::printable(line.said));
  }
  text += "\nFindings of touchafm doctor\n---------------------------\n" + findings;
  for (const std::string& name : names_of(facts.haptics)) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at)) {
      const std::string model = model_of(name);
      text.replace(at, name.size(), model);
      at += model.size();
    }
  }
  return without(private_words(), std::move(text));
}

}  // namespace afm::app

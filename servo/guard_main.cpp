// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <string_view>

#include "core/exit_code.h"
#include "core/file_descriptor.h"
#include "core/log.h"
#include "core/run_main.h"
#include "scene/shared/shared_segment.h"
#include "servo/watchdog.h"

// touchafm-guard: the watchdog of one servo, which starts it.
namespace {

using afm::core::ExitCode;

// The number of a descriptor after its option, or -1.
int descriptor_after(std::string_view option, int count, char** arguments) {
  for (int i = 1; i + 1 < count; i += 2) {
    if (arguments[i] != option) continue;
    const std::string_view text = arguments[i + 1];
    int number = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? number : -1;
  }
  return -1;
}

}  // namespace

int main(int count, char** arguments) {
  const int segment_number = descriptor_after("--segment", count, arguments);
  const int servo_number = descriptor_after("--watch-servo", count, arguments);
  if (segment_number < 0 || servo_number < 0) {
    afm::core::log_line("touchafm-servo starts this program; run 'touchafm demo --out DIR' instead");
    return static_cast<int>(ExitCode::WrongUsage);
  }
  return afm::core::report_exceptions([&] {
    const afm::core::FileDescriptor servo(servo_number);
    auto segment = afm::scene::SharedSegment::attach(afm::core::FileDescriptor(segment_number));
    if (!segment) return static_cast<int>(ExitCode::RunFailed);  // the servo fails for the same reason, and reports it
    afm::servo::watch_servo(servo, *segment);
    return static_cast<int>(ExitCode::Done);
  });
}

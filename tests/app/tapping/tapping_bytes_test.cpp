// SPDX-License-Identifier: Apache-2.0
// Invariant: tapping curves, sweeps and images have the same bytes for a seed, on one core and on all
#include <gtest/gtest.h>
#include <sched.h>

#include <string>
#include <vector>

#include "app/commands/scan_command.h"
#include "app/tapping/tapping_command.h"
#include "core/whole_file.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace tapping_bytes_test {

// Restricts this thread and those that it starts to one core during the object's lifetime.
class OneCore {
 public:
  OneCore() {
    ::sched_getaffinity(0, sizeof all_, &all_);
    int first = 0;
    while (!CPU_ISSET(static_cast<unsigned>(first), &all_)) ++first;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<unsigned>(first), &one);
    ::sched_setaffinity(0, sizeof one, &one);
  }
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;
  ~OneCore() { ::sched_setaffinity(0, sizeof all_, &all_); }

 private:
  cpu_set_t all_;
};

curves::ContactOptions contact(const char* quality_factor) {
  curves::ContactOptions options;
  options.assets_dir = support::source("assets");
  options.model = "dmt";
  options.values = {{"tip-radius", "20nm"},        {"spring-constant", "40N/m"}, {"hamaker", "64zJ"},
                    {"reduced-modulus", "1.5GPa"}, {"resonance", "300kHz"},      {"quality-factor", quality_factor}};
  return options;
}

curves::TappingChoice choice() {
  curves::TappingChoice chosen;
  chosen.mode = "tapping";
  chosen.numbers.free_amplitude = "20nm";
  chosen.contact_gap = "0.165nm";
  return chosen;
}

std::string sweep() {
  const std::vector<std::string> axes{"free-amplitude=8nm:24nm:3", "z=6nm:26nm:7"};
  return tapping_sweep_text(choice(), contact("400"), axes, "json").value();
}
std::string slow_curve() { return tapping_text(choice(), contact("400"), {}, "json").value(); }
std::string direct_curve() {
  curves::PathOptions path;
  path.from = "20nm";
  path.to = "16nm";
  path.step = "0.5nm";
  curves::TappingChoice direct = choice();
  direct.numbers.method = "direct";
  return tapping_text(direct, contact("50"), path, "csv").value();
}

std::string image(std::uint32_t seed) {
  const support::ScratchFolder folder;
  ScanOptions options;
  options.contact = contact("400");
  options.contact.material = "mica";
  options.contact.values.erase("reduced-modulus");
  options.tapping.mode = "tapping";
  options.tapping.numbers.free_amplitude = "20nm";
  options.amplitude_setpoint = "0.8";
  options.pixels = 16;
  options.seed = seed;
  for (const physics::ScanField& field : physics::kScanFields) {
    if (field.name == "noise") options.settings.emplace_back(&field, 0.1e-9);
  }
  options.out = folder.file("image.gwy");
  if (const auto done = write_scan_command(options); !done) return done.error().message;
  return core::read_file(options.out).value();
}

struct Output {
  const char* name;
  std::string (*bytes)();
};
constexpr Output kOutputs[] = {
    {"sweep", sweep}, {"slow curve", slow_curve}, {"direct curve", direct_curve}, {"image", [] { return image(7); }}};

TEST(TappingBytes, AreTheSameOnOneCoreAndOnAll) {
  for (const Output& output : kOutputs) {
    const std::string on_all = output.bytes();
    ASSERT_GT(on_all.size(), 200U) << output.name << ": " << on_all;
    const OneCore one;  // one thread of a sweep
    EXPECT_TRUE(output.bytes() == on_all) << output.name;
  }
}

TEST(TappingBytes, OfAnImageFollowItsSeed) { EXPECT_FALSE(image(7) == image(8)); }

}  // namespace tapping_bytes_test
}  // namespace afm::app

// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>
#include <vector>

#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "input/wand_file.h"

// Whatever the bytes: a wand file, whose device then reads any report, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace afm::input;
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto wand = load_wand_file(file.path());
  if (!wand) return 0;
  ++afm::fuzz::accepted_inputs;
  if (!wand->device) return 0;
  const auto driver = mapped_driver(*wand->device);
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{64}, std::size_t{1024}}) {
    std::vector<std::uint8_t> report(length, 0xA5);
    if (!report.empty()) report[0] = wand->device->axes.front().report;
    const auto input = driver->read(report);
    if (input && input->push && !(std::abs(input->push->x) <= 1.0)) std::abort();
  }
  return 0;
}

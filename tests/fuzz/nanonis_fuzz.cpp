// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <string_view>

#include "fuzz/accepted.h"
#include "instrument/nanonis_door.h"
#include "instrument/simulated_instrument.h"
#include "support/places.h"

// Whatever the bytes: requests are cut from them within their size, and each that wants an answer gets one, with a
// header that has its size.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  // a reset would compute its sample anew for each input
  static const auto fresh = afm::instrument::SimulatedInstrument::create(afm::support::source("assets"), 1).value();
  auto instrument = fresh;
  afm::instrument::NanonisDoor door(instrument);
  std::string_view rest(reinterpret_cast<const char*>(bytes), size);
  while (const auto whole = door.request_size(rest)) {
    if (*whole > rest.size() || *whole == 0) std::abort();
    const std::string_view request = rest.substr(0, *whole);
    rest.remove_prefix(*whole);
    // a scan of the size that a fuzzer likes best takes a minute
    if (request.starts_with("Scan.Action")) continue;
    door.answer(request, [](std::string_view answer) {
      constexpr std::size_t kHeader = 40, kLeast = kHeader + 8;
      if (answer.size() < kLeast) std::abort();
      std::size_t body = 0;
      for (const char byte : answer.substr(32, 4)) body = (body << 8U) | static_cast<unsigned char>(byte);
      if (body != answer.size() - kHeader) std::abort();
      if (answer.ends_with(std::string_view("\0\0\0\0\0\0\0\0", 8))) ++afm::fuzz::accepted_inputs;
      return true;
    });
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "fuzz/memory_file.h"
#include "servo/session_file.h"

namespace {

// The checksum would hide all the rest: the last eight bytes are replaced by the right one.
std::vector<std::uint8_t> with_checksum(const std::uint8_t* bytes, std::size_t size) {
  std::vector<std::uint8_t> file(bytes, bytes + size);
  if (size < sizeof(std::uint64_t)) return file;
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (std::size_t i = 0; i < size - sizeof(hash); ++i) hash = (hash ^ file[i]) * 0x100000001b3ULL;
  std::memcpy(file.data() + size - sizeof(hash), &hash, sizeof(hash));
  return file;
}

}  // namespace

// Whatever the bytes: a session of finite numbers, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::vector<std::uint8_t> whole = with_checksum(bytes, size);
  const afm::fuzz::MemoryFile file(whole.data(), whole.size());
  const auto session = afm::servo::load_session(file.path());
  if (!session) return 0;
  if (session->samples.empty()) std::abort();
  for (const afm::scene::TipSample& sample : session->samples) {
    if (!std::isfinite(sample.tip.z_m) || !std::isfinite(sample.tip.force_n)) std::abort();
  }
  return 0;
}

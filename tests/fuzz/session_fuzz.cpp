// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "core/fnv1a.h"
#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "servo/session_file.h"

namespace {

constexpr std::size_t kSumBytes = sizeof(std::uint64_t);

std::uint64_t sum_of(const std::vector<std::uint8_t>& file, std::size_t end) {
  afm::core::Fnv1a hash;
  for (std::size_t i = 0; i < end; ++i) hash.add(file[i]);
  return hash.value();
}

void put_sum(std::vector<std::uint8_t>& file, std::size_t at) {
  const std::uint64_t sum = sum_of(file, at);
  std::memcpy(file.data() + at, &sum, kSumBytes);
}

// The checksums would hide all the rest: they are replaced by the right ones. Of version 3 there is one, at the end; a
// later one has two in each chunk.
std::vector<std::uint8_t> with_checksums(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::size_t kFront = 8;
  std::vector<std::uint8_t> file(bytes, bytes + size);
  if (size < kFront + kSumBytes) return file;
  if (file[4] == 3) {
    put_sum(file, size - kSumBytes);
    return file;
  }
  for (std::size_t at = kFront; at + 2 * kSumBytes <= size;) {
    std::uint32_t payload = 0;
    std::memcpy(&payload, file.data() + at + 4, sizeof(payload));
    put_sum(file, at + kFront);
    at += kFront + kSumBytes;
    if (payload > size - at || size - at - payload < kSumBytes) break;
    put_sum(file, at + payload);
    at += payload + kSumBytes;
  }
  return file;
}

}  // namespace

// Whatever the bytes: a session of finite numbers, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::vector<std::uint8_t> whole = with_checksums(bytes, size);
  const afm::fuzz::MemoryFile file(whole.data(), whole.size());
  const auto session = afm::servo::load_session(file.path());
  if (!session) return 0;
  ++afm::fuzz::accepted_inputs;
  if (session->samples.empty()) std::abort();
  for (const afm::scene::TipSample& sample : session->samples) {
    if (!std::isfinite(sample.tip.z_m) || !std::isfinite(sample.tip.force_n)) std::abort();
  }
  return 0;
}

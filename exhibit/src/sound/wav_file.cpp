// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/wav_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/written_by.h"
#include "exhibit/sound/stream_clock.h"

namespace afm::exhibit {

namespace {

constexpr std::size_t kSampleBytes = 2, kChannels = 2;
constexpr std::uint32_t kPcm = 1;
constexpr std::size_t kFormatBytes = 16, kChunkHead = 8, kFirstChunk = 12;
constexpr float kFullScale = 32767.0F;
constexpr int kSlowestHz = 4'000, kFastestHz = 192'000;

void put(std::string& bytes, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
}

std::uint32_t get(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return value;
}

// Chunk with the name of the program, as read by players.
std::string info_chunk() {
  std::string name = core::written_by();
  name.resize(name.size() + 2 - name.size() % 2);  // zero at the end, even length
  std::string chunk = "LIST";
  put(chunk, static_cast<std::uint32_t>(name.size() + 12), 4);
  chunk += "INFOISFT";
  put(chunk, static_cast<std::uint32_t>(name.size()), 4);
  return chunk + name;
}

}  // namespace

std::string wav_bytes(std::span<const float> interleaved) {
  const std::string info = info_chunk();
  const auto size = static_cast<std::uint32_t>(interleaved.size() * kSampleBytes);
  constexpr std::uint32_t kFrameBytes = kSampleBytes * kChannels;
  std::string bytes = "RIFF";
  put(bytes, static_cast<std::uint32_t>(size + 36 + info.size()), 4);
  bytes += "WAVEfmt ";
  put(bytes, kFormatBytes, 4);
  put(bytes, kPcm, 2);
  put(bytes, kChannels, 2);
  put(bytes, kSoundRateHz, 4);
  put(bytes, kSoundRateHz * kFrameBytes, 4);
  put(bytes, kFrameBytes, 2);
  put(bytes, 8 * kSampleBytes, 2);
  bytes += "data";
  put(bytes, size, 4);
  bytes.reserve(bytes.size() + size + info.size());
  for (const float sample : interleaved) {
    const auto value = static_cast<std::int16_t>(std::lround(kFullScale * std::clamp(sample, -1.0F, 1.0F)));
    put(bytes, static_cast<std::uint16_t>(value), kSampleBytes);
  }
  return bytes + info;
}

std::optional<MonoWav> parse_mono_wav(std::string_view bytes) {
  if (bytes.size() < kFirstChunk || !bytes.starts_with("RIFF") || bytes.substr(8, 4) != "WAVE") return std::nullopt;
  MonoWav wav;
  for (std::size_t at = kFirstChunk; at + kChunkHead <= bytes.size();) {
    const std::string_view name = bytes.substr(at, 4);
    const std::size_t size = get(bytes, at + 4, 4), begin = at + kChunkHead, rest = bytes.size() - begin;
    if (name == "fmt " && size >= kFormatBytes && rest >= kFormatBytes) {
      const bool known = get(bytes, begin, 2) == kPcm && get(bytes, begin + 2, 2) == 1 &&
                         get(bytes, begin + 14, 2) == 8 * kSampleBytes;
      const std::uint32_t rate = get(bytes, begin + 4, 4);
      if (!known || rate < kSlowestHz || rate > kFastestHz) return std::nullopt;
      wav.rate_hz = static_cast<int>(rate);
    }
    if (name == "data") {
      if (wav.rate_hz == 0) return std::nullopt;
      const std::size_t count = std::min(size, rest) / kSampleBytes;
      wav.samples.reserve(count);
      for (std::size_t i = 0; i < count; ++i) {
        const auto value = static_cast<std::int16_t>(get(bytes, begin + i * kSampleBytes, kSampleBytes));
        wav.samples.push_back(static_cast<float>(value) / kFullScale);
      }
      return wav;
    }
    if (size > rest) return std::nullopt;
    at = begin + size + size % 2;
  }
  return std::nullopt;
}

std::vector<float> resampled(const MonoWav& wav, int rate_hz) {
  if (wav.samples.empty()) return {};
  const double step = static_cast<double>(wav.rate_hz) / rate_hz;
  const auto count = static_cast<std::size_t>(static_cast<double>(wav.samples.size()) / step);
  std::vector<float> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double place = static_cast<double>(i) * step;
    const auto before = std::min(static_cast<std::size_t>(place), wav.samples.size() - 1);
    const std::size_t after = std::min(before + 1, wav.samples.size() - 1);
    const auto share = static_cast<float>(place - static_cast<double>(before));
    out[i] = wav.samples[before] + share * (wav.samples[after] - wav.samples[before]);
  }
  return out;
}

}  // namespace afm::exhibit

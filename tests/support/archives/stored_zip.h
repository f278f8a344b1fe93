// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace afm::test {

inline std::uint32_t crc32_of(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ (0xEDB88320U & (0U - (crc & 1U)));
  }
  return ~crc;
}

// Marking of packed entries, and their packer.
struct ZipPacking {
  std::uint16_t method = 0;
  std::string (*pack)(std::string_view content) = nullptr;
};

// A zip archive of entries that are not compressed unless `packing` does so. With `claimed_size` each entry claims
// this unpacked size.
inline std::string stored_zip(const std::map<std::string, std::string>& entries,
                              std::optional<std::uint32_t> claimed_size = {}, const ZipPacking& packing = {}) {
  std::string archive, directory;
  const auto put = [](std::string& to, int size, std::uint64_t value) {
    for (int i = 0; i < size; ++i) to.push_back(static_cast<char>(value >> (8 * i)));
  };
  for (const auto& [name, content] : entries) {
    const std::size_t offset = archive.size();
    const std::string packed = packing.pack != nullptr ? packing.pack(content) : content;
    const auto put_description = [&](std::string& to) {
      put(to, 2, 20);  // version
      put(to, 2, 0);   // flags
      put(to, 2, packing.method);
      put(to, 4, 0);  // time
      put(to, 4, crc32_of(content));
      put(to, 4, packed.size());
      put(to, 4, claimed_size ? *claimed_size : content.size());
      put(to, 2, name.size());
      put(to, 2, 0);  // extra
    };
    archive += "PK\x03\x04";
    put_description(archive);
    archive += name + packed;
    directory += "PK\x01\x02";
    put(directory, 2, 20);
    put_description(directory);
    put(directory, 2, 0);  // size of the comment
    put(directory, 8, 0);  // disk and attributes
    put(directory, 4, offset);
    directory += name;
  }
  const std::size_t start = archive.size();
  archive += directory + "PK\x05\x06";
  put(archive, 4, 0);
  put(archive, 2, entries.size());
  put(archive, 2, entries.size());
  put(archive, 4, directory.size());
  put(archive, 4, start);
  put(archive, 2, 0);
  return archive;
}

}  // namespace afm::test

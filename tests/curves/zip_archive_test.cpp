// SPDX-License-Identifier: Apache-2.0
#include "bytes/zip_archive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <map>
#include <string>

#include "curves/curve_error.h"
#include "support/archives/stored_zip.h"

namespace afm::curves {
namespace zip_archive_test {

using testing::HasSubstr;

constexpr std::size_t kMost = 1 << 20;

// Compressed as in a zip archive, without zlib's own header.
std::string deflated(std::string_view content) {
  z_stream stream{};
  EXPECT_EQ(::deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(::deflateBound(&stream, content.size()), '\0');
  std::string copy(content);
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(::deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  ::deflateEnd(&stream);
  return packed;
}

constexpr test::ZipPacking kDeflated{8, deflated};

std::string reason(const std::string& bytes, const std::string& name, std::size_t most = kMost) {
  try {
    ZipArchive(bytes).entry(name, most);
    return "";
  } catch (const CurveError& fault) {
    return fault.what();
  }
}

std::map<std::string, std::string> many_entries(std::size_t count) {
  std::map<std::string, std::string> entries{{"empty", ""}};
  for (std::size_t i = 0; i < count; ++i) {
    entries["index/" + std::to_string(i) + "/a.dat"] = std::string(i % 300, 'a') + std::to_string(i);
  }
  return entries;
}

TEST(ZipArchive, HasEachOfManyEntries) {
  const auto entries = many_entries(5000);
  for (const std::string& bytes : {test::stored_zip(entries), test::stored_zip(entries, {}, kDeflated)}) {
    const ZipArchive archive(bytes);
    for (const auto& [name, content] : entries) ASSERT_EQ(archive.entry(name, kMost), content) << name;
    EXPECT_FALSE(archive.holds("index/5000/a.dat"));
    EXPECT_FALSE(archive.holds(""));
    EXPECT_THAT(reason(bytes, "index/5000/a.dat"), HasSubstr("has no \"index/5000/a.dat\""));
  }
}

// Two entries have one name; the search for it begins where another entry was found.
TEST(ZipArchive, HasTheFirstOfTwoEntriesOfOneName) {
  std::string bytes = test::stored_zip({{"a", "first"}, {"b", "second"}, {"c", "third"}});
  for (std::size_t at = bytes.find('c'); at != std::string::npos; at = bytes.find('c', at + 1)) {
    if (bytes.substr(at, 6) == "cthird" || bytes.substr(at, 3) == "cPK") bytes[at] = 'a';
  }
  const ZipArchive archive(bytes);
  EXPECT_EQ(archive.entry("b", kMost), "second");
  EXPECT_EQ(archive.entry("a", kMost), "first");
  EXPECT_EQ(archive.entry("a", kMost), "first");
  EXPECT_FALSE(archive.holds("c"));
}

TEST(ZipArchive, BehindOtherBytesIsTheSame) {
  const auto entries = many_entries(20);
  const std::string bytes =
      std::string("PK\x03\x04") + std::string(100, ' ') + test::stored_zip(entries, {}, kDeflated);
  const ZipArchive archive(bytes);
  for (const auto& [name, content] : entries) EXPECT_EQ(archive.entry(name, kMost), content) << name;
}

TEST(ZipArchive, RefusesAnEntryThatIsNotWhatItSays) {
  const std::map<std::string, std::string> entries{{"a", std::string(1000, 'x') + "end"}};
  const std::string whole = test::stored_zip(entries, {}, kDeflated);
  EXPECT_EQ(reason(whole, "a"), "");
  EXPECT_THAT(reason(whole, "a", 100), HasSubstr("\"a\" in its archive is too large"));
  for (const std::uint32_t claimed : {1002U, 1004U, 0U}) {
    EXPECT_THAT(reason(test::stored_zip(entries, claimed, kDeflated), "a"),
                HasSubstr("\"a\" in its archive is damaged"))
        << claimed;
  }
  constexpr std::size_t kContent = 31;  // offset after the local header and the name
  for (std::size_t at = kContent; at < kContent + 8; ++at) {
    std::string damaged(whole);
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    EXPECT_THAT(reason(damaged, "a"), HasSubstr("\"a\" in its archive is damaged")) << at;
  }
  // a checksum of another content
  std::string other = test::stored_zip({{"a", "one"}});
  other[other.find("one")] = 'x';
  EXPECT_THAT(reason(other, "a"), HasSubstr("\"a\" in its archive is damaged"));
  // an unknown method of compression
  EXPECT_THAT(reason(test::stored_zip(entries, {}, {99, nullptr}), "a"), HasSubstr("\"a\" in its archive is damaged"));
}

// Every byte of the headers changed in turn: the archive is read, or refused in one line.
TEST(ZipArchive, WithAnyByteChangedIsReadOrRefused) {
  const std::map<std::string, std::string> entries{{"a", "first"}, {"b", std::string(500, 'y')}};
  const std::string whole = test::stored_zip(entries, {}, kDeflated);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char byte : {'\x00', '\x7f', '\xff'}) {
      std::string damaged(whole);
      damaged[at] = byte;
      try {
        const ZipArchive archive(damaged);
        for (const auto& [name, content] : entries) {
          if (!archive.holds(name)) continue;
          EXPECT_EQ(archive.entry(name, kMost), content) << at;
        }
      } catch (const CurveError& fault) {
        EXPECT_FALSE(std::string(fault.what()).empty());
      }
    }
  }
}

}  // namespace zip_archive_test
}  // namespace afm::curves

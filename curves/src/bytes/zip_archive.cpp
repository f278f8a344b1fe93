// SPDX-License-Identifier: Apache-2.0
#include "bytes/zip_archive.h"

#include <fmt/format.h>
#include <ioapi.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <string_view>

#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr std::size_t kLongestName = 1024;

// Name of the archive's current entry; empty if it cannot be read.
std::string_view name_of_entry(unzFile archive, std::array<char, kLongestName>& name) {
  name.fill('\0');
  // a longer name is cut off without a terminating zero
  const int read = unzGetCurrentFileInfo64(archive, nullptr, name.data(), name.size() - 1, nullptr, 0, nullptr, 0);
  return read == UNZ_OK ? std::string_view(name.data()) : std::string_view();
}

// Headers of the central directory (APPNOTE 4.3.12): minizip reads each of their numbers by a call, which takes seconds
// for a map of half a million entries.
constexpr std::size_t kHeader = 46;
constexpr std::string_view kSignature = "PK\x01\x02";

std::size_t number_of_two(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]) + 256U * static_cast<unsigned char>(bytes[at + 1]);
}

// The header that begins there; empty if none does.
std::string_view header_at(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < kHeader || bytes.substr(at, kSignature.size()) != kSignature) return {};
  const std::size_t size =
      kHeader + number_of_two(bytes, at + 28) + number_of_two(bytes, at + 30) + number_of_two(bytes, at + 32);
  return size <= bytes.size() - at ? bytes.substr(at, size) : std::string_view();
}

// As minizip's: without what follows a zero or is too long.
std::string_view name_in(std::string_view header) {
  const std::string_view name = header.substr(kHeader, std::min(number_of_two(header, 28), kLongestName - 1));
  return name.substr(0, name.find('\0'));
}

}  // namespace

// minizip's access to a file: the stream is the archive's cursor.
struct ZipCallbacks {
  using Cursor = ZipArchive::Cursor;

  static voidpf open(voidpf /*opaque*/, const void* cursor, int /*mode*/) { return const_cast<void*>(cursor); }
  static uLong read(voidpf /*opaque*/, voidpf stream, void* to, uLong size) {
    Cursor& cursor = *static_cast<Cursor*>(stream);
    const std::size_t count = std::min<std::size_t>(size, cursor.bytes.size() - cursor.at);
    std::memcpy(to, cursor.bytes.data() + cursor.at, count);
    cursor.at += count;
    return count;
  }
  static uLong write(voidpf /*opaque*/, voidpf /*stream*/, const void* /*from*/, uLong /*size*/) { return 0; }
  static ZPOS64_T tell(voidpf /*opaque*/, voidpf stream) { return static_cast<Cursor*>(stream)->at; }
  static long seek(voidpf /*opaque*/, voidpf stream, ZPOS64_T offset, int origin) {
    Cursor& cursor = *static_cast<Cursor*>(stream);
    const ZPOS64_T from = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                          : origin == ZLIB_FILEFUNC_SEEK_CUR ? cursor.at
                                                             : cursor.bytes.size();
    if (offset > cursor.bytes.size() - from) return -1;  // minizip never goes back from the end or where it reads
    cursor.at = from + offset;
    return 0;
  }
  static int close(voidpf /*opaque*/, voidpf /*stream*/) { return 0; }
  static int error(voidpf /*opaque*/, voidpf /*stream*/) { return 0; }
};

ZipArchive::ZipArchive(std::string_view bytes, const std::function<void(std::string_view name)>& see)
    : cursor_(std::make_unique<Cursor>(Cursor{bytes, 0})), archive_(nullptr, &unzClose) {
  zlib_filefunc64_def access{&ZipCallbacks::open, &ZipCallbacks::read,  &ZipCallbacks::write, &ZipCallbacks::tell,
                             &ZipCallbacks::seek, &ZipCallbacks::close, &ZipCallbacks::error, nullptr};
  archive_.reset(unzOpen2_64(cursor_.get(), &access));
  if (!archive_) throw CurveError("its zip archive is damaged");
  const auto add = [&](std::string_view name, const unz64_file_pos& at) {
    if (name.empty()) return;
    places_.push_back({std::hash<std::string_view>()(name), at});
    if (see) see(name);
  };
  unz64_file_pos at{};
  unz_global_info64 about{};
  if (unzGoToFirstFile(archive_.get()) == UNZ_OK && unzGetFilePos64(archive_.get(), &at) == UNZ_OK &&
      unzGetGlobalInfo64(archive_.get(), &about) == UNZ_OK) {
    // 0xffff: perhaps more entries than the field can count; the last header ends the walk
    const ZPOS64_T count = about.number_entry == 0xffff ? bytes.size() : about.number_entry;
    for (; at.num_of_file < count; ++at.num_of_file) {
      const std::string_view header = header_at(bytes, at.pos_in_zip_directory);
      if (header.empty()) break;
      add(name_in(header), at);
      at.pos_in_zip_directory += header.size();
    }
  }
  if (places_.empty()) {
    // bytes before the archive move its headers; minizip knows how far
    std::array<char, kLongestName> buffer{};
    for (int next = unzGoToFirstFile(archive_.get()); next == UNZ_OK; next = unzGoToNextFile(archive_.get())) {
      const std::string_view name = name_of_entry(archive_.get(), buffer);
      if (unzGetFilePos64(archive_.get(), &at) == UNZ_OK) add(name, at);
    }
  }
  std::stable_sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) { return a.hash < b.hash; });
}

bool ZipArchive::find(std::string_view name) const {
  const std::size_t hash = std::hash<std::string_view>()(name);
  auto place = std::lower_bound(places_.begin(), places_.end(), hash,
                                [](const Place& a, std::size_t wanted) { return a.hash < wanted; });
  std::array<char, kLongestName> buffer{};
  for (; place != places_.end() && place->hash == hash; ++place) {
    if (unzGoToFilePos64(archive_.get(), &place->at) == UNZ_OK && name_of_entry(archive_.get(), buffer) == name)
      return true;
  }
  return false;
}

std::string ZipArchive::entry(std::string_view name, std::size_t most_bytes) const {
  unz_file_info64 info{};
  if (!find(name) || unzGetCurrentFileInfo64(archive_.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK) {
    throw CurveError(fmt::format("its archive has no \"{}\"", name));
  }
  if (info.uncompressed_size > most_bytes) throw CurveError(fmt::format("\"{}\" in its archive is too large", name));
  std::string bytes(info.uncompressed_size, '\0');
  const bool opened = unzOpenCurrentFile(archive_.get()) == UNZ_OK;
  const bool whole = opened && unzReadCurrentFile(archive_.get(), bytes.data(), static_cast<unsigned>(bytes.size())) ==
                                   static_cast<int>(bytes.size());
  // closing compares the checksum
  if (!opened || unzCloseCurrentFile(archive_.get()) != UNZ_OK || !whole) {
    throw CurveError(fmt::format("\"{}\" in its archive is damaged", name));
  }
  return bytes;
}

}  // namespace afm::curves

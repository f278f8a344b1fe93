// SPDX-License-Identifier: Apache-2.0
#include "bytes/zip_archive.h"

#include <fmt/format.h>
#include <ioapi.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

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

std::size_t number_of_four(std::string_view bytes, std::size_t at) {
  return number_of_two(bytes, at) + 65536U * number_of_two(bytes, at + 2);
}

// Header that begins at an offset; empty if none does.
std::string_view header_at(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < kHeader || bytes.substr(at, kSignature.size()) != kSignature) return {};
  const std::size_t size =
      kHeader + number_of_two(bytes, at + 28) + number_of_two(bytes, at + 30) + number_of_two(bytes, at + 32);
  return size <= bytes.size() - at ? bytes.substr(at, size) : std::string_view();
}

// Name in a header as minizip reads it: up to a zero, and not longer than its limit.
std::string_view name_in(std::string_view header) {
  const std::string_view name = header.substr(kHeader, std::min(number_of_two(header, 28), kLongestName - 1));
  return name.substr(0, name.find('\0'));
}

// Entry as its header describes it.
struct Packed {
  std::string_view bytes;
  std::size_t size = 0;  // unpacked size in bytes
  std::size_t checksum = 0;
  bool deflated = false;
};

// Entry of a header; empty if it is encrypted, larger than 4 GB, not packed by deflation, or contradicted by its local
// header (APPNOTE 4.3.7).
std::optional<Packed> packed_entry(std::string_view bytes, std::string_view header) {
  constexpr std::size_t kLocalHeader = 30, kStored = 0, kDeflated = 8, kFarther = 0xffffffff;
  const std::size_t method = number_of_two(header, 10), packed = number_of_four(header, 20);
  const Packed found{{}, number_of_four(header, 24), number_of_four(header, 16), method == kDeflated};
  const std::size_t local = number_of_four(header, 42);
  constexpr std::size_t kEncrypted = 1;
  if ((number_of_two(header, 8) & kEncrypted) != 0 || (method != kStored && method != kDeflated)) return std::nullopt;
  if (packed == kFarther || found.size == kFarther || local == kFarther) return std::nullopt;
  if (method == kStored && packed != found.size) return std::nullopt;
  if (local > bytes.size() || bytes.size() - local < kLocalHeader) return std::nullopt;
  const std::string_view here = bytes.substr(local);
  const std::size_t name = number_of_two(here, 26), begin = kLocalHeader + name + number_of_two(here, 28);
  if (!here.starts_with("PK\x03\x04") || number_of_two(here, 8) != method || name != number_of_two(header, 28)) {
    return std::nullopt;
  }
  if (begin > here.size() || here.size() - begin < packed) return std::nullopt;
  return Packed{here.substr(begin, packed), found.size, found.checksum, found.deflated};
}

// True if the archive ends with its last record, before a comment of at most 64 KiB (APPNOTE 4.3.16).
bool has_end(std::string_view bytes) {
  constexpr std::size_t kFarthest = 22 + 65535;
  return bytes.substr(bytes.size() - std::min(bytes.size(), kFarthest)).find("PK\x05\x06") != std::string_view::npos;
}

std::size_t checksum_of(std::string_view bytes) {
  return ::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
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
  if (!archive_ && !has_end(bytes)) throw CutShort("its zip archive has no end");
  if (!archive_) throw CurveError(std::string("its zip archive is damaged; ") + kCopyAgain);
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
    listed_here_ = false;
    // bytes before the archive move its headers; minizip knows how far
    std::array<char, kLongestName> buffer{};
    for (int next = unzGoToFirstFile(archive_.get()); next == UNZ_OK; next = unzGoToNextFile(archive_.get())) {
      const std::string_view name = name_of_entry(archive_.get(), buffer);
      if (unzGetFilePos64(archive_.get(), &at) == UNZ_OK) add(name, at);
    }
  }
  sort_by_hash();
}

// Sorts the places by the first bits of their hashes, which about one entry has: the full order would take seconds.
void ZipArchive::sort_by_hash() {
  constexpr unsigned kHashBits = 64;
  const unsigned bits = std::max(1U, static_cast<unsigned>(std::bit_width(places_.size())));
  begin_shift_ = kHashBits - bits;
  begin_of_.assign((std::size_t{1} << bits) + 1, 0);
  for (const Place& place : places_) ++begin_of_[(place.hash >> begin_shift_) + 1];
  std::partial_sum(begin_of_.begin(), begin_of_.end(), begin_of_.begin());
  std::vector<Place> sorted(places_.size());
  std::vector<std::uint32_t> next(begin_of_);
  for (const Place& place : places_) sorted[next[place.hash >> begin_shift_]++] = place;
  places_ = std::move(sorted);
  // of two entries of one name the first counts, wherever another one was found before
  in_order_ = listed_here_;
  for (std::size_t i = 0; i < places_.size() && in_order_; ++i) {
    const std::size_t end = begin_of_[(places_[i].hash >> begin_shift_) + 1];
    for (std::size_t k = i + 1; k < end; ++k) in_order_ = in_order_ && places_[k].hash != places_[i].hash;
  }
}

std::optional<ZipArchive::Place> ZipArchive::find(std::string_view name) const {
  const auto is_there = [&](const Place& place) {
    if (!listed_here_) {
      std::array<char, kLongestName> buffer{};
      return unzGoToFilePos64(archive_.get(), &place.at) == UNZ_OK && name_of_entry(archive_.get(), buffer) == name;
    }
    const std::string_view header = header_at(cursor_->bytes, place.at.pos_in_zip_directory);
    if (header.empty() || name_in(header) != name) return false;
    last_ = place;
    next_ = {0, {place.at.pos_in_zip_directory + header.size(), place.at.num_of_file + 1}};
    return true;
  };
  if (in_order_) {
    for (const Place near : {last_, next_}) {
      if (is_there(near)) return near;
    }
  }
  const std::size_t hash = std::hash<std::string_view>()(name), first = hash >> begin_shift_;
  for (std::size_t i = begin_of_[first]; i < begin_of_[first + 1]; ++i) {
    const Place& place = places_[i];
    if (place.hash == hash && is_there(place)) return place;
  }
  return std::nullopt;
}

bool ZipArchive::Inflater::unpack(std::string_view packed, std::string& bytes) {
  constexpr int kNoHeader = -MAX_WBITS;
  if (!made_ && ::inflateInit2(&stream_, kNoHeader) != Z_OK) return false;
  if (made_ && ::inflateReset(&stream_) != Z_OK) return false;
  made_ = true;
  // zlib does not write there
  stream_.next_in = const_cast<unsigned char*>(reinterpret_cast<const unsigned char*>(packed.data()));
  stream_.avail_in = static_cast<unsigned>(packed.size());
  stream_.next_out = reinterpret_cast<unsigned char*>(bytes.data());
  stream_.avail_out = static_cast<unsigned>(bytes.size());
  return ::inflate(&stream_, Z_FINISH) == Z_STREAM_END && stream_.avail_out == 0;
}

std::string ZipArchive::entry(std::string_view name, std::size_t most_bytes) const {
  const auto place = find(name);
  if (!place) throw CurveError(fmt::format("its archive has no \"{}\"", name));
  const auto packed = listed_here_
                          ? packed_entry(cursor_->bytes, header_at(cursor_->bytes, place->at.pos_in_zip_directory))
                          : std::nullopt;
  if (!packed) return unpacked(*place, name, most_bytes);
  if (packed->size > most_bytes) throw CurveError(fmt::format("\"{}\" in its archive is too large", name));
  std::string bytes(packed->deflated ? std::string(packed->size, '\0') : std::string(packed->bytes));
  const bool whole = !packed->deflated || inflater_.unpack(packed->bytes, bytes);
  if (!whole || checksum_of(bytes) != packed->checksum) {
    throw CurveError(fmt::format("\"{}\" in its archive is damaged; {}", name, kCopyAgain));
  }
  return bytes;
}

std::string ZipArchive::unpacked(const Place& place, std::string_view name, std::size_t most_bytes) const {
  unz_file_info64 info{};
  if (unzGoToFilePos64(archive_.get(), &place.at) != UNZ_OK ||
      unzGetCurrentFileInfo64(archive_.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK) {
    throw CurveError(fmt::format("its archive has no \"{}\"", name));
  }
  if (info.uncompressed_size > most_bytes) throw CurveError(fmt::format("\"{}\" in its archive is too large", name));
  std::string bytes(info.uncompressed_size, '\0');
  const bool opened = unzOpenCurrentFile(archive_.get()) == UNZ_OK;
  const bool whole = opened && unzReadCurrentFile(archive_.get(), bytes.data(), static_cast<unsigned>(bytes.size())) ==
                                   static_cast<int>(bytes.size());
  // closing compares the checksum
  if (!opened || unzCloseCurrentFile(archive_.get()) != UNZ_OK || !whole) {
    throw CurveError(fmt::format("\"{}\" in its archive is damaged; {}", name, kCopyAgain));
  }
  return bytes;
}

}  // namespace afm::curves

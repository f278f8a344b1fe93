// SPDX-License-Identifier: Apache-2.0
#include "formats/zip_archive.h"

#include <fmt/format.h>
#include <ioapi.h>

#include <array>
#include <cstdio>

#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr int kCaseSensitive = 1;
constexpr std::size_t kLongestName = 1024;

// minizip's callback for opening a file: `bytes`, passed as the file name, become the stream.
voidpf open_bytes(voidpf /*opaque*/, const void* bytes, int /*mode*/) {
  const auto& view = *static_cast<const std::string_view*>(bytes);
  return ::fmemopen(const_cast<char*>(view.data()), view.size(), "rb");
}

unzFile open_archive(std::string_view bytes) {
  if (bytes.empty()) return nullptr;
  zlib_filefunc64_def stream{};
  fill_fopen64_filefunc(&stream);
  stream.zopen64_file = open_bytes;
  return unzOpen2_64(&bytes, &stream);
}

std::string name_of_entry(unzFile archive) {
  std::array<char, kLongestName> name{};
  // a longer name is cut off without a terminating zero
  const int read = unzGetCurrentFileInfo64(archive, nullptr, name.data(), name.size() - 1, nullptr, 0, nullptr, 0);
  return read == UNZ_OK ? std::string(name.data()) : std::string();
}

}  // namespace

ZipArchive::ZipArchive(std::string_view bytes) : archive_(open_archive(bytes), &unzClose) {
  if (!archive_) throw CurveError("its zip archive is damaged");
}

bool ZipArchive::holds(const std::string& name) const {
  return unzLocateFile(archive_.get(), name.c_str(), kCaseSensitive) == UNZ_OK;
}

bool ZipArchive::holds_folder(std::string_view prefix) const {
  for (int next = unzGoToFirstFile(archive_.get()); next == UNZ_OK; next = unzGoToNextFile(archive_.get())) {
    if (name_of_entry(archive_.get()).starts_with(prefix)) return true;
  }
  return false;
}

std::string ZipArchive::entry(const std::string& name, std::size_t most_bytes) const {
  unz_file_info64 info{};
  if (!holds(name) || unzGetCurrentFileInfo64(archive_.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK) {
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

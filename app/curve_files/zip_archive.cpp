// SPDX-License-Identifier: Apache-2.0
#include "app/curve_files/zip_archive.h"

#include <fmt/format.h>

#include "app/curve_files/curve_fault.h"

namespace afm::app {

ZipArchive::ZipArchive(std::string_view bytes) : archive_(nullptr, &zip_discard) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source != nullptr) archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
  if (archive_) return;  // and owns the source
  const std::string why = zip_error_strerror(&error);
  if (source != nullptr) zip_source_free(source);
  zip_error_fini(&error);
  throw CurveFault(fmt::format("its zip archive is damaged ({})", why));
}

bool ZipArchive::holds(const std::string& name) const { return zip_name_locate(archive_.get(), name.c_str(), 0) >= 0; }

bool ZipArchive::holds_folder(std::string_view prefix) const {
  const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const char* name = zip_get_name(archive_.get(), static_cast<zip_uint64_t>(i), 0);
    if (name != nullptr && std::string_view(name).starts_with(prefix)) return true;
  }
  return false;
}

std::string ZipArchive::entry(const std::string& name, std::size_t most_bytes) const {
  zip_stat_t status;
  zip_stat_init(&status);
  if (zip_stat(archive_.get(), name.c_str(), 0, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0) {
    throw CurveFault(fmt::format("its archive has no \"{}\"", name));
  }
  if (status.size > most_bytes) throw CurveFault(fmt::format("\"{}\" in its archive is too large", name));
  std::string bytes(status.size, '\0');
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(zip_fopen_index(archive_.get(), status.index, 0),
                                                                &zip_fclose);
  if (!file || zip_fread(file.get(), bytes.data(), bytes.size()) != static_cast<zip_int64_t>(bytes.size())) {
    throw CurveFault(fmt::format("\"{}\" in its archive is damaged", name));
  }
  return bytes;
}

}  // namespace afm::app

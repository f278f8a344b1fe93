// SPDX-License-Identifier: Apache-2.0
#include "core/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace afm::core {

namespace {

constexpr std::uintmax_t kLargestFileBytes = std::uintmax_t{1} << 30U;

}  // namespace

Result<std::string> read_file(const std::string& path) {
  const auto bad = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile, "cannot read " + path + ": " + why);
  };
  std::error_code status_error;
  if (!std::filesystem::is_regular_file(path, status_error)) return bad("there is no such file");
  if (std::filesystem::file_size(path, status_error) > kLargestFileBytes) return bad("it is larger than 1 GiB");
  std::ifstream file(path, std::ios::binary);
  if (!file) return bad(std::strerror(errno));
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) return bad(std::strerror(errno));
  return bytes;
}

Result<void> write_file(const std::string& path, std::string_view bytes) {
  const std::string part = path + ".part";
  const auto failed = [&](const char* why) {
    const std::string reason = why;
    std::remove(part.c_str());
    return core::failure(core::ErrorCategory::Failed, "cannot write " + path + ": " + reason);
  };
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  if (!file) return failed(std::strerror(errno));
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) return failed(std::strerror(errno));
  if (std::rename(part.c_str(), path.c_str()) != 0) return failed(std::strerror(errno));
  return {};
}

}  // namespace afm::core

// SPDX-License-Identifier: Apache-2.0
#include "formats/format_table.h"

#include <cstdint>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

namespace afm::curves {

core::Result<std::string> bytes_of_file(const std::string& path) {
  constexpr std::uintmax_t kLargestBytes = std::uintmax_t{256} << 20U;
  std::error_code missing;
  if (const auto size = std::filesystem::file_size(path, missing); !missing && size > kLargestBytes) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("cannot read {}: it is larger than {} MiB", path, kLargestBytes >> 20U));
  }
  return core::read_file(path);
}

std::string reason_of_failure() {
  try {
    throw;
  } catch (const nlohmann::json::exception&) {
    return "its metadata is no valid JSON";
  } catch (const std::bad_alloc&) {
    return "there is too little memory for it";
  } catch (const std::runtime_error& fault) {
    return fault.what();
  }
}

}  // namespace afm::curves

// SPDX-License-Identifier: Apache-2.0
#include "core/own_folder.h"

#include <dlfcn.h>
#include <link.h>

#include <system_error>

namespace afm::core {

std::filesystem::path own_folder() {
  Dl_info info{};
  void* map = nullptr;
  std::error_code unknown;
  const bool found = ::dladdr1(reinterpret_cast<const void*>(&own_folder), &info, &map, RTLD_DL_LINKMAP) != 0;
  const char* object = found && map != nullptr ? static_cast<const link_map*>(map)->l_name : nullptr;
  // the program itself has no name there
  const std::filesystem::path file = object != nullptr && *object != '\0'
                                         ? std::filesystem::canonical(object, unknown)
                                         : std::filesystem::read_symlink("/proc/self/exe", unknown);
  return file.parent_path();
}

}  // namespace afm::core

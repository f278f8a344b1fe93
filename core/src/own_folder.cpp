// SPDX-License-Identifier: Apache-2.0
#include "core/own_folder.h"

#include <dlfcn.h>
#include <link.h>
#include <sys/auxv.h>

#include <bit>
#include <system_error>

namespace afm::core {

std::filesystem::path own_program() {
  std::error_code error;
  std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) return program;
  // without /proc: the path that the kernel was given
  const char* const started = std::bit_cast<const char*>(::getauxval(AT_EXECFN));
  return started == nullptr ? std::filesystem::path() : std::filesystem::canonical(started, error);
}

std::filesystem::path own_folder() {
  Dl_info info{};
  void* map = nullptr;
  std::error_code unknown;
  const bool found = ::dladdr1(reinterpret_cast<const void*>(&own_folder), &info, &map, RTLD_DL_LINKMAP) != 0;
  const char* object = found && map != nullptr ? static_cast<const link_map*>(map)->l_name : nullptr;
  // the program itself has no name there
  const std::filesystem::path file =
      object != nullptr && *object != '\0' ? std::filesystem::canonical(object, unknown) : own_program();
  return file.parent_path();
}

std::filesystem::path assets_of(const std::filesystem::path& program) {
  const std::filesystem::path above = program.parent_path().parent_path();
  std::filesystem::path built = above / "share" / "touchafm";
  std::error_code ignored;
  if (std::filesystem::is_directory(built, ignored)) return built;
  return above.parent_path() / "share" / "touchafm";
}

}  // namespace afm::core

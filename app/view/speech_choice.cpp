// SPDX-License-Identifier: Apache-2.0
#include "app/view/speech_choice.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include "core/whole_file.h"

namespace afm::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kScreenReader = "orca\n";  // name in /proc

std::optional<std::string> find_in_path(std::string_view program) {
  const char* const path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nothing changes it
  for (std::string_view rest = path == nullptr ? "" : path; !rest.empty();) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
    std::string file = (fs::path(folder) / program).string();
    struct stat found{};
    if (::stat(file.c_str(), &found) == 0 && S_ISREG(found.st_mode) && ::access(file.c_str(), X_OK) == 0) return file;
  }
  return std::nullopt;
}

bool screen_reader_runs() {
  std::error_code error;
  for (const fs::directory_entry& process : fs::directory_iterator("/proc", error)) {
    struct stat owner{};
    const std::string folder = process.path().string();
    if (::stat(folder.c_str(), &owner) != 0 || owner.st_uid != ::getuid()) continue;
    if (const auto name = core::read_file(folder + "/comm"); name && *name == kScreenReader) return true;
  }
  return false;
}

}  // namespace

core::Result<exhibit::SpeechProgram> choose_speech_program(const std::string& language) {
  using Voice = exhibit::SpeechProgram::Voice;
  if (screen_reader_runs()) {
    if (auto own = find_in_path("spd-say")) return exhibit::SpeechProgram{*own, language, Voice::ItsOwn};
  }
  if (auto piped = find_in_path("espeak-ng")) return exhibit::SpeechProgram{*piped, language, Voice::Piped};
  return core::failure(core::ErrorCategory::DeviceMissing,
                       "--speech needs the program espeak-ng, which is not in PATH: install the package espeak-ng, or "
                       "start without --speech");
}

}  // namespace afm::app

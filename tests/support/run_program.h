// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "support/scratch_folder.h"

namespace afm::support {

struct ProgramResult {
  int exit_code = -1;
  std::string out;
  std::string err;
};

// Runs a command line through the shell, as typed by a person, and waits.
inline ProgramResult run_program(const std::string& command_line) {
  const ScratchFolder folder;
  const std::string out = folder.file("out"), err = folder.file("err");
  const int status = std::system((command_line + " >" + out + " 2>" + err).c_str());
  const auto slurp = [](const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), slurp(out), slurp(err)};
}

}  // namespace afm::support

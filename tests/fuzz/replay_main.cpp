// SPDX-License-Identifier: Apache-2.0
// Runs every file of a corpus folder through a fuzz target in an ordinary build, so that neither rots. Of each kind of
// file, by the end of its name, one must be good: a fuzzer that knows only what is refused gets no further.
// Invariant: no file, report or packet crashes a parser
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "fuzz/accepted.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: %s CORPUS-FOLDER\n", arguments[0]);
    return 2;
  }
  int files = 0;
  std::map<std::string, int> good;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[1])) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    const int before = afm::fuzz::accepted_inputs;
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    good[entry.path().extension().string()] += afm::fuzz::accepted_inputs - before;
    ++files;
  }
  bool each = true;
  for (const auto& [kind, accepted] : good) {
    std::printf("%s: %d are good\n", kind.empty() ? "files" : kind.c_str(), accepted);
    each = each && accepted > 0;
  }
  std::printf("%d files replayed\n", files);
  // an empty corpus proves nothing
  return files >= 3 && each ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "models.h"

namespace {

int write_models(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const afm::generate::Model& model : afm::generate::all_models()) {
    const std::filesystem::path path = folder / (model.name + ".glb");
    const std::vector<std::uint8_t> bytes = afm::generate::to_glb(model);
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
      std::fprintf(stderr, "generate-models: cannot write %s; check the folder and its free space\n", path.c_str());
      return 1;
    }
    std::printf("%8zu bytes  %s\n", bytes.size(), path.c_str());
  }
  return 0;
}

}  // namespace

// usage: generate-models OUTDIR   writes every model of assets/models into OUTDIR, the same bytes on every machine.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: generate-models OUTDIR\n");
    return 2;
  }
  try {
    return write_models(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate-models: %s\n", error.what());
    return 1;
  }
}

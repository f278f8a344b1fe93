// SPDX-License-Identifier: Apache-2.0
// write_reference ASSETS DATE FOLDER: writes touchafm.1, the man page, and touchafm.bash, bash's completion, into
// FOLDER. Both come from the program's own command line. The build runs it; it is not installed.
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "app/program.h"
#include "bash_completion.h"
#include "core/exit_code.h"
#include "core/run_main.h"
#include "core/version.h"
#include "core/whole_file.h"
#include "curves/contact_setup.h"
#include "man_page.h"
#include "scene/samples/material_library.h"
#include "scene/samples/probe_library.h"
#include "servo/haptic_choice.h"

namespace {

using afm::core::ExitCode;
using afm::core::fail;

// "auto, paper, hao" as words.
std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream text(list);
  for (std::string word; std::getline(text >> std::ws, word, ',');) words.push_back(word);
  return words;
}

afm::core::Result<afm::reference::ValueWords> value_words(const std::string& assets) {
  const auto materials = afm::scene::load_materials(assets + "/materials.toml");
  if (!materials) return tl::unexpected(materials.error());
  const auto probes = afm::scene::load_probes(assets + "/probes.toml");
  if (!probes) return tl::unexpected(probes.error());
  afm::reference::ValueWords words{{"MATERIAL", materials->names()},
                                   {"MODEL", words_of(afm::curves::known_models(afm::curves::ModelUse::Curve))}};
  for (const afm::scene::ProbeEntry& probe : probes->probes) words["PROBE"].push_back(probe.name);
  for (const afm::servo::HapticWord& device : afm::servo::haptic_words()) {
    // bash makes two words of replay:FILE
    if (device.word.find(':') == std::string::npos) words["DEVICE"].push_back(device.word);
  }
  return words;
}

int run(int count, char** arguments) {
  if (count != 4) return fail(ExitCode::WrongUsage, "usage: write_reference ASSETS DATE FOLDER");
  const std::string folder = arguments[3];
  const std::string assets = arguments[1];
  // the man page names the files of the package, not those of the build
  const afm::app::CommandContext context{.assets_dir = "/usr/share/touchafm", .program_path = {}};
  afm::app::CommandLine command_line("touchafm", afm::core::kVersion, afm::app::kProgramHelp);
  afm::app::add_commands(command_line, context);
  const afm::app::CommandDescription program = command_line.describe();

  const auto words = value_words(assets);
  if (!words) return fail(afm::core::exit_code(words.error().category), words.error().message);
  const std::string page = afm::reference::man_page(program, {.version = afm::core::kVersion, .date = arguments[2]});
  for (const auto& [file, text] : {std::pair("/touchafm.1", page),
                                   std::pair("/touchafm.bash", afm::reference::bash_completion(program, *words))}) {
    if (const auto written = afm::core::write_file(folder + file, text); !written) {
      return fail(afm::core::exit_code(written.error().category), written.error().message);
    }
  }
  return static_cast<int>(ExitCode::Done);
}

}  // namespace

int main(int count, char** arguments) {
  return afm::core::run_main([&] { return run(count, arguments); });
}

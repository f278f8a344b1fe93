// SPDX-License-Identifier: Apache-2.0
// Every command and option that reads a file, with each thing that a path can name instead of one.
// Invariant: every option that reads a file refuses at once all but plain files
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/command.h"
#include "app/options/command_line.h"
#include "app/program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace input_files_test {

// One input: its command, its option or argument as the help has it, the way to give it, and the ending of its name,
// by which some formats are recognised. The file replaces @, a good wall for $WALL, a good lesson for $LESSON.
struct Input {
  const char* command;
  const char* name;
  const char* words;
  const char* ending = ".toml";
};

const std::vector<Input> kInputs{
    {"demo", "--guidance", "--out $OUT --guidance @"},
    {"demo", "--wall", "--out $OUT --wall @"},
    {"demo", "--wall", "--out $OUT --wall @", ".pvx"},
    {"demo", "--materials", "--out $OUT --materials @"},
    {"demo", "--probe", "--out $OUT --probe @", ".glb"},
    {"demo", "--sample", "--out $OUT --sample @", ".gltf"},
    {"demo", "--sample", "--out $OUT --sample @", ".gwy"},
    {"demo", "--measured", "--out $OUT --measured @", ".csv"},
    {"view", "--guidance", "--guidance @"},
    {"view", "--wall", "--wall @"},
    {"view", "--wall", "--wall @", ".pvx"},
    {"view", "--materials", "--materials @"},
    {"view", "--probe", "--probe @", ".glb"},
    {"view", "--sample", "--sample @", ".glb"},
    {"view", "--sample", "--sample @", ".spm"},
    {"view", "--particles", "--particles @"},
    {"view", "--force-map", "--force-map @", ".jpk-force-map"},
    {"view", "--wand-file", "--wand-file @"},
    {"view", "--head", "--head sim:@", ".csv"},
    {"view", "--haptics", "--haptics replay:@", ".afms"},
    {"serve", "--sample", "--socket $OUT/afm.sock --sample @", ".glb"},
    {"serve", "--sample", "--socket $OUT/afm.sock --sample @", ".gwy"},
    {"serve", "--wall", "--view --socket $OUT/afm.sock --wall @"},
    {"lesson", "lesson", "@"},
    {"lesson", "--guidance", "$LESSON --guidance @"},
    {"lesson", "--wall", "$LESSON --wall @"},
    {"lesson", "--materials", "$LESSON --materials @"},
    {"lesson", "--wand-file", "$LESSON --wand-file @"},
    {"lesson", "--head", "$LESSON --head sim:@", ".csv"},
    {"lesson", "--haptics", "$LESSON --haptics replay:@", ".afms"},
    {"curve", "--materials", "--material mica --materials @"},
    {"curve", "--probes", "--material mica --probe none --probes @"},
    {"curve", "--overlay", "--material mica --format svg --overlay @", ".csv"},
    {"scan", "--materials", "--out $OUT --material mica --materials @"},
    {"scan", "--probes", "--out $OUT --material mica --probe none --probes @"},
    {"scan", "--sample", "--out $OUT --sample @", ".glb"},
    {"scan", "--sample", "--out $OUT --sample @", ".gwy"},
    {"analyse", "file", "@", ".csv"},
    {"analyse", "file", "@", ".tab"},
    {"analyse", "file", "@", ".h5"},
    {"analyse", "file", "@", ".jpk-force"},
    {"analyse", "file", "@", ".ibw"},
    {"analyse", "file", "@", ".gwy"},
    {"analyse", "file", "@", ".gsf"},
    {"analyse", "file", "@", ".jpk"},
    {"analyse", "file", "@", ".001"},
    {"analyse", "file", "@", ".afms"},
    {"convert", "file", "@ $OUT/new.h5", ".jpk-force"},
    {"convert", "file", "@ $OUT/new.gwy", ".nid"},
    {"convert", "file", "@ $OUT/new.gwy", ".tiff"},
    {"analyse", "--beside", "$CURVE --beside @", ".csv"},
    {"lever", "--thermal", "--sensitivity 60nm/V --thermal @", ".txt"},
    {"lever", "--sensitivity-from", "--sensitivity-from @", ".csv"},
    {"material", "--materials", "mica --materials @"},
    {"material", "--probes", "mica --probe none --probes @"},
    {"particles", "file", "@"},
    {"paper", "--summary", "--out $OUT --summary @", ".json"},
    {"paper", "--materials", "--out $OUT --materials @"},
    {"render", "--guidance", "--out $OUT --journey 4 --guidance @"},
    {"render", "--wall", "--out $OUT --journey 4 --wall @"},
    {"render", "--wall", "--out $OUT --journey 4 --wall @", ".pvx"},
    {"render", "--materials", "--out $OUT --journey 4 --materials @"},
    {"render", "--probe", "--out $OUT --journey 4 --probe @", ".glb"},
    {"render", "--sample", "--out $OUT --journey 4 --sample @", ".glb"},
    {"render", "--session", "--out $OUT --session @ --at 1", ".afms"},
    {"render", "--force-map", "--out $OUT --session $SESSION --at 1 --force-map @", ".h5"},
    {"render", "--gltf", "--out $OUT --gltf @", ".glb"},
    {"replay", "session", "@", ".afms"},
    {"wall", "file", "@"},
    {"wall", "file", "@", ".pvx"},
    {"wall", "file", "@ --start"},
    {"wall", "--guidance", "$WALL --test-pattern --out $OUT --guidance @"},
    {"devices", "--wand-file", "--wand-file @"},
    {"doctor", "--cluster", "--cluster @"},
    {"doctor", "--cluster", "--cluster @", ".pvx"},
};

// Files that are written.
const std::set<std::string> kOutputs{"--out", "--frame-log", "--picture", "--map", "--sound", "--bundle", "--video"};

// True if a value names a file, by itself or after a word.
bool names_file(const OptionDescription& option) {
  if (kOutputs.contains(option.name)) return false;
  for (const char* value : {"FILE", "SESSION"}) {
    if (option.value.find(value) != std::string::npos) return true;
  }
  return option.help.find(":FILE") != std::string::npos;
}

TEST(InputFiles, AreAllInTheTable) {
  const CommandContext context{.assets_dir = "/usr/share/touchafm", .program_path = {}};
  CommandLine command_line("touchafm", "", kProgramHelp);
  add_commands(command_line, context);
  for (const CommandDescription& command : command_line.describe().commands) {
    std::vector<OptionDescription> options = command.options;
    for (const AlternativesDescription& group : command.alternatives)
      options.insert(options.end(), group.options.begin(), group.options.end());
    for (const OptionDescription& option : options) {
      if (!names_file(option)) continue;
      EXPECT_TRUE(
          std::any_of(kInputs.begin(), kInputs.end(),
                      [&](const Input& input) { return input.command == command.name && input.name == option.name; }))
          << command.name << " " << option.name << " reads a file: add it to kInputs";
    }
  }
}

// Something that is no readable file.
struct Thing {
  const char* name;
  void (*make)(const std::string& path);
};

const std::vector<Thing> kThings{
    {"Pipe", [](const std::string& path) { ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0); }},
    {"LinkToAPipe",
     [](const std::string& path) {
       ASSERT_EQ(::mkfifo((path + ".pipe").c_str(), 0600), 0);
       std::filesystem::create_symlink(path + ".pipe", path);
     }},
    {"Folder", [](const std::string& path) { std::filesystem::create_directory(path); }},
    {"Device", [](const std::string& path) { std::filesystem::create_symlink("/dev/zero", path); }},
    {"Socket",
     [](const std::string& path) {
       sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
       ASSERT_LT(path.size(), sizeof(address.sun_path));
       std::copy(path.begin(), path.end(), address.sun_path);
       const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
       ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
       ::close(socket);
     }},
    // a regular file whose reading fails, also for root
    {"Unreadable", [](const std::string& path) { std::filesystem::create_symlink("/proc/self/mem", path); }},
    {"DanglingLink", [](const std::string& path) { std::filesystem::create_symlink("/no/such/file", path); }},
    {"Nothing", [](const std::string&) {}},
};

class InputFile : public ::testing::TestWithParam<Thing> {
 protected:
  static void replace(std::string& words, std::string_view what, const std::string& by) {
    if (const std::size_t at = words.find(what); at != std::string::npos) words.replace(at, what.size(), by);
  }

  support::ScratchFolder folder_;
};

TEST_P(InputFile, IsRefusedAtOnceByEveryCommandAndOption) {
  const std::string curve = folder_.file("good.csv");
  ASSERT_EQ(support::run_program(support::touchafm() + " curve --material mica --out " + curve).exit_code, 0);
  int number = 0;
  for (const Input& input : kInputs) {
    // a new name: the last one may still be in use
    const std::string path = folder_.file(std::to_string(number++) + input.ending);
    GetParam().make(path);
    std::string words = input.words;
    replace(words, "@", path);
    replace(words, "$OUT", folder_.file("out"));
    replace(words, "$WALL", support::source("assets/walls/powerwall.toml"));
    replace(words, "$LESSON", support::source("assets/lessons/first-touch.toml"));
    replace(words, "$CURVE", curve);
    replace(words, "$SESSION", support::source("tests/fuzz/corpus/session/plans.afms"));
    // a minute ends one that waits; every other needs a fraction of a second
    const std::string command = support::touchafm() + " " + input.command + " " + words;
    const auto done = support::run_program("DISPLAY= timeout -k 5 60 " + command + " </dev/null");
    EXPECT_TRUE(done.exit_code == 3 || done.exit_code == 2) << done.exit_code << ": " << command << "\n" << done.err;
    EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << command << "\n" << done.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Things, InputFile, ::testing::ValuesIn(kThings),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace input_files_test
}  // namespace afm::app

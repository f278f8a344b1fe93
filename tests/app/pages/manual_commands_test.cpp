// SPDX-License-Identifier: Apache-2.0
// Invariant: every command that README and manual show runs, or a table gives the reason why no test can run it
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/whole_file.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace manual_commands_test {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

// README and the chapters. Within a page, later commands use files of earlier ones.
constexpr auto kPages = std::to_array<std::string_view>(
    {"README.md", "docs/manual/start.md", "docs/manual/bundle.md", "docs/manual/demonstrate.md", "docs/manual/teach.md",
     "docs/manual/measure.md", "docs/manual/particles.md", "docs/manual/scratches.md", "docs/manual/walls.md",
     "docs/manual/headset.md", "docs/manual/several-machines.md", "docs/manual/devices.md",
     "docs/manual/force-dimension.md", "docs/manual/reference.md"});

struct Exception {
  std::string_view command;  // command as on the page
  std::string_view reason;
};

constexpr std::string_view kRoot = "needs root", kBundle = "unpacks a bundle: tests/bundle does so on bare systems",
                           kMachines = "needs several machines: the tests of app/cluster have them",
                           kMinutes = "takes minutes: the tests of benchmarks run it shorter",
                           kName = "names a command without its arguments",
                           kHeadset = "needs a headset: the tests of headset have a stand-in";

constexpr std::array kNotRun{
    Exception{"./run.sh", "installs and builds: Tutorial.* runs its demonstration"},
    Exception{"./test.sh", "runs this test"},
    Exception{"touchafm curve --mode tapping", kName},
    Exception{"touchafm view --headset", kHeadset},
    Exception{"scripts/package", "builds packages: .ci/run does so"},
    Exception{"sudo apt install ./build/release/package/touchafm_*.deb", kRoot},
    Exception{"sudo groupadd touchafm", kRoot},
    Exception{"sudo usermod -aG touchafm \"$(id -un)\"", kRoot},
    Exception{"printf '@touchafm - %s\\n' 'rtprio 80' 'memlock unlimited' 'nice -10' | sudo tee "
              "/etc/security/limits.d/touchafm.conf",
              kRoot},
    Exception{"tar -xf touchafm-*-x86_64.tar.xz", kBundle},
    Exception{"touchafm-*-x86_64/bin/touchafm doctor", kBundle},
    Exception{"touchafm-*-x86_64/bin/touchafm demo --out out", kBundle},
    Exception{"touchafm bench physics", kMinutes},
    Exception{"touchafm bench fits", kMinutes},
    Exception{"touchafm lesson first-touch --fullscreen --instructor 2", "needs a second monitor"},
    Exception{"touchafm lesson --withdraw QXWERT --out study", "needs a person's consent: LessonProgram.* has it"},
    Exception{"touchafm generate curve", kName},
    Exception{"touchafm view --record", kName},
    Exception{"touchafm view --headset --haptics auto", kHeadset},
    Exception{"touchafm node left --interface 10.0.0.2", kMachines},
    Exception{"touchafm view --wall wall.toml --cluster", kMachines},
    Exception{"touchafm doctor --cluster wall.toml", kMachines},
    Exception{"touchafm bench cluster", kMinutes},
    Exception{"sudo cp assets/wands/70-touchafm-wands.rules /etc/udev/rules.d/", kRoot},
    Exception{"sudo udevadm control --reload", kRoot},
    Exception{"touchafm view --haptics forcedimension", "needs a device: DhdDevice.* has a stand-in"},
    Exception{"touchafm bench haptics", kMinutes},
    Exception{"touchafm bench render", kMinutes},
};

// Words that the reader replaces, such as FILE, ADDRESS:PORT, N or WxH. QXWERT is a code as a participant gets it.
bool has_placeholder(const std::string& command) {
  std::istringstream words(command);
  for (std::string word; words >> word;) {
    if (word == "WxH" || word.find("…") != std::string::npos || word.find('[') != std::string::npos) return true;
    if (word.size() == 1 && std::isupper(static_cast<unsigned char>(word.front())) != 0) return true;
    std::replace_if(word.begin(), word.end(), [](char c) { return c == '.' || c == '/' || c == ':' || c == '@'; }, ' ');
    std::istringstream parts(word);
    for (std::string part; parts >> part;) {
      const bool is_upper = std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isupper(c) != 0; });
      if (is_upper && part.size() > 2 && part != "QXWERT") return true;
    }
  }
  return false;
}

std::string trimmed(std::string text) {
  const std::size_t comment = text.find("  #");
  if (comment != std::string::npos) text.erase(comment);
  while (!text.empty() && text.back() == ' ') text.pop_back();
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin);
}

// The commands of a page in its order: lines of shell blocks, and quotations of touchafm with an argument.
std::vector<std::string> commands_of(const std::string& page) {
  std::vector<std::string> commands;
  const auto add = [&](const std::string& command) {
    if (command.empty() || command.front() == '#' || has_placeholder(command)) return;
    if (std::find(commands.begin(), commands.end(), command) == commands.end()) commands.push_back(command);
  };
  const std::string_view program = "touchafm ";
  std::istringstream lines(page);
  std::string fence, text;  // language of the current block; running text of a paragraph
  const auto add_quotations = [&] {
    for (std::size_t open = text.find('`'); open != std::string::npos;) {
      const std::size_t close = text.find('`', open + 1);
      if (close == std::string::npos) break;
      const std::string quotation = text.substr(open + 1, close - open - 1);
      const bool has_option =
          quotation.find(" -") != std::string::npos || std::count(quotation.begin(), quotation.end(), ' ') > 1;
      if (quotation.rfind(program, 0) == 0 && (has_option || quotation.rfind("touchafm bench ", 0) == 0)) {
        add(quotation);
      }
      open = text.find('`', close + 1);
    }
    text.clear();
  };
  bool in_block = false;
  for (std::string line, rest; std::getline(lines, line);) {
    while (line.ends_with('\\') && std::getline(lines, rest)) line.replace(line.size() - 1, 1, rest);
    const std::string content = trimmed(line);
    if (content.rfind("```", 0) == 0) {
      add_quotations();
      in_block = !in_block;
      fence = content.substr(3);
    } else if (in_block) {
      if (fence == "sh" || (fence.empty() && content.rfind(program, 0) == 0)) add(content);
    } else if (content.empty()) {
      add_quotations();
    } else {
      text += content + " ";
    }
  }
  add_quotations();
  return commands;
}

bool is_run(const std::string& command) {
  return std::none_of(kNotRun.begin(), kNotRun.end(),
                      [&](const Exception& exception) { return exception.command == command; });
}

std::vector<std::string> all_commands() {
  std::vector<std::string> all;
  for (const std::string_view page : kPages) {
    for (const std::string& command : commands_of(core::read_file(support::source(page)).value())) {
      if (std::find(all.begin(), all.end(), command) == all.end()) all.push_back(command);
    }
  }
  return all;
}

// The reader's own files, under the names that the pages give them: the content decides what they are. A person closes
// a window; here a signal does, once the window draws.
constexpr const char* kSetUp = R"(set -eu
touchafm() {
  case "$1 $*" in
    *--help*|*--participant\ sim*|*--withdraw*) command touchafm "$@"; return ;;
    view*|lesson*) ;;
    *) command touchafm "$@"; return ;;
  esac
  command touchafm "$@" &
  local pid=$! i
  for i in {1..600}; do
    if grep -q 'touchafm: drawing \|lesson: ' "$output"; then break; fi
    kill -0 $pid || break
    sleep 0.1
  done
  sleep 1
  kill $pid
  wait $pid
}
make() { command touchafm generate "$@" >/dev/null; }
make curve --radius 5um --modulus 3kPa --spring-constant 0.05N/m --most-force 1nN --noise 15pN --out curve.h5
make map --pixels 2x2 --size 10um --modulus 2kPa --radius 5um --spring-constant 0.05N/m --most-force 1nN --out map.h5
make image --material mica --size 40nm --pixels 32 --rate 20Hz --out grating.gwy
make curve --radius 5um --modulus 50GPa --spring-constant 0.05N/m --sensitivity 60nm/V --most-force 1nN --out glass.h5
mkdir day1
cp curve.h5 gel.jpk-force
cp curve.h5 day1/one.jpk-force
cp curve.h5 day1/two.jpk-force
cp map.h5 cell.h5
cp map.h5 cell.jpk-qi-data
cp glass.h5 glass.jpk-force
cp grating.gwy scan.gwy
cp grating.gwy scan.spm
cp grating.gwy mica.nid
cp assets/particles/gold-row.toml my-set.toml
command touchafm lesson assets/lessons/three-materials.toml --participant sim:7 --out class >/dev/null
)";

constexpr const char* kWall = R"(
[[screen]]
name = "left wall"
lower_left = [-1.5, 0.4, 0.0]
lower_right = [1.5, 0.4, 0.0]
upper_left = [-1.5, 2.6, 0.0]

[[node]]
name = "left"
host = "10.0.0.2"

[[output]]
name = "left projector"
node = "left"
screen = "left wall"
mode = "side-by-side"
monitor = "DP-1"

[[viewer]]
name = "visitor"
ipd = "63 mm"
sweet_spot = [0.0, 1.65, 2.5]
)";

bool reads_demonstration(const std::string& command) { return command.find(" out/") != std::string::npos; }

class ManualCommands : public testing::TestWithParam<std::string_view> {};

TEST_P(ManualCommands, Run) {
  const support::ScratchFolder folder;
  std::filesystem::create_directory_symlink(support::source("assets"), folder.file("assets"));
  folder.write("wall.toml", kWall);
  folder.write("spectrum.txt", core::read_file(support::source("tests/fuzz/corpus/spectrum/volts.txt")).value());
  std::vector<std::string> commands;
  for (const std::string& command : commands_of(core::read_file(support::source(GetParam())).value())) {
    if (is_run(command)) commands.push_back(command);
  }

  std::string script = kSetUp;
  if (GetParam() != kPages.front() && std::any_of(commands.begin(), commands.end(), reads_demonstration)) {
    script += "command touchafm demo --out out >/dev/null\n";  // first command of README
  }
  for (std::size_t i = 0; i < commands.size(); ++i) {
    script += fmt::format("output={}/output-{}\ncode=0\n( {} ) >$output 2>&1 || code=$?\necho $code >code-{}\n",
                          folder.path(), i, commands[i], i);
  }
  const std::string path = std::filesystem::path(support::touchafm()).parent_path().string();
  const support::VirtualDisplay display(1280, 720);
  const auto run =
      support::run_program(fmt::format("cd {} && PATH={}:$PATH DISPLAY={} LC_ALL=C SDL_AUDIODRIVER=dummy bash {}",
                                       folder.path(), path, display.name(), folder.write("script", script)));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    EXPECT_EQ(core::read_file(folder.file(fmt::format("code-{}", i))).value_or("not run"), "0\n")
        << commands[i] << "\n"
        << core::read_file(folder.file(fmt::format("output-{}", i))).value_or("");
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ManualCommands, testing::ValuesIn(kPages), [](const auto& page) {
  std::string name = std::filesystem::path(page.param).stem();
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
  return name;
});

TEST(ManualCommandsNotRun, AreOnThePages) {
  const std::vector<std::string> all = all_commands();
  for (const Exception& exception : kNotRun) {
    EXPECT_THAT(all, Contains(std::string(exception.command)));
    EXPECT_FALSE(exception.reason.empty());
  }
  std::size_t chapters = 0;
  for (const auto& entry : std::filesystem::directory_iterator(support::source("docs/manual"))) {
    EXPECT_THAT(kPages, Contains(testing::StrEq("docs/manual/" + entry.path().filename().string())));
    ++chapters;
  }
  EXPECT_EQ(chapters + 1, kPages.size());
}

TEST(ManualCommandsNotRun, AreOnlyTheListed) {
  EXPECT_THAT(
      commands_of("Type `touchafm curve --material\ngold` or `touchafm analyse FILE`, not `touchafm view`.\n\n"
                  "```sh\ntouchafm view --sound   # by ear\n# nothing\nsudo halt\n```\n\n"
                  "```toml\ntouchafm = 1\n```\n\n   ```\n   touchafm paper --out a\n   a\n   ```\n"),
      ElementsAre("touchafm curve --material gold", "touchafm view --sound", "sudo halt", "touchafm paper --out a"));
  EXPECT_THAT(commands_of("`touchafm node NAME --interface eth0`, `touchafm view --haptics replay:FILE`,\n"
                          "`touchafm render --size WxH`, `touchafm render --journey S --out a.png`\n"),
              IsEmpty());
  EXPECT_THAT(commands_of("`touchafm lever --gci \"5 N/m/kHz^1.3\"`, `touchafm lesson a.toml --participant QXWERT`\n"),
              testing::SizeIs(2));
  EXPECT_TRUE(is_run("touchafm view --sound"));
  EXPECT_FALSE(is_run("touchafm bench haptics"));
}

}  // namespace manual_commands_test
}  // namespace afm::app

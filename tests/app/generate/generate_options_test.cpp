// SPDX-License-Identifier: Apache-2.0
// Each option of `touchafm generate curve`, `map` and `image` changes the file or its truth, and the truth names its
// value.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "core/whole_file.h"
#include "support/places.h"
#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

namespace afm {
namespace generate_options_test {

using support::run_touchafm;
using testing::HasSubstr;

constexpr std::string_view kGel = "--modulus 3kPa --radius 5um --spring-constant 0.05N/m --most-force 1nN",
                           kCone = "--law cone --modulus 3kPa --spring-constant 0.05N/m --most-force 1nN",
                           kSticky =
                               "--law maugis --radius 1um --modulus 1MPa --work-of-adhesion 20mJ/m2 "
                               "--spring-constant 1N/m --most-force 200nN",
                           kMica = "--material mica --pixels 8";

struct Row {
  std::string_view kinds;  // kinds that have the option
  std::string_view base;   // options without it
  std::string_view added;  // the option, with everything that it needs
  std::string_view truth;  // part of the truth, without spaces
};

constexpr std::array kRows{
    Row{"curve map", kGel, "--law sphere", R"("law":"sphere")"},
    Row{"curve map", kGel, "--poisson 0.3", R"("poisson_ratio":0.3)"},
    Row{"curve map", kGel, "--law layer-sphere --layer 5um", R"("layer_m":5e-06)"},
    Row{"curve map", kGel, "--law layer-exact-sphere --layer 5um --poisson 0.4 --base sliding", R"("base":"sliding")"},
    Row{"curve map", kGel, "--contact 200nm", R"("contact_z_m":2e-07)"},
    Row{"curve map", kGel, "--clearance 1um", R"("clearance_m":1e-06)"},
    Row{"curve map", kGel, "--speed 2um/s", R"("speed_m_per_s":2e-06)"},
    Row{"curve map", kGel, "--sensitivity 50nm/V", R"("sensitivity_m_per_V":5e-08)"},
    Row{"curve map", kGel, "--noise 15pN", R"("noise_N":1.5e-11)"},
    Row{"curve map", kGel, "--noise 15pN --noise-memory 0.9", R"("noise_memory":0.9)"},
    Row{"curve map", kGel, "--sensitivity 50nm/V --bits 12", R"("bits":12.0)"},
    Row{"curve map", kGel, "--level 2nN", R"("level_N":2e-09)"},
    Row{"curve map", kGel, "--tilt 0.1mN/m", R"("tilt_N_per_m":0.0001)"},
    Row{"curve map", kGel, "--drift 0.01um/s", R"("drift_m_per_s":1e-08)"},
    Row{"curve map", kGel, "--wave 60pN --wave-period 400nm", R"("wave_period_m":4e-07)"},
    Row{"curve map", kGel, "--points 60", R"("points_per_branch":60)"},
    Row{"curve map", kGel, "--noise 15pN --seed 5", R"("seed":5)"},
    Row{"curve map", kCone, "--half-angle 20deg", R"("half_angle_rad":0.349)"},
    Row{"curve map", "--modulus 3kPa", "--radius 2um", R"("radius_m":2e-06)"},
    Row{"curve map", "--modulus 3kPa", "--spring-constant 0.2N/m", R"("radius_m":1e-06)"},
    Row{"curve map", "--modulus 3kPa", "--most-force 2nN", R"("spring_constant_N_per_m":0.1)"},
    Row{"curve map", "--modulus 3kPa", "--poisson 0.4", R"("most_force_N":1e-09)"},
    Row{"curve map", kCone, "--speed 2um/s", R"("half_angle_rad":0.3,)"},
    Row{"curve map", kSticky, "--atomic-distance 0.2nm", R"("atomic_distance_m":2e-10)"},
    Row{"curve map", kSticky, "", R"("work_of_adhesion_J_per_m2":0.02)"},
    Row{"curve", kGel, "--noise 15pN --count 3", R"("kind":"curve")"},
    Row{"map", kGel, "--pixels 3x2", R"("columns":3)"},
    Row{"map", kGel, "--size 8um", R"("width_m":8e-06)"},
    Row{"map", kGel, "--field step --second-modulus 9kPa", R"("second_modulus_Pa":9000.0)"},
    Row{"map", kSticky, "--field gradient --second-work-of-adhesion 40mJ/m2",
        R"("second_work_of_adhesion_J_per_m2":0.04)"},
    Row{"image", kMica, "--size 30nm", ""},
    Row{"image", kMica, "--size 30nm --x 3nm", ""},
    Row{"image", kMica, "--size 30nm --y 3nm", ""},
    Row{"image", kMica, "--direction up", ""},
    Row{"image", kMica, "--rate 20Hz", R"("line_rate_Hz":20.0)"},
    Row{"image", kMica, "--setpoint 1nN", R"("setpoint_N":1e-09)"},
    Row{"image", kMica, "--integral-gain 500/s", R"("integral_gain_per_s":500.0)"},
    Row{"image", kMica, "--proportional-gain 0.2", R"("proportional_gain":0.2)"},
    Row{"image", kMica, "--loop-rate 200kHz", R"("loop_rate_Hz":200000.0)"},
    Row{"image", kMica, "--detector-delay 50us", R"("detector_delay_s":5e-05)"},
    Row{"image", kMica, "--z-resonance 3kHz", R"("z_resonance_Hz":3000.0)"},
    Row{"image", kMica, "--z-quality-factor 5", R"("z_quality_factor":5.0)"},
    Row{"image", kMica, "--z-range 5um", R"("z_range_m":5e-06)"},
    Row{"image", kMica, "--adhesion 1nN", R"("adhesion_N":1e-09)"},
    Row{"image", kMica, "--snap-in 1nm", R"("snap_in_m":1e-09)"},
    Row{"image", kMica, "--friction-coefficient 0.1", R"("friction_coefficient":0.1)"},
    Row{"image", kMica, "--noise 50pm", R"("noise_m":5e-11)"},
    Row{"image", kMica, "--drift-x 1nm/s", R"("drift_x_m_per_s":1e-09)"},
    Row{"image", kMica, "--drift-y 1nm/s", R"("drift_y_m_per_s":1e-09)"},
    Row{"image", kMica, "--second-apex-distance 5nm", R"("second_apex_distance_m":5e-09)"},
    Row{"image", kMica, "--second-apex-distance 5nm --second-apex-height 0.1nm", R"("second_apex_height_m":1e-10)"},
    Row{"image", kMica, "--no-feedback", ""},
    Row{"image", kMica, "--tip cone --tip-angle 20deg", ""},
    Row{"image", kMica, "--noise 50pm --seed 5", R"("seed":5)"},
    Row{"image", kMica, "--tip-radius 7nm", "7nm"},
    Row{"image", kMica, "--spring-constant 0.2N/m", R"("spring_constant_N_per_m":0.2)"},
    Row{"image", kMica, "--probe mlct-c", "Bruker MLCT, lever C"},
    Row{"image", kMica, "--model jkr", "jkr"},
    Row{"image", kMica, "--atomic-distance 0.2nm", R"("0.2nm, --atomic-distance)"},
    Row{"image", kMica, "--hamaker 30zJ", R"("30zJ, --hamaker)"},
    Row{"image", kMica, "--humidity 40%", R"("40%, --humidity)"},
    Row{"image", kMica, "--reduced-modulus 10GPa", R"("10GPa, --reduced-modulus)"},
    Row{"image", kMica, "--model dmt --retardation 100nm", R"("100nm, --retardation)"},
    Row{"image", kMica, "--model dmt --exact-sphere", R"("Model":"dmt")"},
    Row{"image", kMica, "--sample-stiffness 5N/m", R"("5N/m, --sample-stiffness)"},
    Row{"image", kMica, "--work-of-adhesion 20mJ/m2", R"("20mJ/m2, --work-of-adhesion)"},
    Row{"image", kMica, "--model dynamic-dmt --temperature 400K", R"("400K, --temperature)"},
    Row{"image", kMica, "--model dynamic-dmt --resonance 20kHz", R"("20kHz, --resonance)"},
    Row{"image", kMica, "--model dynamic-dmt --quality-factor 3", R"("3, --quality-factor)"},
    Row{"image", kMica, "--sample mica.gwy --sample-channel Height --level none", "mica.gwy"},
};

// Names of the options in a help text.
std::set<std::string> options_of(const std::string& kind) {
  std::istringstream help(run_touchafm("generate " + kind + " --help").out);
  std::set<std::string> names;
  for (std::string line, word; std::getline(help, line);) {
    std::istringstream words(line);
    if (words >> word && word.starts_with("--")) names.insert(word.substr(0, word.find_first_of(",=[")));
  }
  return names;
}

TEST(GenerateOptions, HaveEachItsEffect) {
  const support::ScratchFolder folder;
  int number = 0;
  // creates FILE and its truth, or nothing
  const auto made = [&](const std::string& kind, std::string_view options) {
    const std::string file = fmt::format("{}.{}", ++number, kind == "image" ? "gwy" : "h5");
    const auto result = support::run_program(
        fmt::format("cd {} && {} generate {} {} --out {}", folder.path(), support::touchafm(), kind, options, file));
    EXPECT_EQ(result.exit_code, 0) << kind << " " << options << ": " << result.err;
    const auto truth = core::read_file(folder.file(file + ".truth.json"));
    nlohmann::json parsed = truth ? nlohmann::json::parse(*truth) : nlohmann::json::object();
    parsed.erase("surface");  // name of a file
    return std::pair(core::read_file(folder.file(file)).value_or(""), parsed.dump());
  };
  ASSERT_EQ(run_touchafm("generate image --material mica --pixels 8 --out " + folder.file("mica.gwy")).exit_code, 0);
  for (const std::string kind : {"curve", "map", "image"}) {
    std::set<std::string> seen{"--help", "--out", "--materials", "--probes"};
    std::map<std::string, std::string> plain;  // file of each base
    const std::string few = kind == "map" ? " --pixels 2x2" : "";
    for (const Row& row : kRows) {
      if (row.kinds.find(kind) == std::string_view::npos) continue;
      const std::string all = fmt::format("{} {}", row.base, row.added);
      std::istringstream words(all);
      for (std::string word; words >> word;) {
        if (word.starts_with("--")) seen.insert(word);
      }
      const auto with = made(kind, all + (all.find("--pixels") == std::string::npos ? few : ""));
      EXPECT_THAT(with.second, HasSubstr(std::string(row.truth))) << kind << " " << all;
      if (row.added.empty()) continue;
      const std::string base = std::string(row.base) + few;
      if (!plain.contains(base)) plain[base] = made(kind, base).first;
      EXPECT_TRUE(with.first != plain[base]) << kind << " " << all << ": the same file";
    }
    for (const std::string& option : options_of(kind)) {
      EXPECT_TRUE(seen.contains(option)) << "no row has " << option << " of generate " << kind;
    }
  }
}

}  // namespace generate_options_test
}  // namespace afm

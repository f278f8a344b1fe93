// SPDX-License-Identifier: Apache-2.0
// Invariant: a slow scan of the microscope shows the felt surface
#include "app/commands/scan_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/whole_file.h"
#include "curves/sample_model.h"
#include "haptics/contact_model.h"
#include "haptics/simulated_device.h"
#include "imaging/scan_surface.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/graph/height_field.h"
#include "support/image_files.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace scan_command_test {

using testing::HasSubstr;

ScanOptions options_for(const std::string& material) {
  ScanOptions options;
  options.contact.assets_dir = support::source("assets");
  options.contact.material = material;
  options.pixels = 16;
  return options;
}

void set(ScanOptions& options, std::string_view name, double si) {
  const auto field = std::find_if(physics::kScanFields.begin(), physics::kScanFields.end(),
                                  [&](const physics::ScanField& each) { return each.name == name; });
  ASSERT_NE(field, physics::kScanFields.end());
  options.settings.emplace_back(&*field, si);
}

// The values of a channel in a .gwy file.
std::vector<double> values_of(const std::string& gwy, int channel) {
  const std::size_t field = gwy.find("/" + std::to_string(channel) + "/data");
  const std::size_t data = gwy.find(std::string("\0data\0D", 7).substr(1), field);
  std::uint32_t count = 0;
  std::memcpy(&count, gwy.data() + data + 6, sizeof count);
  std::vector<double> values(count);
  std::memcpy(values.data(), gwy.data() + data + 10, count * sizeof(double));
  return values;
}

// Surface rendered by the servo for this material, made in the same way.
haptics::SampleSurface felt_surface(const ScanOptions& options) {
  const auto setup = contact_setup(options.contact);
  const auto material = curves::make_sample_model(*setup);
  const auto model = scene::load_gltf(support::source("assets/models/sample-") + options.contact.material + ".glb");
  const auto drawn = scene::height_field_below(*model, model->find_node("surface").value());
  const haptics::DeviceSpec device = haptics::SimulatedDevice().spec();
  const auto common = haptics::Scaling::common_scale(std::array{material->tables}, device);
  return (*haptics::ContactModel::create(material->parameters, 0, material->tables, &*drawn, *common, device,
                                         1'000'000))
      ->surface();
}

TEST(ScanCommand, ShowsAtZeroSpeedWhatAHandFeels) {
  for (const char* material : {"mica", "gold", "si3n4"}) {
    const support::ScratchFolder folder;
    ScanOptions options = options_for(material);
    options.out = folder.file("image.gwy");
    options.size = physics::Length(30e-9);
    set(options, "line_rate", 0.01);
    set(options, "loop_rate", 20e3);
    ASSERT_TRUE(write_scan_command(options));
    const std::vector<double> height = values_of(core::read_file(options.out).value(), 0);
    ASSERT_EQ(height.size(), 256U);
    const haptics::SampleSurface felt = felt_surface(options);
    double relief_m = 0.0;
    for (std::size_t i = 0; i < height.size(); ++i) {
      const double x_m = (static_cast<double>(i % 16) + 0.5) / 16.0 * 30e-9 - 15e-9;
      const double y_m = 15e-9 - (static_cast<double>(i / 16) + 0.5) / 16.0 * 30e-9;
      ASSERT_NEAR(height[i], felt.at({x_m, y_m}).height_m, 1e-12) << material;
      relief_m = std::max(relief_m, std::abs(height[i]));
    }
    EXPECT_GT(relief_m, 0.1e-9) << material;
  }
}

// Under a paraboloid the surface that a hand feels there; under any tip one level plane.
TEST(ScanCommand, IsLevelBeyondTheRimOfTheSampleAsAHandFeelsIt) {
  for (const char* material : {"mica", "gold", "si3n4"}) {
    const ScanOptions options = options_for(material);
    const haptics::SampleSurface felt = felt_surface(options);
    for (const physics::TipKind kind : {physics::TipKind::Paraboloid, physics::TipKind::Sphere}) {
      const auto surface =
          imaging::scan_surface(*contact_setup(options.contact), {.kind = kind}, options.contact.assets_dir);
      ASSERT_TRUE(surface);
      const double level_m = surface->height_m(1.0, 1.0), half_m = 0.5 * surface->width_m;
      EXPECT_NE(surface->height_m(half_m, 3e-9), level_m);
      for (double along_m = -1e-6; along_m < 1e-6; along_m += 7e-9) {
        EXPECT_EQ(surface->height_m(1e-6, along_m), level_m);
        EXPECT_EQ(surface->height_m(along_m, -1e-6), level_m);
        if (kind == physics::TipKind::Sphere) continue;
        EXPECT_EQ(surface->height_m(-half_m - 3e-9, along_m), felt.at({-half_m - 3e-9, along_m}).height_m);
      }
    }
  }
}

TEST(ScanCommand, HasNoStepFarBesideTheSample) {
  const support::ScratchFolder folder;
  for (const char* material : {"mica", "gold"}) {
    ScanOptions options = options_for(material);
    options.out = folder.file("image.gwy");
    options.size = physics::Length(500e-9);
    options.x_centre = physics::Length(5e-6);
    ASSERT_TRUE(write_scan_command(options));
    const std::vector<double> height = values_of(core::read_file(options.out).value(), 0);
    const auto [low, high] = std::minmax_element(height.begin(), height.end());
    EXPECT_LT(*high - *low, 1e-15) << material;
  }
}

TEST(ScanCommand, ShowsInTheManualsFirstExampleOnlyWhatTheSampleHas) {
  const std::string manual = core::read_file(support::source("docs/manual/measure.md")).value();
  const std::string example = "touchafm scan --material mica --size ";
  const std::size_t first = manual.find(example);
  ASSERT_NE(first, std::string::npos);
  const double size_m = 1e-9 * std::stod(manual.substr(first + example.size()));
  EXPECT_EQ(manual.substr(manual.find(' ', first + example.size()) - 2, 2), "nm");
  const ScanOptions options = options_for("mica");
  const auto surface = imaging::scan_surface(*contact_setup(options.contact), {}, options.contact.assets_dir);
  ASSERT_TRUE(surface);
  EXPECT_LE(size_m, surface->width_m * (1.0 + 1e-9));
  EXPECT_GT(size_m, 0.5 * surface->width_m);
}

// ---- a sample of one's own ----

constexpr double kWaveM = 10e-9, kPeriodM = 500e-9, kOwnSideM = 2e-6;

double own_height_m(double x_m) { return kWaveM * std::sin(2.0 * 3.14159265358979 * x_m / kPeriodM); }

std::string write_own_sample(const support::ScratchFolder& folder) {
  constexpr int kSide = 128;
  std::vector<float> heights;
  for (int i = 0; i < kSide * kSide; ++i) {
    heights.push_back(static_cast<float>(own_height_m(((i % kSide + 0.5) / kSide - 0.5) * kOwnSideM)));
  }
  return folder.write("own.gsf", test::gsf_file("XRes = 128\nYRes = 128\nXReal = 2e-6\nYReal = 2e-6\nXYUnits = m\n"
                                                "ZUnits = m\n",
                                                heights));
}

TEST(ScanCommand, ScansASampleOfOnesOwnAsItWasMeasuredAndUnderATipAsTheSampleItself) {
  const support::ScratchFolder folder;
  ScanOptions options = options_for("mica");
  options.sample.file = write_own_sample(folder);
  options.sample.reading.levelling = physics::Levelling::None;
  options.out = folder.file("image.gwy");
  options.pixels = 64;
  set(options, "line_rate", 0.05);
  set(options, "loop_rate", 20e3);
  ASSERT_TRUE(write_scan_command(options));
  const std::string bytes = core::read_file(options.out).value();
  EXPECT_THAT(bytes, HasSubstr("own.gsf"));
  const std::vector<double> height = values_of(bytes, 0);
  ASSERT_EQ(height.size(), 64U * 64U);
  const double scanned_m = kOwnSideM * 127.0 / 128.0;  // distance from the first point to the last
  for (std::size_t i = 0; i < height.size(); ++i) {
    const double x_m = ((static_cast<double>(i % 64) + 0.5) / 64.0 - 0.5) * scanned_m;
    // levelled, 0 at the origin, and linear between points
    ASSERT_NEAR(height[i], own_height_m(x_m), 0.1e-9);
  }

  options.sample.is_traced = false;
  options.tip.kind = physics::TipKind::Sphere;
  options.contact.values["tip-radius"] = "200nm";
  ASSERT_TRUE(write_scan_command(options));
  const std::vector<double> blunt = values_of(core::read_file(options.out).value(), 0);
  double lift_m = 0.0;
  for (std::size_t i = 0; i < blunt.size(); ++i) {
    ASSERT_GE(blunt[i], height[i] - 0.1e-9);
    lift_m = std::max(lift_m, blunt[i] - height[i]);
  }
  EXPECT_GT(lift_m, 0.5e-9);
}

TEST(ScanCommand, RefusesASampleThatIsNone) {
  const support::ScratchFolder folder;
  ScanOptions options = options_for("mica");
  options.out = folder.file("image.gwy");
  options.sample.file = folder.write("notes.txt", "no image");
  const auto written = write_scan_command(options);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(written.error().message, HasSubstr("neither a glTF model nor an image"));
}

// Depth of the trenches below the bars, of a paraboloid's image: in the middle of one on the left and one on the right.
std::pair<double, double> depth_of_gratings(double radius_m) {
  const ScanOptions options = options_for("mica");
  const auto setup = *contact_setup(options.contact);
  const physics::TipShape tip{.radius = physics::Length(radius_m)};
  const auto surface =
      imaging::scan_surface(setup, tip, options.contact.assets_dir, {.file = imaging::kGratings, .reading = {}});
  EXPECT_TRUE(surface);
  EXPECT_NEAR(surface->width_m, 1.2e-6, 1e-15);
  const double wide_m = surface->height_m(-100e-9, 7e-9) - surface->height_m(-200e-9, -7e-9);
  const double narrow_m = surface->height_m(50e-9, 7e-9) - surface->height_m(100e-9, -7e-9);
  return {wide_m, narrow_m};
}

TEST(ScanCommand, TracesTheIncludedGratingsAsDeepAsTheTipReaches) {
  const auto sharp = depth_of_gratings(1e-9), usual = depth_of_gratings(50e-9), blunt = depth_of_gratings(400e-9);
  EXPECT_NEAR(sharp.first, 10e-9, 1e-15);
  EXPECT_NEAR(sharp.second, 10e-9, 1e-15);
  EXPECT_NEAR(usual.first, 10e-9, 1e-15);
  // x^2/2R to the edges of the bars, between two points of 2.5 nm
  EXPECT_NEAR(usual.second, 25e-9 * 25e-9 / 100e-9, 0.7e-9);
  EXPECT_NEAR(blunt.first, 50e-9 * 50e-9 / 800e-9, 0.2e-9);
  EXPECT_NEAR(blunt.second, 25e-9 * 25e-9 / 800e-9, 0.1e-9);
}

TEST(ScanCommand, MakesTheImageOfABluntTipHigherOrEqual) {
  ScanOptions options = options_for("gold");
  physics::TipShape ball{.kind = physics::TipKind::Sphere, .radius = physics::Length(5e-9)};
  const auto setup = *contact_setup(options.contact);
  const auto sharp = imaging::scan_surface(setup, ball, options.contact.assets_dir);
  ball.radius = physics::Length(80e-9);
  const auto blunt = imaging::scan_surface(setup, ball, options.contact.assets_dir);
  ASSERT_TRUE(sharp && blunt);
  double lift_m = 0.0;
  for (int i = -50; i <= 50; ++i) {
    const double difference_m = blunt->height_m(2e-9 * i, 1e-9 * i) - sharp->height_m(2e-9 * i, 1e-9 * i);
    EXPECT_GE(difference_m, -1e-18);
    lift_m = std::max(lift_m, difference_m);
  }
  EXPECT_GT(lift_m, 0.1e-9);
}

TEST(ScanCommand, WritesEveryChannelAndEveryParameter) {
  const support::ScratchFolder folder;
  ScanOptions options = options_for("mica");
  options.out = folder.file("image.gwy");
  options.show_truth = true;
  set(options, "setpoint", 0.75e-9);
  ASSERT_TRUE(write_scan_command(options));
  const std::string bytes = core::read_file(options.out).value();
  for (const char* part :
       {"Height", "Height (retrace)", "Error", "Error (retrace)", "Lateral force", "Lateral force (retrace)",
        "Reconstruction", "Certainty", "Tip from the image", "/8/meta", "750 pN", "Tip radius", "50 nm"}) {
    EXPECT_THAT(bytes, HasSubstr(std::string(part) + '\0')) << part;
  }
  for (const physics::ScanField& field : physics::kScanFields) {
    std::string key(field.name.substr(1));
    std::replace(key.begin(), key.end(), '_', ' ');
    EXPECT_THAT(bytes, HasSubstr(key + '\0')) << field.name;
  }
}

TEST(ScanCommand, WritesOneChannelAsAFieldAndAPicture) {
  const support::ScratchFolder folder;
  ScanOptions options = options_for("mica");
  options.out = folder.file("image.gsf");
  options.picture = folder.file("image.png");
  options.channel = "Lateral force";
  ASSERT_TRUE(write_scan_command(options));
  const std::string field = core::read_file(options.out).value();
  EXPECT_THAT(field, HasSubstr("ZUnits = N\nTitle = Lateral force\nSoftware = TouchAFM "));
  EXPECT_THAT(field, HasSubstr("\nMaterial = mica\n"));
  EXPECT_GT(core::read_file(options.picture).value().size(), 1000U);
}

TEST(ScanCommand, RefusesBeforeItScansAndWritesNothing) {
  const support::ScratchFolder folder;
  const auto refusal = [&](auto change) {
    ScanOptions options = options_for("mica");
    options.out = folder.file("image.gwy");
    change(options);
    const auto written = write_scan_command(options);
    EXPECT_FALSE(written);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_EQ(written.error().category, core::ErrorCategory::WrongUsage) << written.error().message;
    return written.error().message;
  };
  EXPECT_THAT(refusal([](ScanOptions& options) { options.out.clear(); }), HasSubstr("--out"));
  EXPECT_THAT(refusal([&](ScanOptions& options) { options.out = folder.file("image.tif"); }),
              HasSubstr(".gwy or .gsf"));
  EXPECT_THAT(refusal([](ScanOptions& options) { options.picture = "image.jpg"; }), HasSubstr(".png"));
  EXPECT_THAT(refusal([](ScanOptions& options) { options.channel = "Phase"; }), HasSubstr("Lateral force (retrace)"));
  EXPECT_THAT(refusal([](ScanOptions& options) { options.contact.material = "granite"; }), HasSubstr("mica"));
}

}  // namespace scan_command_test
}  // namespace afm::app

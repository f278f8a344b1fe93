// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/analyse_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "app/analyse/reading_options.h"
#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "curves/curve_report.h"
#include "curves/image_file.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace analyse_command_test {

using testing::HasSubstr;

physics::ContactParameters mica(double spring_constant) {
  return {.tip_radius = physics::Length(50e-9),
          .spring_constant = physics::Stiffness(spring_constant),
          .sample_stiffness = physics::Stiffness(std::numeric_limits<double>::infinity()),
          .hamaker = physics::Energy(24.5e-21),
          .mean_surface_energy = physics::SurfaceEnergy(2.228e-3)};
}

curves::RecordedCurve mica_curve(double spring_constant) {
  const auto curve = physics::record_curve(physics::ApproachRetractModel(mica(spring_constant)),
                                           {physics::Length(40e-9), physics::Length(-5e-9), physics::Length(0.05e-9)});
  return curves::recorded_curve(curve, physics::Stiffness(spring_constant));
}

std::string error_of(const AnalyseOptions& options, core::ErrorCategory category) {
  const auto done = analyse_curve_file(options);
  if (done) return "done";
  EXPECT_EQ(done.error().category, category) << done.error().message;
  return done.error().message;
}

TEST(CurveReport, SaysEveryFigureWithItsUnit) {
  const auto curve = curves::analysed("mica.tab", mica_curve(0.1));
  ASSERT_TRUE(curve.has_value());
  const std::string text = curves::features_text(*curve, nullptr);
  for (const char* expected :
       {"mica.tab: ", "100 mN/m", "snap-in at              2.398 nm", "pull-off at                14 nm", "-1.4 nN",
        "loop energy             9.511 aJ", "contact slope           100 mN/m"}) {
    EXPECT_THAT(text, HasSubstr(expected));
  }
  EXPECT_THAT(text, testing::Not(HasSubstr("difference")));
}

TEST(CurveReport, NamesTheMethodOfTheContactPointAndWhatTheOthersSay) {
  curves::RecordedCurve recorded = test::hertz_curve();
  recorded.metadata.software = "an instrument's";
  const auto curve = curves::analysed("hertz", recorded);
  ASSERT_TRUE(curve.has_value());
  EXPECT_THAT(curves::features_text(*curve, nullptr), HasSubstr("fit-polynomial  (all methods: "));
  const auto json = curves::features_json(*curve, nullptr);
  EXPECT_EQ(json.at("contact_point_method"), "fit-polynomial");
  EXPECT_EQ(json.at("contact_point_doubtful"), false);
  EXPECT_EQ(json.at("contact_point_methods_m").size(), 6U);
  const auto range_m = json.at("contact_point_range_m").get<std::vector<double>>();
  ASSERT_EQ(range_m.size(), 2U);
  EXPECT_LE(range_m[0], 0.0);
  EXPECT_GE(range_m[1], 0.0);
  EXPECT_NEAR(json.at("contact_point_m").get<double>(), 0.0, 1e-9);
  const auto chosen = curves::analysed("hertz", recorded, physics::ContactMethod::Gradient);
  EXPECT_EQ(chosen->features.contact_point->si, json.at("contact_point_methods_m").at("gradient").get<double>());
}

TEST(CurveReport, IsInSiAsJson) {
  const auto json = curves::features_json(*curves::analysed("mica", mica_curve(0.1)), nullptr);
  EXPECT_NEAR(json.at("snap_in_z_m").get<double>(), 2.39752e-9, 1e-13);
  EXPECT_NEAR(json.at("pull_off_force_N").get<double>(), -1.399894e-9, 1e-14);
  EXPECT_NEAR(json.at("loop_energy_J").get<double>(), 9.5111e-18, 1e-21);
  EXPECT_EQ(json.at("spring_constant_N_per_m").get<double>(), 0.1);
  const auto hertz = curves::features_json(*curves::analysed("hertz", test::hertz_curve()), nullptr);
  EXPECT_TRUE(hertz.at("snap_in_z_m").is_null());
  EXPECT_TRUE(hertz.at("pull_off_force_N").is_null());
}

TEST(CurveReport, SetsTwoCurvesBesideEachOther) {
  const auto soft = curves::analysed("soft", mica_curve(0.1)), stiff = curves::analysed("stiff", mica_curve(0.2));
  const auto json = curves::features_json(*soft, &*stiff);
  EXPECT_NEAR(json.at("difference").at("pull_off_z_m").get<double>(),
              json.at("pull_off_z_m").get<double>() - json.at("beside").at("pull_off_z_m").get<double>(), 1e-18);
  EXPECT_NEAR(json.at("difference").at("pull_off_force_N").get<double>(), 0.0, 1e-20);
  EXPECT_FALSE(json.at("difference").contains("contact_point_m"));  // an instrument's zero is nothing to compare
  EXPECT_THAT(curves::features_text(*soft, &*stiff), HasSubstr("stiff"));
  EXPECT_EQ(curves::features_plot(*soft, &*stiff).lines.size(), 4U);
}

TEST(CurveReport, DrawsFromTheContactPointAndTheBaseline) {
  curves::RecordedCurve shifted = mica_curve(0.1);
  shifted.metadata.software = "an instrument's";
  for (auto& point : shifted.points)
    point = {point.z + physics::Length(1e-6), point.force + physics::Force(5e-9), point.branch};
  const auto lines = curves::curve_lines(*curves::analysed("shifted", shifted), "red");
  EXPECT_NEAR(lines[0].points.front().x, 40.0, 1e-6);
  EXPECT_NEAR(lines[0].points.front().y, 0.0, 1e-6);
}

TEST(AnalyseCommand, WritesAPictureOfACurveBesideAnother) {
  const support::ScratchFolder folder;
  ASSERT_TRUE(curves::write_curve(folder.file("a.h5"), curves::CurveFormat::Hdf5, mica_curve(0.1)).has_value());
  ASSERT_TRUE(curves::write_curve(folder.file("b.tab"), curves::CurveFormat::Tab, mica_curve(0.2)).has_value());
  AnalyseOptions options;
  options.file = folder.file("a.h5");
  options.beside = folder.file("b.tab");
  options.out = folder.file("ab.svg");
  ASSERT_TRUE(analyse_curve_file(options).has_value());
  const auto picture = core::read_file(options.out);
  ASSERT_TRUE(picture.has_value());
  EXPECT_THAT(*picture, HasSubstr("pull-off -1.4 nN"));
  EXPECT_THAT(*picture, HasSubstr("b.tab, retract"));
}

TEST(AnalyseCommand, RefusesWrongOptionsAndFilesAndWritesNothing) {
  const support::ScratchFolder folder;
  AnalyseOptions options;
  options.out = folder.file("a.svg");
  options.file = folder.file("missing.tab");
  EXPECT_THAT(error_of(options, core::ErrorCategory::BadInputFile), HasSubstr("there is no such file"));
  options.file =
      folder.write("half.tab", curves::curve_bytes(curves::CurveFormat::Tab, mica_curve(0.1))->substr(0, 20000));
  EXPECT_THAT(error_of(options, core::ErrorCategory::BadInputFile), HasSubstr("cannot read the curve"));
  // a folder is called one, and a file of no kind gets every format that is read
  options.file = folder.path();
  EXPECT_THAT(error_of(options, core::ErrorCategory::BadInputFile), HasSubstr("it is a folder, not a file"));
  options.file = folder.write("notes.afms", "no session");
  const std::string unknown = error_of(options, core::ErrorCategory::BadInputFile);
  for (const char* known : {curves::kCurveFiles, curves::kImageFiles, ".afms"}) {
    EXPECT_THAT(unknown, HasSubstr(known));
  }
  EXPECT_FALSE(std::filesystem::exists(options.out));
}

TEST(AnalyseCommand, SaysHowATableIsRead) {
  const support::ScratchFolder folder;
  AnalyseOptions options;
  options.file = folder.write("table.txt", "height force\n1 0\n2 0\n");
  EXPECT_THAT(error_of(options, core::ErrorCategory::BadInputFile), HasSubstr("--columns \"height:um force:nN\""));
  options.file = folder.write("empty.txt", "");
  EXPECT_THAT(error_of(options, core::ErrorCategory::BadInputFile),
              HasSubstr("it is an empty file; copy or export it again"));
}

TEST(AnalyseCommand, ReadsASensitivityThatIsADeflectionPerVolt) {
  EXPECT_DOUBLE_EQ(parse_sensitivity("70nm/V").value(), 70e-9);
  const std::vector<std::pair<const char*, const char*>> refused{
      {"70nm", "\"nm\" is not its unit"},
      {"70/V", "is not its unit"},
      {"/V", "it does not begin with a number"},
      {"70", "it has no unit"},
      {"-70nm/V", "is not above 0"},
      {"0nm/V", "is not above 0"},
      {"0,05um/V", "write a decimal point, and no separator of thousands"}};
  for (const auto& [wrong, why] : refused) {
    const auto sensitivity = parse_sensitivity(wrong);
    ASSERT_FALSE(sensitivity.has_value()) << wrong;
    EXPECT_EQ(sensitivity.error().category, core::ErrorCategory::WrongUsage);
    EXPECT_THAT(sensitivity.error().message, HasSubstr(why));
  }
}

TEST(FitOfACurve, HasEveryNumberWithItsUnitInTextAndJson) {
  const auto curve = curves::analysed("gel.tab", test::hertz_curve());
  ASSERT_TRUE(curve.has_value());
  curves::FitOptions options;
  options.shape = fits::Shape::Paraboloid;
  options.radius_m = test::kHertzRadiusM;
  ASSERT_TRUE(prepare(options));
  const auto fit = fit_of(*curve, options);
  ASSERT_TRUE(fit) << fit.error().message;
  const std::string text = fit_text(*fit, options);
  for (const char* expected :
       {"fit of paraboloid (Hertz 1881", "R = 5 um, nu = 0.5", "force against Z", "3 kPa", "trusted"}) {
    EXPECT_THAT(text, HasSubstr(expected));
  }
  const auto json = fit_json(*fit, options);
  EXPECT_NEAR(json.at("modulus_Pa").get<double>(), test::kHertzModulusPa, 1e-3);
  EXPECT_NEAR(json.at("contact_m").get<double>(), 0.0, 1e-12);
  EXPECT_EQ(json.at("half_angle_rad"), nullptr);
  EXPECT_EQ(json.at("trust"), "trusted");
  EXPECT_TRUE(json.at("doubts").empty());
  const curves::SvgLine line = fit_line(*curve, *fit, options);
  EXPECT_EQ(line.points.size(), 2000U);
}

// A gel that stiffens from 0.8 um of the base's way on.
TEST(FitOfACurve, OfAPartHasThatPartsModulus) {
  curves::RecordedCurve recorded = test::hertz_curve();
  for (physics::CurvePoint& point : recorded.points) {
    point.force = point.force + physics::Force(0.01 * std::max(-0.8e-6 - point.z.si, 0.0));
  }
  const auto curve = curves::analysed("gel.tab", recorded);
  ASSERT_TRUE(curve.has_value());
  curves::FitOptions options;
  options.shape = fits::Shape::Paraboloid;
  options.radius_m = test::kHertzRadiusM;
  EXPECT_GT(fit_of(*curve, options)->modulus_pa, 1.1 * test::kHertzModulusPa);
  options.most_force_n = 3e-9;
  const auto by_force = fit_of(*curve, options);
  ASSERT_TRUE(by_force) << by_force.error().message;
  EXPECT_NEAR(by_force->modulus_pa, test::kHertzModulusPa, 1.0);
  EXPECT_EQ(fit_line(*curve, *by_force, options).points.size(), by_force->points);
  options.most_force_n = std::numeric_limits<double>::infinity();
  options.most_depth_m = 0.4e-6;
  const auto by_depth = fit_of(*curve, options);
  ASSERT_TRUE(by_depth) << by_depth.error().message;
  EXPECT_NEAR(by_depth->modulus_pa, test::kHertzModulusPa, 1.0);
  EXPECT_NEAR(by_depth->depth_m, 0.4e-6, 0.1e-6);
}

TEST(FitOfACurve, HasTheSystematicPartApart) {
  const auto curve = curves::analysed("gel.tab", test::hertz_curve());
  ASSERT_TRUE(curve.has_value());
  curves::FitOptions options;
  options.shape = fits::Shape::Paraboloid;
  options.radius_m = test::kHertzRadiusM;
  options.uncertainty_texts = {"spring-constant=8%", "radius=12%"};
  ASSERT_TRUE(prepare(options));
  const auto fit = fit_of(*curve, options);
  ASSERT_TRUE(fit) << fit.error().message;
  const auto json = fit_json(*fit, options).at("systematic");
  // E ~ k and ~ R^(-1/2)
  EXPECT_NEAR(json.at("modulus_Pa").get<double>(), 0.1 * test::kHertzModulusPa, 1e-3 * test::kHertzModulusPa);
  EXPECT_EQ(json.at("parts").size(), 2U);
  EXPECT_EQ(json.at("work_J_per_m2"), nullptr);
  EXPECT_THAT(fit_text(*fit, options), HasSubstr("systematic of E"));
  for (const char* wrong : {"radius", "radius=", "radius=%", "radius=5", "radius=-5%", "radius=0%", "radius=nan%",
                            "radius=51%", "radius=1e999%", "tip=5%", "=5%", "", "half-angle=5%", "layer=5%"}) {
    options.uncertainty_texts = {wrong};
    EXPECT_FALSE(prepare(options)) << wrong;
  }
  options.uncertainty_texts = {"radius=5%", "radius=6%"};
  EXPECT_FALSE(prepare(options));
  options.uncertainty_texts = {"poisson=5%"};
  EXPECT_TRUE(prepare(options));
  options.poisson = 0.0;
  EXPECT_FALSE(prepare(options));
  options.poisson = 0.5;
  options.shape = fits::Shape::LayerSphere;
  options.layer_m = 1e-6;
  EXPECT_FALSE(prepare(options));
}

// JKR by closed formulas: R = 1 um, E* = 10 MPa, W = 50 mJ/m2, k = 1 N/m, from 1 um above to a push of 1 uN.
TEST(FitOfACurve, WithAdhesionHasBothBranches) {
  constexpr double kRadius = 1e-6, kReduced = 10e6, kWork = 50e-3, kSpring = 1.0, kTop = 1e-6, kBottom = -1.2e-6;
  using std::numbers::pi;
  const auto force_n = [](double a) {
    return 4.0 * kReduced * a * a * a / (3.0 * kRadius) - std::sqrt(8.0 * pi * kWork * kReduced * a * a * a);
  };
  const auto way_m = [&](double a) {
    return a * a / kRadius - std::sqrt(2.0 * pi * kWork * a / kReduced) + force_n(a) / kSpring;
  };
  double fold_m = 2e-7;  // contact radius at which this lever jumps off
  for (double a = 1e-7; a < 4e-7; a += 1e-11) fold_m = way_m(a) < way_m(fold_m) ? a : fold_m;
  curves::RecordedCurve recorded = test::hertz_curve(3000);
  recorded.metadata.spring_constant = physics::Stiffness(kSpring);
  for (std::size_t i = 0; i < recorded.points.size(); ++i) {
    physics::CurvePoint& point = recorded.points[i];
    const std::size_t from_top = point.branch == physics::Branch::Approach ? i : recorded.points.size() - 1 - i;
    const double z_m = std::lerp(kTop, kBottom, static_cast<double>(from_top) / 2999.0);
    point = {physics::Length(z_m), physics::Force(), point.branch};
    if (z_m > (point.branch == physics::Branch::Approach ? 0.0 : -way_m(fold_m))) continue;
    double inner = 1e-5, outer = fold_m;
    for (int step = 0; step < 80; ++step) {
      const double middle = 0.5 * (inner + outer);
      (way_m(middle) > -z_m ? inner : outer) = middle;
    }
    point.force = physics::Force(force_n(inner));
  }
  const auto curve = curves::analysed("pdms.tab", recorded);
  ASSERT_TRUE(curve.has_value());
  curves::FitOptions options;
  options.shape = fits::Shape::Auto;
  options.radius_m = kRadius;
  ASSERT_TRUE(prepare(options));
  const auto fit = fit_of(*curve, options);
  ASSERT_TRUE(fit) << fit.error().message;
  const auto json = fit_json(*fit, options);
  EXPECT_NEAR(json.at("reduced_modulus_Pa").get<double>(), kReduced, 1e-6 * kReduced);
  EXPECT_EQ(json.at("adhesion").at("law"), "jkr");
  EXPECT_NEAR(json.at("adhesion").at("work_J_per_m2").get<double>(), kWork, 1e-6 * kWork);
  EXPECT_NEAR(json.at("adhesion").at("pull_off_N").get<double>(), 2.35619449e-7, 1e-12);
  for (const char* expected : {"work of adhesion", "50 mJ/m2", "Tabor parameter", "jkr", "z0 = 300 pm"}) {
    EXPECT_THAT(fit_text(*fit, options), HasSubstr(expected));
  }
  const curves::SvgLine line = fit_line(*curve, *fit, options);
  EXPECT_GE(std::count_if(line.points.begin(), line.points.end(), [](const auto& p) { return std::isnan(p.y); }), 2);
  EXPECT_GT(line.points.size(), fit->points);
  options.against = fits::Against::Tip;
  EXPECT_FALSE(prepare(options));
}

TEST(FitOfACurve, IsRefusedWithoutWhatItNeeds) {
  const auto refusal = [](curves::FitOptions options) {
    const auto checked = prepare(options);
    EXPECT_FALSE(checked);
    return checked ? "accepted" : checked.error().message;
  };
  curves::FitOptions options;
  options.radius_m = 1e-6;
  EXPECT_THAT(refusal(options), HasSubstr("without --fit"));
  options.shape = fits::Shape::Cone;
  EXPECT_THAT(refusal(options), HasSubstr("no use for --radius"));
  options.radius_m = 0.0;
  EXPECT_THAT(refusal(options), HasSubstr("needs --half-angle"));
  options.shape = fits::Shape::LayerCone;
  options.half_angle_rad = 0.3;
  EXPECT_THAT(refusal(options), HasSubstr("needs --layer"));
  options.layer_m = 1e-6;
  options.poisson = 0.3;
  EXPECT_THAT(refusal(options), HasSubstr("leave --poisson out"));
  options.poisson = 0.5;
  EXPECT_TRUE(prepare(options));
  options.base = fits::Base::Sliding;
  EXPECT_THAT(refusal(options), HasSubstr("no use for --base"));
  options.shape = fits::Shape::LayerExactCone;
  options.poisson = 0.3;
  ASSERT_TRUE(prepare(options));
  EXPECT_NE(options.table, nullptr);

  curves::RecordedCurve volts = test::hertz_curve();
  volts.metadata.spring_constant.reset();
  const auto fit = fit_of(*curves::analysed("volts", volts), options);
  ASSERT_FALSE(fit);
  EXPECT_THAT(fit.error().message, HasSubstr("give --spring-constant"));
}

}  // namespace analyse_command_test
}  // namespace afm::app

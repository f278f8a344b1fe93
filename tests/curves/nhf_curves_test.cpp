// SPDX-License-Identifier: Apache-2.0
// Spectroscopy of Nanosurf Studio, from files that are put together here as its maker's published scripts read them.
#include <gmock/gmock.h>
#include <hdf5.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "curves/curve_map.h"
#include "curves/curve_series.h"
#include "curves/image_file.h"
#include "nhf_pieces.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace nhf_curves_test {

using test::put;
using testing::Contains;
using testing::HasSubstr;

constexpr int kPoints = 20, kCurves = 6;
constexpr double kSpring = 0.2, kSensitivity = 1.5e-7, kHeightStep_m = 1e-9, kVolt = 1e-4;

// The contact lies after the fifteenth point of the approach, and rises by a step from curve to curve.
int height_at(int curve, int point) { return 10 * (kPoints - point) + curve; }
int signal_at(int curve, int point) { return point > 14 ? 100 * (point - 14) * (curve + 1) : 0; }

struct File {
  double version = 2;
  std::string unit = "Volt (V)";
  bool calibrated = true, has_counts = true;
  std::vector<std::string> parts{"Advance to Setpoint 1", "Retract 1"};
  int shorter = 0;  // missing points of the last curve
};

template <class Integer>
void put_set(hid_t at, const char* link, const std::vector<Integer>& numbers, hid_t kind, const auto& describe) {
  const hsize_t count = numbers.size();
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t set = H5Dcreate2(at, link, kind, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(set, kind, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), 0);
  describe(set);
  H5Dclose(set);
  H5Sclose(space);
}

class NhfCurve : public testing::Test {
 protected:
  // A grid of 3 x 2 curves, 3 um wide and 2 um high.
  std::string write(const File& file) {
    const bool first = file.version == 1;
    const hid_t id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    put(id, "nsf_file_version_major", std::vector{file.version});
    const hid_t measurement = H5Gcreate2(id, "group_0000", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put(measurement, first ? "measurement_type" : "group_type",
        std::string(first ? "spectroscopy_grid" : "spectroscopy"));
    if (file.calibrated) {
      put(measurement, "spm_probe_calibration_spring_constant", std::vector{kSpring});
      put(measurement, "spm_probe_calibration_deflection_sensitivity", std::vector{kSensitivity});
    }
    put(measurement, "rect_axis_size", std::vector{2.0, 3.0});
    put(measurement, "rect_axis_range", std::vector{2e-6, 3e-6});
    for (std::size_t i = 0; i < file.parts.size(); ++i) {
      put_part(measurement, ("subgroup_" + std::to_string(i)).c_str(), file.parts[i], file);
    }
    H5Gclose(measurement);
    H5Fclose(id);
    return path;
  }

  void put_part(hid_t measurement, const char* link, const std::string& name, const File& file) {
    const bool first = file.version == 1, back = name.starts_with("Retract");
    const hid_t part = H5Gcreate2(measurement, link, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put(part, first ? "name" : "segment_name", name);
    std::vector<std::int32_t> height, signal, counts, offsets;
    for (int curve = 0; curve < kCurves; ++curve) {
      offsets.push_back(static_cast<std::int32_t>(height.size()));
      counts.push_back(curve + 1 == kCurves ? kPoints - file.shorter : kPoints);
      for (int i = 0; i < counts.back(); ++i) {
        const int point = back ? kPoints - 1 - i : i;
        height.push_back(height_at(curve, point));
        signal.push_back(signal_at(curve, point));
      }
      if (first) {  // points that were reserved and not acquired
        height.resize(height.size() + 3);
        signal.resize(signal.size() + 3);
      }
    }
    // the whole range of the integers
    const auto describe = [&](const std::string& channel, double step, const std::string& unit) {
      return [=](hid_t set) {
        put(set, first ? "name" : "signal_name", channel);
        if (first) put(set, "dataset_element_type", std::vector{0.0});
        if (!first) put(set, "dataset_element_type", std::string("int32"));
        const double least = first ? -std::exp2(31) : 1.0 - std::exp2(31), most = std::exp2(31) - 1.0;
        const std::string kind = first ? "base_calibration_" : "signal_calibration_";
        put(set, (kind + "min").c_str(), std::vector{step * least});
        put(set, (kind + "max").c_str(), std::vector{step * most});
        put(set, (kind + "unit").c_str(), unit);
      };
    };
    put_set(part, "dataset_0", height, H5T_NATIVE_INT32, describe("Position Z", kHeightStep_m, "Meter (m)"));
    put_set(part, "dataset_1", signal, H5T_NATIVE_INT32, describe("Deflection", kVolt, file.unit));
    if (!file.has_counts) return void(H5Gclose(part));
    put_set(part, "dataset_2", counts, H5T_NATIVE_INT32, [&](hid_t set) {
      if (first) put(set, "name", std::string("number_of_datapoints_acquired"));
      if (!first) put(set, "dataset_block_size_id", std::string("points"));
    });
    if (first) {
      put_set(part, "dataset_3", offsets, H5T_NATIVE_INT32,
              [](hid_t set) { put(set, "name", std::string("channel_data_offsets")); });
    }
    H5Gclose(part);
  }

  RecordedCurve read(const File& file, std::size_t index) {
    CurveReading reading;
    reading.index = index;
    auto curve = load_curve(write(file), reading);
    EXPECT_TRUE(curve.has_value()) << curve.error().message;
    return curve ? std::move(*curve) : RecordedCurve{std::vector<physics::CurvePoint>(2 * kPoints), {}, {}};
  }

  std::string refusal(const File& file) {
    const auto curve = load_curve(write(file));
    return curve ? "accepted" : curve.error().message;
  }

  support::ScratchFolder folder;
  std::string path = folder.file("gel.nhf");
};

constexpr std::size_t kDeepest = kPoints - 1;

TEST_F(NhfCurve, HasApproachAndRetractOfEitherVersion) {
  for (const double version : {1.0, 2.0}) {
    const RecordedCurve curve = read({.version = version}, 3);
    ASSERT_EQ(curve.points.size(), 2U * kPoints);
    const double deepest_n = signal_at(3, kPoints - 1) * kVolt * kSensitivity * kSpring;
    EXPECT_NEAR(curve.points[kDeepest].force.si, deepest_n, 1e-6 * deepest_n);
    EXPECT_NEAR(curve.points[kDeepest].z.si, height_at(3, kPoints - 1) * kHeightStep_m, 1e-15);
    EXPECT_EQ(curve.points[kDeepest + 1].branch, physics::Branch::Retract);
    EXPECT_NEAR(curve.points.back().z.si, height_at(3, 0) * kHeightStep_m, 1e-15);
    EXPECT_EQ(curve.metadata.spring_constant->si, kSpring);
    EXPECT_EQ(*curve.metadata.sensitivity_m_per_v, kSensitivity);
    ASSERT_TRUE(curve.metadata.pixel);
    EXPECT_EQ(curve.metadata.pixel->column, 2U) << "there and back";
    EXPECT_EQ(curve.metadata.pixel->row, 1U);
  }
}

TEST_F(NhfCurve, IsAForceMapAndNoImage) {
  write({});
  EXPECT_FALSE(is_image_file(path));
  ASSERT_EQ(curve_count(path).value(), 6U);
  const auto map = CurveMap::load(path, [](std::size_t, std::size_t) { return true; });
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->pixels_with_curve(), 6U);
  EXPECT_NEAR(map->heights_m()[0] - map->heights_m()[3], 5 * kHeightStep_m, 1e-15) << "curves 5 and 0";
}

TEST_F(NhfCurve, LeavesOutARest) {
  const RecordedCurve curve = read({.parts = {"Advance to Setpoint 1", "Pause 1", "Retract 1"}}, 0);
  EXPECT_EQ(curve.points.size(), 2U * kPoints);
  EXPECT_THAT(curve.metadata.remarks,
              Contains(HasSubstr("between approach and retract the tip is in a part \"Pause 1\": 20 points there")));
}

TEST_F(NhfCurve, MayBeInNewtonsAndEndEarly) {
  const RecordedCurve curve = read({.unit = "Newton (N)", .shorter = 2}, 5);
  ASSERT_EQ(curve.points.size(), 2U * (kPoints - 2));
  EXPECT_NEAR(curve.points[17].force.si, signal_at(5, 17) * kVolt, 1e-9);
}

TEST_F(NhfCurve, TakesTheCalibrationThatItLacks) {
  CurveReading reading;
  reading.spring_constant = physics::Stiffness(2.0 * kSpring);
  reading.sensitivity_m_per_v = kSensitivity;
  write({.calibrated = false});
  const auto deepest_n = [](int curve) { return signal_at(curve, kPoints - 1) * kVolt * kSensitivity * 2.0 * kSpring; };
  const auto first = load_curve(path, reading);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_NEAR(first->points[kDeepest].force.si, deepest_n(0), 1e-6 * deepest_n(0));
  EXPECT_EQ(first->metadata.spring_constant->si, 2.0 * kSpring);
  int read = 0;
  read_curves(path, kCurves, {}, reading, [&](std::size_t index, const core::Result<RecordedCurve>& curve) {
    EXPECT_TRUE(curve) << curve.error().message;
    const double expected_n = deepest_n(static_cast<int>(index));
    if (curve) {
      EXPECT_NEAR(curve->points[kDeepest].force.si, expected_n, 1e-6 * expected_n);
    }
    ++read;
    return true;
  });
  EXPECT_EQ(read, kCurves);
}

TEST_F(NhfCurve, IsRefusedInOneLineIfItIsNotUnderstood) {
  EXPECT_THAT(refusal({.calibrated = false}), HasSubstr("give --spring-constant and --sensitivity"));
  EXPECT_THAT(refusal({.unit = "Degree (deg)"}), HasSubstr("its deflection is in \"deg\""));
  EXPECT_THAT(refusal({.has_counts = false}), HasSubstr("it does not say how many points"));
  EXPECT_THAT(refusal({.parts = {"Retract 1"}}), HasSubstr("without a force curve"));
  EXPECT_THAT(refusal({.parts = {}}), HasSubstr("without a force curve"));
  const std::string whole = core::read_file(write({})).value();
  for (const double share : {0.3, 0.6, 0.9, 0.99}) {
    const auto cut = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    const auto curve = load_curve(folder.write("cut.nhf", whole.substr(0, cut)));
    ASSERT_FALSE(curve) << share;
    EXPECT_THAT(curve.error().message, HasSubstr("cannot read the curve"));
  }
}

}  // namespace nhf_curves_test
}  // namespace afm::curves

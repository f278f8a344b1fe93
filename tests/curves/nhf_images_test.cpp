// SPDX-License-Identifier: Apache-2.0
// Images of Nanosurf Studio, from files that are put together here as its maker's published reader describes them.
#include <gmock/gmock.h>
#include <hdf5.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "curves/image_file.h"
#include "nhf_pieces.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace nhf_images_test {

using test::put;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int32_t kUnmeasured = std::numeric_limits<std::int32_t>::min();

struct Channel {
  std::string name = "Topography", unit = "Meter (m)";
  std::vector<std::int32_t> integers{0, 1 << 30, -(1 << 30), 1000, 2000, kUnmeasured};  // the first line is the lowest
  bool calibrated = true;
};

struct Segment {
  std::string direction = "Forward";
  std::vector<Channel> channels{{}};
};

void put_channel(hid_t segment, const std::string& link, const Channel& channel, bool first_version) {
  const hsize_t count = channel.integers.size();
  const hid_t space = H5Screate_simple(1, &count, nullptr), made = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_fill_value(made, H5T_NATIVE_INT32, &kUnmeasured);
  const hid_t set = H5Dcreate2(segment, link.c_str(), H5T_STD_I32LE, space, H5P_DEFAULT, made, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(set, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, channel.integers.data()), 0);
  put(set, first_version ? "name" : "signal_name", channel.name);
  if (first_version) put(set, "dataset_element_type", std::vector{0.0});
  if (!first_version) put(set, "dataset_element_type", std::string("int32"));
  if (channel.calibrated) {
    const std::string kind = first_version ? "base_calibration_" : "signal_calibration_";
    put(set, (kind + "min").c_str(), std::vector{-4e-6});
    put(set, (kind + "max").c_str(), std::vector{4e-6});
    put(set, (kind + "unit").c_str(), channel.unit);
  }
  H5Dclose(set);
  H5Pclose(made);
  H5Sclose(space);
}

class NhfImage : public testing::Test {
 protected:
  // An image of 3 x 2 points, 3 um wide and 2 um high.
  std::string write(const std::vector<Segment>& segments, double version = 2,
                    const std::string& kind = "image_line_based") {
    const bool first = version == 1;
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    put(file, "nsf_file_version_major", std::vector{version});
    put(file, "nsf_file_version_minor", std::vector{first ? 1.0 : 0.0});
    const char* link = first ? "measurement_0" : "group_0000";
    const hid_t measurement = H5Gcreate2(file, link, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put(measurement, first ? "measurement_type" : "group_type", kind);
    put(measurement, first ? "name" : "measurement_name", std::string("Scan 1"));
    if (first) {
      put(measurement, "image_points_per_line", std::vector{3.0});
      put(measurement, "image_number_of_lines", std::vector{2.0});
      put(measurement, "image_size_x", std::vector{3e-6});
      put(measurement, "image_size_y", std::vector{2e-6});
    }
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const hid_t segment =
          H5Gcreate2(measurement, ("segment_" + std::to_string(i)).c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      put(segment, first ? "name" : "segment_name", segments[i].direction);
      if (!first) {
        put(segment, "rect_axis_size", std::vector{2.0, 3.0});
        put(segment, "rect_axis_range", std::vector{2e-6, 3e-6});
      }
      for (std::size_t k = 0; k < segments[i].channels.size(); ++k) {
        put_channel(segment, "dataset_" + std::to_string(k), segments[i].channels[k], first);
      }
      H5Gclose(segment);
    }
    H5Gclose(measurement);
    H5Fclose(file);
    return path;
  }

  std::string refusal(const std::string& of, const std::string& channel = {}) {
    const auto image = load_image(of, {.channel = channel});
    return image ? "accepted" : image.error().message;
  }

  support::ScratchFolder folder;
  std::string path = folder.file("scan.nhf");
};

TEST_F(NhfImage, HasTheLinesOfEitherVersionFromTheBottom) {
  for (const double version : {1.0, 2.0}) {
    ASSERT_TRUE(is_image_file(write({{}}, version)));
    const auto image = load_image(path);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->format, ImageFormat::Nhf);
    EXPECT_EQ(image->image.columns, 3U);
    EXPECT_EQ(image->image.rows, 2U);
    EXPECT_DOUBLE_EQ(image->image.width_m, 3e-6);
    EXPECT_DOUBLE_EQ(image->image.height_m, 2e-6);
    ASSERT_EQ(image->image.channels.size(), 1U);
    EXPECT_EQ(image->image.channels[0].unit, "m");
    const auto& heights = image->image.channels[0].values;
    EXPECT_NEAR(heights[0], 4e-6 * 1000 / std::exp2(31), 4e-15);
    EXPECT_NEAR(heights[3], 0.0, 4e-15);
    EXPECT_NEAR(heights[4], 2e-6, 4e-15);
    EXPECT_NEAR(heights[5], -2e-6, 4e-15);
    if (version == 2.0) {
      EXPECT_TRUE(std::isnan(heights[2]));
    } else {
      EXPECT_NEAR(heights[2], -4e-6, 4e-15);
    }
  }
}

TEST_F(NhfImage, NamesTheDirectionAndLeavesOutWhatItCannotRead) {
  Segment forward, backward{.direction = "Backward", .channels = {{}}};
  forward.channels.push_back({.name = "Phase", .unit = "Degree (deg)"});
  forward.channels.push_back({.name = "Raw", .calibrated = false});
  forward.channels.push_back({.name = "Short", .integers = {1, 2}});
  const auto image = load_image(write({forward, backward}));
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_EQ(image->image.channels.size(), 3U);
  EXPECT_EQ(image->image.channels[image->chosen].name, "Topography");
  EXPECT_EQ(image->image.channels[1].unit, "deg");
  EXPECT_EQ(image->image.channels[2].name, "Topography (retrace)");
  ASSERT_EQ(image->unread.size(), 2U);
  EXPECT_EQ(image->unread[0].name, "Raw");
  EXPECT_EQ(image->unread[0].reason, "it has no calibration");
  EXPECT_THAT(image->unread[1].reason, HasSubstr("it has 2 points"));
  EXPECT_THAT(image->image.metadata, ElementsAre(testing::Pair("Name", "Scan 1")));
  EXPECT_THAT(refusal(path, "raw"), HasSubstr("its channel Raw cannot be read: it has no calibration"));
}

TEST_F(NhfImage, CountsLinesOfAStoppedScanAsNotMeasured) {
  const auto image = load_image(write({{.direction = "Forward", .channels = {{.integers = {0, 0, 1000}}}}}));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_TRUE(std::isnan(image->image.channels[0].values[0]));
  EXPECT_NEAR(image->image.channels[0].values[5], 4e-6 * 1000 / std::exp2(31), 4e-15);
}

TEST_F(NhfImage, IsRefusedInOneLineIfItIsNotUnderstood) {
  EXPECT_THAT(refusal(write({{}}, 3)), HasSubstr("a Nanosurf file of version 3; 1 and 2 are read"));
  EXPECT_THAT(refusal(write({{}}, 2, "spectroscopy")), HasSubstr("it is a curve, not an image"));
  EXPECT_THAT(refusal(write({{.direction = "Forward", .channels = {}}})), HasSubstr("its image has no channels"));
  EXPECT_THAT(refusal(write({{.direction = "Forward", .channels = {{.calibrated = false}}}})),
              HasSubstr("its channel Topography cannot be read: it has no calibration"));
  EXPECT_THAT(refusal(write({})), HasSubstr("points on a side: 0"));
  const std::string whole = core::read_file(write({{}})).value();
  for (const double share : {0.3, 0.6, 0.9, 0.99}) {
    const auto cut = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    EXPECT_THAT(refusal(folder.write("cut.nhf", whole.substr(0, cut))), HasSubstr("cannot read the image")) << share;
  }
}

TEST_F(NhfImage, IsNotReadFromAnotherFile) {
  write({{}});
  const std::string other = folder.file("other.nhf");
  ASSERT_TRUE(core::write_file(other, core::read_file(path).value()));
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(H5Ldelete(file, "group_0000/segment_0", H5P_DEFAULT), 0);
  ASSERT_GE(H5Lcreate_external(other.c_str(), "/group_0000/segment_0", file, "group_0000/segment_0", H5P_DEFAULT,
                               H5P_DEFAULT),
            0);
  H5Fclose(file);
  EXPECT_THAT(refusal(path), HasSubstr("its \"segment_0\" is a link, which is not followed"));
}

}  // namespace nhf_images_test
}  // namespace afm::curves

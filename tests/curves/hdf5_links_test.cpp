// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <hdf5.h>

#include <string>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"

// HDF5 files with links to other files, whose contents must not be disclosed to the sender.
namespace afm::curves {
namespace hdf5_links_test {

using testing::HasSubstr;

class Hdf5Links : public testing::Test {
 protected:
  Hdf5Links() {
    EXPECT_TRUE(write_curve(other, CurveFormat::Hdf5, test::hertz_curve()).has_value());
    EXPECT_TRUE(write_curve(path, CurveFormat::Hdf5, test::hertz_curve()).has_value());
    file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    EXPECT_GE(file, 0);
  }

  std::string error() {
    H5Fclose(file);
    const auto curve = load_curve(path);
    return curve ? "accepted" : curve.error().message;
  }

  // Replaces the column of that name.
  void put(const char* column, hid_t properties) {
    ASSERT_GE(H5Ldelete(file, column, H5P_DEFAULT), 0);
    const hsize_t count = 3;
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t made = H5Dcreate2(file, column, H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    EXPECT_GE(made, 0);
    H5Dclose(made);
    H5Sclose(space);
    H5Pclose(properties);
  }

  support::ScratchFolder folder;
  std::string path = folder.file("curve.h5");
  std::string other = folder.file("other.h5");
  hid_t file = H5I_INVALID_HID;
};

TEST_F(Hdf5Links, ACurveInAnotherFileIsRefused) {
  H5Ldelete(file, "0", H5P_DEFAULT);
  ASSERT_GE(H5Lcreate_external(other.c_str(), "/0", file, "0", H5P_DEFAULT, H5P_DEFAULT), 0);
  EXPECT_THAT(error(), HasSubstr("its \"0\" is a link, which is not followed"));
}

TEST_F(Hdf5Links, AColumnInAnotherFileIsRefused) {
  H5Ldelete(file, "0/force", H5P_DEFAULT);
  ASSERT_GE(H5Lcreate_external(other.c_str(), "/0/force", file, "0/force", H5P_DEFAULT, H5P_DEFAULT), 0);
  EXPECT_THAT(error(), HasSubstr("its \"force\" is a link, which is not followed"));
}

TEST_F(Hdf5Links, ALinkOfTheSameFileIsRefusedToo) {
  H5Ldelete(file, "0/force", H5P_DEFAULT);
  ASSERT_GE(H5Lcreate_soft("/0/height (measured)", file, "0/force", H5P_DEFAULT, H5P_DEFAULT), 0);
  EXPECT_THAT(error(), HasSubstr("its \"force\" is a link, which is not followed"));
}

TEST_F(Hdf5Links, AColumnOfForeignBytesIsRefused) {
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  ASSERT_GE(H5Pset_external(properties, "/etc/passwd", 0, 24), 0);
  put("0/force", properties);
  EXPECT_THAT(error(), HasSubstr("its column \"force\" lies in another file, which is not read"));
}

TEST_F(Hdf5Links, AColumnPutTogetherFromOtherFilesIsRefused) {
  const hsize_t count = 3;
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  ASSERT_GE(H5Pset_virtual(properties, space, other.c_str(), "/0/force", space), 0);
  H5Sclose(space);
  put("0/force", properties);
  EXPECT_THAT(error(), HasSubstr("its column \"force\" lies in another file, which is not read"));
}

}  // namespace hdf5_links_test
}  // namespace afm::curves

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <hdf5.h>

#include <string>

#include "curves/curve_file.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"

// HDF5 files hold text of a fixed length, as C and Fortran write it, or of any length, as Python does.
namespace afm::curves {
namespace hdf5_text_test {

using testing::HasSubstr;

class Hdf5Text : public testing::Test {
 protected:
  Hdf5Text() { EXPECT_TRUE(write_curve(path_, CurveFormat::Hdf5, test::hertz_curve()).has_value()); }

  // Replaces the attribute of the curve.
  void put_fixed(const char* key, const std::string& text, std::size_t length) {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t curve = H5Gopen2(file, "0", H5P_DEFAULT);
    if (H5Aexists(curve, key) > 0) H5Adelete(curve, key);
    const hid_t type = H5Tcopy(H5T_C_S1);
    EXPECT_GE(H5Tset_size(type, length), 0);
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t made = H5Acreate2(curve, key, type, space, H5P_DEFAULT, H5P_DEFAULT);
    std::string padded = text;
    padded.resize(length);
    EXPECT_GE(H5Awrite(made, type, padded.data()), 0);
    H5Aclose(made);
    H5Sclose(space);
    H5Tclose(type);
    H5Gclose(curve);
    EXPECT_GE(H5Fclose(file), 0);
  }

  support::ScratchFolder folder_;
  std::string path_ = folder_.file("curve.h5");
};

TEST_F(Hdf5Text, OfAFixedLengthIsRead) {
  put_fixed("software", "another program", 40);
  const auto curve = load_curve(path_);
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_EQ(curve->metadata.software, "another program");
}

TEST_F(Hdf5Text, ThatIsNoForceCurvesIsRefused) {
  put_fixed("imaging mode", "creep-compliance", 16);
  const auto curve = load_curve(path_);
  ASSERT_FALSE(curve);
  EXPECT_THAT(curve.error().message, HasSubstr("its imaging mode is \"creep-compliance\""));
}

}  // namespace hdf5_text_test
}  // namespace afm::curves

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>

#include <string>
#include <vector>

// Attributes of an HDF5 file.
namespace afm::test {

inline void put(hid_t at, const char* name, const std::string& text) {
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  H5Tset_size(type, H5T_VARIABLE);
  const hid_t attribute = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  const char* characters = text.c_str();
  EXPECT_GE(H5Awrite(attribute, type, static_cast<const void*>(&characters)), 0);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
}

inline void put(hid_t at, const char* name, const std::vector<double>& numbers) {
  const hsize_t count = numbers.size();
  const hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr);
  const hid_t attribute = H5Acreate2(at, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, numbers.data()), 0);
  H5Aclose(attribute);
  H5Sclose(space);
}

}  // namespace afm::test

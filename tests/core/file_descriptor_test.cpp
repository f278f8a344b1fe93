// SPDX-License-Identifier: Apache-2.0
#include "core/file_descriptor.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/eventfd.h>

#include <utility>

namespace file_descriptor_test {

using afm::core::FileDescriptor;

bool open_in_kernel(int descriptor) { return ::fcntl(descriptor, F_GETFD) >= 0; }

TEST(FileDescriptor, ClosesWhatItOwns) {
  int number = -1;
  {
    const FileDescriptor descriptor(::eventfd(0, 0));
    ASSERT_TRUE(descriptor.is_open());
    number = descriptor.get();
    EXPECT_TRUE(open_in_kernel(number));
  }
  EXPECT_FALSE(open_in_kernel(number));
}

TEST(FileDescriptor, MovesItsOwnership) {
  FileDescriptor first(::eventfd(0, 0));
  const int number = first.get();
  FileDescriptor second(std::move(first));
  EXPECT_EQ(second.get(), number);
  FileDescriptor third;
  third = std::move(second);
  EXPECT_EQ(third.get(), number);
  EXPECT_TRUE(open_in_kernel(number));
  third.close();
  EXPECT_FALSE(third.is_open());
  EXPECT_FALSE(open_in_kernel(number));
}

}  // namespace file_descriptor_test

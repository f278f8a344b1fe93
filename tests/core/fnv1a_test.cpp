// SPDX-License-Identifier: Apache-2.0
#include "core/fnv1a.h"

#include <gtest/gtest.h>

namespace fnv1a_test {

// The values of draft-eastlake-fnv, section 8.
TEST(Fnv1a, HasTheValuesOfItsSpecification) {
  EXPECT_EQ(afm::core::fnv1a(""), 0xCBF29CE484222325ULL);
  EXPECT_EQ(afm::core::fnv1a("a"), 0xAF63DC4C8601EC8CULL);
  EXPECT_EQ(afm::core::fnv1a("foobar"), 0x85944171F73967E8ULL);
}

}  // namespace fnv1a_test

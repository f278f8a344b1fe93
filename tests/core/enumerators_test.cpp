// SPDX-License-Identifier: Apache-2.0
#include "core/enumerators.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace enumerators_test {

using afm::core::has_row_for_each;
using afm::core::is_enumerator;
using afm::core::kEnumerators;

enum class Law : std::uint32_t { Paper = 0, Hertz = 2, Dmt = 3 };
enum class Plain { First, Second };

struct Row {
  Law law;
  const char* word;
};

TEST(Enumerators, AreCountedWithTheirGaps) {
  static_assert(kEnumerators<Law> == std::array{Law::Paper, Law::Hertz, Law::Dmt});
  static_assert(kEnumerators<Plain>.size() == 2);
  static_assert(afm::core::index_of(Law::Dmt) == 2);
}

TEST(Enumerators, RefuseANumberWithoutAName) {
  EXPECT_TRUE(is_enumerator(Law::Hertz));
  for (const std::uint32_t number : {1U, 4U, 31U, 32U, 0xFFFFFFFFU})
    EXPECT_FALSE(is_enumerator(static_cast<Law>(number)));
}

TEST(Enumerators, SeeARowThatIsForgottenOrMisplaced) {
  static_assert(has_row_for_each(std::array{Row{Law::Paper, "paper"}, Row{Law::Hertz, "hertz"}, Row{Law::Dmt, "dmt"}},
                                 &Row::law));
  static_assert(!has_row_for_each(std::array{Row{Law::Paper, "paper"}, Row{Law::Dmt, "dmt"}}, &Row::law));
  static_assert(!has_row_for_each(std::array{Row{Law::Hertz, "hertz"}, Row{Law::Paper, "paper"}, Row{Law::Dmt, "dmt"}},
                                  &Row::law));
}

}  // namespace enumerators_test

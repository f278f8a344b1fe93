// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_program.h"

namespace afm::app {
namespace tapping_benchmark_test {

TEST(TappingBenchmark, PrintsEachBarAsARatioOrATimeAndJudgesNothing) {
  const auto result = support::run_program(support::touchafm() + " bench tapping --rounds 1 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto figures = nlohmann::json::parse(result.out).at("figures");
  ASSERT_EQ(figures.size(), 5U);
  for (const auto& figure : figures) {
    EXPECT_GT(figure.at("seconds"), 0.0) << figure;
    EXPECT_TRUE(figure.at("met").is_boolean()) << figure;
    if (figure.contains("limit_s")) continue;
    EXPECT_GT(figure.at("against_s"), 0.0) << figure;
    EXPECT_DOUBLE_EQ(figure.at("ratio"), figure.at("seconds").get<double>() / figure.at("against_s").get<double>());
  }
}

}  // namespace tapping_benchmark_test
}  // namespace afm::app

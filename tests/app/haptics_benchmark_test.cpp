// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/bench/servo_reaction.h"
#include "physics/law.h"
#include "support/places.h"
#include "support/run_program.h"

namespace afm::app {
namespace haptics_benchmark_test {

support::ProgramResult bench(const std::string& options) {
  return support::run_program(support::touchafm() + " bench haptics " + options);
}

TEST(HapticsBenchmark, PrintsEveryFigureAsJson) {
  const support::ProgramResult result = bench("--seconds 0.5 --rounds 1 --ticks 1000 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto all = nlohmann::json::parse(result.out);
  // each computed law, the paper's three times, a dynamic one, a map, a lever that taps, a scratch, and ink
  EXPECT_EQ(all.at("work").size(), physics::laws_with(&physics::LawTraits::computed).size() + 7);
  for (const auto& work : all.at("work")) EXPECT_EQ(work.at("ticks"), 1000) << work;
  const auto& among = all.at("particles");
  EXPECT_GT(among.at("looks_per_tick"), 0.0);
  EXPECT_GT(among.at("beside").at("frames"), 0);
  for (const char* bounded : {"200 particles", "2000 particles"}) {
    EXPECT_DOUBLE_EQ(among.at("work").at(bounded).at("bar_p99_s").get<double>(), 20e-6) << bounded;
    EXPECT_GT(among.at("work").at(bounded).at("touching_share"), 0.1) << bounded;
    EXPECT_GT(among.at("work").at(bounded).at("p99_to_law_alone"), 1.0) << bounded;
  }
  EXPECT_EQ(among.at("work").at("the law alone").at("p99_to_law_alone"), 1.0);
  for (const char* loop : {"servo", "plain_loop"}) EXPECT_GT(all.at("wake").at(loop).at("ticks"), 0) << loop;
  EXPECT_GT(all.at("wake").at("beside").at("frames"), 0);
  EXPECT_EQ(all.at("release").size(), kReleases.size());
  for (const auto& release : all.at("release")) EXPECT_GT(release.at("max_s"), 0.0) << release;
}

TEST(HapticsBenchmark, NamesASurfaceThatItCannotRead) {
  const support::ProgramResult result = bench("--sample /nowhere.gsf");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, testing::HasSubstr("/nowhere.gsf"));
}

}  // namespace haptics_benchmark_test
}  // namespace afm::app

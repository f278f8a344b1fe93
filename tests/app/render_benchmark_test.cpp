// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "support/places.h"
#include "support/run_program.h"

namespace afm::app {
namespace render_benchmark_test {

using testing::HasSubstr;

TEST(RenderBenchmark, PrintsEverySubjectAndItsPeer) {
  const support::ProgramResult result = support::run_program(
      support::touchafm() +
      " bench render --rounds 1 --frames 1 --eye-width 64 --json --peer 'echo \"{\\\"frame_ms\\\": 2.5}\"'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto all = nlohmann::json::parse(result.out);
  std::set<std::string> subjects;
  std::map<std::uint32_t, std::string> growing;
  double peer_s = 0.0;
  for (const auto& figure : all.at("figures")) {
    subjects.insert(figure.at("subject"));
    if (figure.at("subject") == "peer") peer_s = figure.at("p50_s");
    if (figure.contains("things")) growing[figure.at("things")] = figure.at("subject");
    if (figure.contains("processor_s") && figure.at("subject") != "wall at rest") {
      EXPECT_GT(figure.at("processor_s"), 0.0) << figure;
    }
  }
  EXPECT_THAT(subjects,
              testing::IsSupersetOf({"wall", "wall, head moving", "wall at rest", "131072 triangles", "1000 nodes"}));
  EXPECT_EQ(growing, (std::map<std::uint32_t, std::string>{{1, "1 node"},
                                                           {1000, "1000 nodes"},
                                                           {2000, "2000 copies"},
                                                           {10'000, "10000 nodes"},
                                                           {100'000, "100000 nodes"}}));
  EXPECT_DOUBLE_EQ(peer_s, 0.0025);
  EXPECT_GT(all.at("wall_frames_per_s"), 0.0);
  EXPECT_GT(all.at("first_frame_cold_s"), 0.0);
}

TEST(RenderBenchmark, TimesTheFirstFrameOfAFile) {
  const std::string file = support::source("assets/models/analogy.glb");
  const support::ProgramResult result =
      support::run_program(support::touchafm() + " bench render --first-frame-alone --eye-width 64 --gltf " + file);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(nlohmann::json::parse(result.out).at("frame_ms"), 0.0);
  const support::ProgramResult missing =
      support::run_program(support::touchafm() + " bench render --first-frame-alone --gltf nowhere.glb");
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.err, HasSubstr("nowhere.glb"));
}

TEST(RenderBenchmark, MeasuresFilesAndPeersAlone) {
  const support::ProgramResult result = support::run_program(
      support::touchafm() + " bench render --files-alone --rounds 1 --frames 1 --eye-width 64 --gltf " +
      support::source("assets/models/analogy.glb") + " --peer 'echo \"{\\\"frame_ms\\\": 2.5}\"'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("analogy.glb, two passes"));
  EXPECT_THAT(result.out, HasSubstr("peer, echo"));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("the wall")));
}

TEST(RenderBenchmark, MeasuresWithOneLight) {
  const std::string file = support::source("assets/models/analogy.glb");
  const support::ProgramResult result = support::run_program(
      support::touchafm() + " bench render --one-light --files-alone --rounds 1 --frames 1 --eye-width 64 --gltf " +
      file);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("analogy.glb, multiview"));
}

TEST(RenderBenchmark, NamesAPeerThatPrintsNoTime) {
  const support::ProgramResult result = support::run_program(
      support::touchafm() + " bench render --rounds 1 --frames 1 --eye-width 64 --peer 'echo nothing'");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("echo nothing"));
}

}  // namespace render_benchmark_test
}  // namespace afm::app

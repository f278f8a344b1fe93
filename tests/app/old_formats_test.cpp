// SPDX-License-Identifier: Apache-2.0
// Invariant: sessions and files of 0.1.0 and 0.2.0 are read and replayed unchanged
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/places.h"
#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

// Every file that an earlier version wrote is still read: tests/formats/README.md.
namespace afm::app {
namespace old_formats_test {

using support::run_touchafm;

using ::testing::HasSubstr;

const std::string kFiles = support::source("tests/formats/0.1.0/");

TEST(OldFormats, OfASessionReplaysBitForBit) {
  const auto done = run_touchafm("replay " + kFiles + "session-gold.afms");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("is identical, bit for bit"));
}

// an empty part would be identical
TEST(Replay, RefusesAPartWithoutATick) {
  const std::string session = "replay " + kFiles + "session-gold.afms";
  expect_refusal(run_touchafm(session + " --from 2 --to 2"), 2, "--from 2 s, --to 2 s: the session has no such part");
  expect_refusal(run_touchafm(session + " --from -1"), 2, "--from -1 s: the session has no such part");
}

TEST(OldFormats, OfASessionIsDrawn) {
  const support::ScratchFolder folder;
  const auto done =
      run_touchafm("render --session " + kFiles + "session-gold.afms --at 1 --size 128x96 --stereo mono --wall " +
                   kFiles + "wall.toml --guidance " + kFiles + "guidance.toml --out " + folder.file("gold.png"));
  EXPECT_EQ(done.exit_code, 0) << done.err;
}

TEST(OldFormats, OfACurveIsAnalysed) {
  const auto done = run_touchafm("analyse " + kFiles + "curve.csv");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("pull-off"));
}

TEST(OldFormats, OfWallMaterialsProbesAndWandAreRead) {
  for (const std::string& command :
       {"wall " + kFiles + "wall.toml", "curve --material gold --materials " + kFiles + "materials.toml --json",
        "curve --material gold --probe mlct-c --probes " + kFiles + "probes.toml --json",
        "devices --wand-file " + kFiles + "wand.toml"}) {
    const auto done = run_touchafm(command);
    EXPECT_EQ(done.exit_code, 0) << command << ": " << done.err;
  }
}

}  // namespace old_formats_test
}  // namespace afm::app

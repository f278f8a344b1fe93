// SPDX-License-Identifier: Apache-2.0
// Invariant: no message between machines is used before it is fully checked; only a Stop reaches the servo
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "cluster/document.h"
#include "cluster/frame_message.h"

namespace messages_test {

using namespace afm;
using namespace afm::cluster;

TEST(FrameMessageTest, CutsTextsBetweenCharacters) {
  ShownTexts texts;
  std::string longest;
  for (std::size_t i = 0; i < ShownTexts::kBytes; ++i) longest += "\u00e4";
  texts.set(std::vector<std::string>{longest, "lost"});
  ASSERT_EQ(texts.list().size(), 1U);
  const std::string cut = texts.list().front();
  EXPECT_GE(cut.size(), ShownTexts::kBytes - 3);
  EXPECT_EQ(cut.size() % 2, 0U);
  EXPECT_EQ(longest.substr(0, cut.size()), cut);
}

TEST(JournalBatchTest, SendsOnlyItsRecordsAndRefusesInvalidOnes) {
  scene::TipSample sample;
  sample.material = 2;
  sample.tip.z_m = 1e-9;
  JournalBatch batch;
  batch.header.number = 41;
  batch.count = 2;
  batch.records[0] = JournalRecord(sample);
  batch.records[1] = JournalRecord(EditRecord{.material = 1, .revision = 3, .steps = {1, 0, -2, 0, 0, 1}});
  EXPECT_LT(encode(batch).size(), sizeof(batch));
  const auto came = decode<JournalBatch>(encode(batch));
  ASSERT_TRUE(came);
  EXPECT_EQ(came->records[0].sample().tip.z_m, 1e-9);
  EXPECT_EQ(came->records[1].edit(), batch.records[1].edit());

  EXPECT_FALSE(decode<JournalBatch>(encode(batch).first(encode(batch).size() - 1)));
  EXPECT_FALSE(decode<JournalBatch>({}));
  sample.material = -1;
  batch.records[0] = JournalRecord(sample);
  EXPECT_FALSE(decode<JournalBatch>(encode(batch)));
  batch.records[0] = JournalRecord(EditRecord{.material = scene::kMaxMaterials});
  EXPECT_FALSE(decode<JournalBatch>(encode(batch)));
}

TEST(JournalBatchTest, RefusesAScoreThatIsNotValid) {
  const auto came = [](const scene::TaskScore& score) {
    JournalBatch batch;
    batch.count = 1;
    batch.records[0] = JournalRecord(score);
    return decode<JournalBatch>(encode(batch));
  };
  const scene::TaskScore done{.time_s = 83.5, .rms_m = 18e-9, .strokes = 7, .state = scene::TaskState::Done};
  ASSERT_TRUE(came(done));
  EXPECT_EQ(came(done)->records[0].score(), done);
  EXPECT_FALSE(came({.state = static_cast<scene::TaskState>(3)}));
  EXPECT_FALSE(came({.time_s = std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_FALSE(came({.work_j = std::numeric_limits<double>::infinity()}));
}

TEST(DocumentReaderTest, PutsPiecesTogetherInAnyOrderAndTwice) {
  std::vector<std::byte> document(3 * DocumentPiece::kBytes + 17);
  for (std::size_t i = 0; i < document.size(); ++i) document[i] = static_cast<std::byte>(i * 7);
  std::vector<DocumentPiece> pieces = pieces_of(document, {.session = 5, .number = 2});
  ASSERT_EQ(pieces.size(), 4U);
  DocumentReader reader;
  std::mt19937 random(7);
  std::shuffle(pieces.begin(), pieces.end(), random);
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    EXPECT_FALSE(reader.add(pieces[i]));
    EXPECT_FALSE(reader.add(pieces[i]));
  }
  EXPECT_EQ(reader.add(pieces.back()), document);
  EXPECT_FALSE(reader.add(pieces.back()));
  // an earlier one of the session is outdated; another session starts again
  EXPECT_FALSE(reader.add(pieces_of(std::span(document).first(4), {.session = 5, .number = 1}).front()));
  EXPECT_TRUE(reader.add(pieces_of(std::span(document).first(4), {.session = 6, .number = 1}).front()));
}

}  // namespace messages_test

// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/shared_segment.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/paper_model.h"

namespace shared_segment_test {

using namespace afm::scene;
using afm::core::FileDescriptor;
using afm::physics::Law;
using afm::test::paper_model;
using testing::HasSubstr;

constexpr std::uint64_t kDigest = 0x1234;
constexpr off_t kVersionOffset = 8;  // after the magic
constexpr off_t kBlockSizesOffset = 32;

SharedSegment create_segment() {
  auto segment = SharedSegment::create(paper_model(), kDigest);
  EXPECT_TRUE(segment) << segment.error().message;
  return std::move(*segment);
}

FileDescriptor copy_of(const SharedSegment& segment) { return FileDescriptor(::dup(segment.descriptor())); }

template <class T>
void overwrite(const SharedSegment& segment, off_t offset, const T& value) {
  ASSERT_EQ(::pwrite(segment.descriptor(), &value, sizeof(T), offset), static_cast<ssize_t>(sizeof(T)));
}

std::string attach_error(const SharedSegment& segment) {
  const auto attached = SharedSegment::attach(copy_of(segment));
  return attached ? "attached" : attached.error().message;
}

TEST(SharedSegment, ShowsTheModelToWhoAttaches) {
  const SharedSegment segment = create_segment();
  const auto attached = SharedSegment::attach(copy_of(segment));
  ASSERT_TRUE(attached) << attached.error().message;
  EXPECT_EQ(attached->scene_digest(), kDigest);
  EXPECT_EQ(attached->model().material_count, 3U);
  EXPECT_STREQ(attached->model().materials[1].name.data(), "gold");
}

TEST(SharedSegment, CarriesEveryBlockAcross) {
  SharedSegment segment = create_segment();
  auto attached = SharedSegment::attach(copy_of(segment));
  ASSERT_TRUE(attached);
  RendererSide renderer = segment.renderer_side();
  ServoSide servo = attached->servo_side();

  EXPECT_FALSE(servo.new_transforms() || servo.new_selection() || servo.new_hand_script() || servo.new_heartbeat());
  SceneTransforms transforms;
  transforms.count = 2;
  transforms.room_from_node[1][5] = 3.0;
  renderer.store(transforms);
  renderer.store(Selection{.material = 2, .revision = 9});
  renderer.store(HandScript{.target_m = {0, 0.1, 0}, .duration_s = 2, .revision = 4, .turn_on_pressed = 1});
  renderer.store(RendererHeartbeat{.time_ns = 77, .frame = 5});
  EXPECT_EQ(servo.new_transforms()->room_from_node[1][5], 3.0);
  EXPECT_EQ(servo.new_selection()->revision, 9U);
  EXPECT_EQ(servo.new_hand_script()->target_m[1], 0.1);
  EXPECT_EQ(servo.new_heartbeat()->time_ns, 77);
  EXPECT_FALSE(servo.new_transforms() || servo.new_selection() || servo.new_hand_script() || servo.new_heartbeat());

  EXPECT_FALSE(renderer.device());
  servo.store(SharedDevice{.max_force_n = 3.3,
                           .max_continuous_force_n = 0.88,
                           .max_stiffness_n_per_m = 400.0,
                           .max_slew_n_per_s = std::numeric_limits<double>::infinity(),
                           .max_speed_m_per_s = 1.0});
  EXPECT_EQ(renderer.device()->max_continuous_force_n, 0.88);
  servo.store(SharedDevice{.max_force_n = std::nan("")});
  EXPECT_FALSE(renderer.device());
  EXPECT_EQ(renderer.refused_blocks(), 1U);

  EXPECT_FALSE(renderer.tip_state() || renderer.servo_timing() || renderer.pop_sample() || renderer.pop_event());
  servo.store(TipState{.tick = 3, .tip = {.z_m = 1e-9}});
  ServoTiming timing;
  timing.wake_us[kHistogramBins - 1] = 8;
  servo.store(timing);
  servo.push(TipSample{.tick = 1});
  servo.push(TipSample{.tick = 2});
  servo.push(TipEvent{.kind = afm::physics::EventKind::JumpOffContact});
  EXPECT_EQ(renderer.tip_state()->tip.z_m, 1e-9);
  EXPECT_EQ(renderer.servo_timing()->wake_us[kHistogramBins - 1], 8U);
  EXPECT_EQ(renderer.pop_sample()->tick, 1U);
  EXPECT_EQ(renderer.pop_sample()->tick, 2U);
  EXPECT_FALSE(renderer.pop_sample());
  EXPECT_EQ(renderer.pop_event()->kind, afm::physics::EventKind::JumpOffContact);
  EXPECT_EQ(renderer.refused_blocks() + servo.refused_blocks(), 1U);
}

TEST(SharedSegment, CountsTheSamplesThatNobodyTook) {
  SharedSegment segment = create_segment();
  ServoSide servo = segment.servo_side();
  for (std::uint32_t i = 0; i < kSampleRingCapacity + 5; ++i) servo.push(TipSample{});
  EXPECT_EQ(segment.renderer_side().lost_samples(), 5U);
}

TEST(SharedSegment, ServesTwoProcesses) {
  SharedSegment segment = create_segment();
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto attached = SharedSegment::attach(copy_of(segment));
    if (attached) attached->servo_side().push(TipSample{.tick = 42});
    ::_exit(attached ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(segment.renderer_side().pop_sample()->tick, 42U);
}

TEST(SharedSegment, IsSealedAgainstResizing) {
  const SharedSegment segment = create_segment();
  EXPECT_NE(::ftruncate(segment.descriptor(), 4096), 0);
  EXPECT_NE(::fcntl(segment.descriptor(), F_GETFD) & FD_CLOEXEC, 0);
}

TEST(SharedSegment, PrintsBothVersionsWhenTheyDiffer) {
  for (const std::uint32_t other : {kSegmentVersion - 1, kSegmentVersion + 1}) {
    const SharedSegment segment = create_segment();
    overwrite(segment, kVersionOffset, other);
    EXPECT_THAT(attach_error(segment), HasSubstr("version " + std::to_string(other)));
    EXPECT_THAT(attach_error(segment), HasSubstr("version " + std::to_string(kSegmentVersion) + ";"));
  }
}

TEST(SharedSegment, RefusesOtherBlockSizes) {
  const SharedSegment segment = create_segment();
  overwrite(segment, kBlockSizesOffset, std::uint32_t{12});
  EXPECT_THAT(attach_error(segment), HasSubstr("blocks differ"));
}

TEST(SharedSegment, RefusesWhatIsNoSegment) {
  const SharedSegment segment = create_segment();
  overwrite(segment, 0, std::uint64_t{0});
  EXPECT_THAT(attach_error(segment), HasSubstr("something else"));

  EXPECT_THAT(SharedSegment::attach(FileDescriptor(::open("/dev/null", O_RDWR))).error().message, HasSubstr("shorter"));
  EXPECT_THAT(SharedSegment::attach(FileDescriptor(9999)).error().message, HasSubstr("9999"));
}

TEST(SharedSegment, RefusesACopyThatCouldShrink) {
  const SharedSegment segment = create_segment();
  std::vector<char> bytes(static_cast<std::size_t>(::lseek(segment.descriptor(), 0, SEEK_END)));
  ASSERT_EQ(::pread(segment.descriptor(), bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  FileDescriptor unsealed(::memfd_create("unsealed", MFD_CLOEXEC));
  ASSERT_EQ(::write(unsealed.get(), bytes.data(), bytes.size() - 1), static_cast<ssize_t>(bytes.size() - 1));
  EXPECT_THAT(SharedSegment::attach(FileDescriptor(::dup(unsealed.get()))).error().message,
              HasSubstr("bytes instead of"));
  ASSERT_EQ(::pwrite(unsealed.get(), &bytes.back(), 1, static_cast<off_t>(bytes.size() - 1)), 1);
  EXPECT_THAT(SharedSegment::attach(std::move(unsealed)).error().message, HasSubstr("not sealed"));
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A loop of ten points a branch.
void make_dynamic(SharedContact& contact) {
  contact.dynamic = 1;
  contact.lever = {afm::physics::Frequency(12e3), 2.5, afm::physics::Temperature(298.0)};
}

void add_measured_curve(SharedModel& model) {
  SharedMeasuredCurve& curve = model.curves[model.curve_count++];
  curve.approach_count = curve.retract_count = 10;
  for (std::size_t i = 0; i < 10; ++i) {
    const afm::physics::Length z(1e-9 * static_cast<double>(i));
    curve.approach[i] = {.z = z, .force = {}};
    curve.retract[i] = {.z = z, .force = afm::physics::Stiffness(-0.1) * z};
  }
}

// ---- a topography behind the blocks ----

SharedModel with_topography(const Topography& topography) {
  SharedModel model = paper_model();
  model.topography = topography.size();
  model.materials[0].height_field = kTopography;
  return model;
}

const Topography kTwoByThree{
    .columns = 2, .rows = 3, .spacing_m = 1e-9, .height_m = {0, 1e-9F, 2e-9F, 3e-9F, 4e-9F, 5e-9F}};

TEST(SharedSegment, HoldsATopographyBehindItsBlocks) {
  const auto segment = SharedSegment::create(with_topography(kTwoByThree), kDigest, kTwoByThree);
  ASSERT_TRUE(segment) << segment.error().message;
  const auto attached = SharedSegment::attach(copy_of(*segment));
  ASSERT_TRUE(attached) << attached.error().message;
  EXPECT_TRUE(is_valid(attached->topography(), attached->model().topography));
  EXPECT_EQ(attached->topography().height_m, kTwoByThree.height_m);
  const FeltHeights grid = surface_of(attached->model().materials[0], {}, attached->topography());
  EXPECT_EQ(grid.heights, Heights::Traced);
  EXPECT_EQ(grid.rows, 3U);

  const SharedSegment plain = create_segment();
  EXPECT_EQ(plain.topography().columns, 0U);
  EXPECT_EQ(::lseek(segment->descriptor(), 0, SEEK_END) - ::lseek(plain.descriptor(), 0, SEEK_END),
            static_cast<off_t>(6 * sizeof(float)))
      << "one without a topography is no longer than before";
}

TEST(SharedSegment, RefusesATopographyThatItsModelDoesNotHave) {
  Topography other = kTwoByThree;
  other.height_m.pop_back();
  EXPECT_FALSE(SharedSegment::create(with_topography(kTwoByThree), kDigest, other));
  EXPECT_FALSE(SharedSegment::create(with_topography(kTwoByThree), kDigest));
  EXPECT_FALSE(SharedSegment::create(paper_model(), kDigest, kTwoByThree));
  other = kTwoByThree;
  other.height_m[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(SharedSegment::create(with_topography(kTwoByThree), kDigest, other));
  other = kTwoByThree;
  other.columns = kMaxTopographySide + 1;
  EXPECT_FALSE(SharedSegment::create(with_topography(other), kDigest, other));

  // a writer that changes the size afterwards
  const auto segment = SharedSegment::create(with_topography(kTwoByThree), kDigest, kTwoByThree);
  ASSERT_TRUE(segment);
  auto& model = const_cast<SharedModel&>(segment->model());
  model.topography.rows = 2;
  EXPECT_FALSE(is_valid(segment->topography(), segment->model().topography));
  EXPECT_THAT(attach_error(*segment), HasSubstr("does not fill it"));
}

struct BadModel {
  const char* message;
  void (*spoil)(SharedModel&);
};

class SharedModelWith : public testing::TestWithParam<BadModel> {};

TEST_P(SharedModelWith, IsRefusedWithAReason) {
  SharedModel model = paper_model();
  ASSERT_TRUE(validate(model));
  GetParam().spoil(model);
  const auto created = SharedSegment::create(model, kDigest);
  ASSERT_FALSE(created);
  EXPECT_THAT(created.error().message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Defects, SharedModelWith,
    testing::Values(
        BadModel{"0 nodes", [](SharedModel& m) { m.node_count = 0; }},
        BadModel{"161 nodes", [](SharedModel& m) { m.node_count = 161; }},
        BadModel{"its surface does not exist", [](SharedModel& m) { m.materials[0].height_field = kTopography; }},
        BadModel{"scale of its topography", [](SharedModel& m) { m.materials[0].topography.vertical = 0; }},
        BadModel{"release that belongs to its surface",
                 [](SharedModel& m) { m.materials[0].surface_release_m = -1e-9; }},
        BadModel{"release that belongs to its surface",
                 [](SharedModel& m) { m.materials[1].surface_release_m = kNan; }},
        BadModel{"topography is not a grid", [](SharedModel& m) { m.topography = {1, 5, 1e-9}; }},
        BadModel{"0 materials", [](SharedModel& m) { m.material_count = 0; }},
        BadModel{"33 materials", [](SharedModel& m) { m.material_count = 33; }},
        BadModel{"sample is node 2", [](SharedModel& m) { m.sample_node = 2; }},
        BadModel{"node 1 has parent 1, but a parent must come before its child",
                 [](SharedModel& m) { m.nodes[1].parent = 1; }},
        BadModel{"node 0 has parent 5, but a parent must come before its child",
                 [](SharedModel& m) { m.nodes[0].parent = 5; }},
        BadModel{"transform", [](SharedModel& m) { m.nodes[1].parent_from_node[3] = kNan; }},
        BadModel{"is not terminated", [](SharedModel& m) { m.nodes[0].name.fill('x'); }},
        BadModel{"is not terminated", [](SharedModel& m) { m.materials[0].name.fill('x'); }},
        BadModel{"material 2", [](SharedModel& m) { m.materials[2].contact.hamaker.si = kNan; }},
        BadModel{"material 1", [](SharedModel& m) { m.materials[1].contact.tip_radius.si = 0; }},
        BadModel{"material 0", [](SharedModel& m) { m.materials[0].contact.spring_constant.si = -1; }},
        BadModel{"material 0", [](SharedModel& m) { m.materials[0].contact.sample_stiffness.si = -kInfinity; }},
        BadModel{"law", [](SharedModel& m) { m.materials[0].law = Law::Count; }},
        BadModel{"option", [](SharedModel& m) { m.materials[1].exact_hamaker_sphere = 2; }},
        BadModel{"option", [](SharedModel& m) { m.materials[1].dynamic = 7; }},
        BadModel{"retardation", [](SharedModel& m) { m.materials[0].retardation_wavelength_m = kNan; }},
        BadModel{"humidity",
                 [](SharedModel& m) {
                   m.materials[0].has_meniscus = 1;
                   m.materials[0].meniscus.relative_humidity = 1.5;
                 }},
        BadModel{"resonance",
                 [](SharedModel& m) {
                   m.materials[0].law = Law::Dmt;
                   m.materials[0].dynamic = 1;
                 }},
        BadModel{"the law paper has no dynamics", [](SharedModel& m) { make_dynamic(m.materials[0]); }},
        BadModel{"the law measured has no dynamics",
                 [](SharedModel& m) {
                   add_measured_curve(m);
                   m.materials[0].law = Law::Measured;
                   m.materials[0].measured_curve = 0;
                   make_dynamic(m.materials[0]);
                 }},
        BadModel{"no measured curve", [](SharedModel& m) { m.materials[0].law = Law::Measured; }},
        BadModel{"5 measured curves", [](SharedModel& m) { m.curve_count = 5; }},
        BadModel{"measured curve 0", [](SharedModel& m) { m.curve_count = 1; }},
        BadModel{"measured curve 0",
                 [](SharedModel& m) {
                   add_measured_curve(m);
                   std::swap(m.curves[0].approach[3], m.curves[0].approach[4]);
                 }},
        BadModel{"measured curve 0",
                 [](SharedModel& m) {
                   add_measured_curve(m);
                   m.curves[0].retract[5].force.si = kNan;
                 }},
        BadModel{"measured curve 0", [](SharedModel& m) {
                   add_measured_curve(m);
                   m.curves[0].retract_count = kMaxMeasuredPoints + 1;
                 }}));

TEST(SharedModel, TakesAMaterialThatWasMeasured) {
  SharedModel model = paper_model();
  add_measured_curve(model);
  model.materials[1].law = Law::Measured;
  model.materials[1].measured_curve = 0;
  EXPECT_TRUE(validate(model));
}

TEST(SharedContact, KeepsTheOptionsOfItsLaw) {
  SharedContact material = paper_model().materials[0];
  EXPECT_FALSE(law_options(material).retardation_wavelength || law_options(material).meniscus);
  material.exact_hamaker_sphere = 1;
  material.retardation_wavelength_m = 100e-9;
  material.has_meniscus = 1;
  material.meniscus.relative_humidity = 0.3;
  EXPECT_TRUE(law_options(material).exact_hamaker_sphere);
  EXPECT_EQ(law_options(material).retardation_wavelength->si, 100e-9);
  EXPECT_EQ(law_options(material).meniscus->relative_humidity, 0.3);
}

TEST(SharedSegment, HandsOverTheNewestEditOfEachMaterialOnce) {
  SharedSegment segment = create_segment();
  RendererSide renderer = segment.renderer_side();
  EditSide edits = segment.edit_side();
  EXPECT_FALSE(edits.new_edit(0) || edits.new_edit(2));
  renderer.store(MaterialEdit{.material = paper_model().materials[0], .revision = 1}, 0);
  renderer.store(MaterialEdit{.material = paper_model().materials[2], .revision = 2}, 2);
  renderer.store(MaterialEdit{.material = paper_model().materials[0], .revision = 3}, 0);
  EXPECT_EQ(edits.new_edit(0)->revision, 3U);
  EXPECT_EQ(edits.new_edit(2)->revision, 2U);
  EXPECT_FALSE(edits.new_edit(0) || edits.new_edit(1) || edits.new_edit(2));
}

TEST(SharedModel, ComposesTheRestTransform) {
  SharedModel model = paper_model();
  model.nodes[0].parent_from_node[13] = 0.25;
  const glm::dmat4 rest = rest_room_from_node(model, 1);
  EXPECT_EQ(rest[2], glm::dvec4(0, 1, 0, 0));
  EXPECT_EQ(rest[3], glm::dvec4(0, 1.75, 0, 1));
}

}  // namespace shared_segment_test

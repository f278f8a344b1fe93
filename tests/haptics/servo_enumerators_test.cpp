// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "core/enumerators.h"
#include "physics/friction/friction.h"
#include "servo_bench.h"
#include "support/particles/gold_particles.h"
#include "support/samples/measured_curve_of.h"

// A tick with every enumerator that reaches it from material, friction, scale, scan and renderer: each is felt, or
// refused before the first tick. None may meet a tick that has no code for it.
namespace afm {
namespace servo_enumerators_test {

using physics::FrictionLaw;
using physics::LatticeKind;
using physics::Law;
using test::ServoBench;

physics::FrictionParameters friction_of(FrictionLaw law, LatticeKind kind) {
  return {.law = law,
          .lattice = kind,
          .coefficient = 0.3,
          .shear_strength = physics::Pressure(1e8),
          .period = physics::Length(0.5e-9),
          .corrugation = physics::Length(0.05e-9),
          .lateral_stiffness = physics::Stiffness(5.0)};
}

scene::SharedModel model_of(Law law, const physics::FrictionParameters& friction) {
  scene::SharedModel model = test::model_with_particles();
  scene::SharedContact& mica = model.materials[test::kMica];
  mica.law = law;
  mica.contact.reduced_modulus.si = 51.5e9;
  mica.friction = friction;
  if (law == Law::Measured) test::add_measured_curve(model, test::kMica);
  return model;
}

// Attached, then moved sideways; with each hand of a scan, and each request of a renderer at the end.
void feel(ServoBench& bench, scene::ScaleMode scale) {
  bench.arm(test::kMica, scale);
  bench.move(-0.005, 0.3);
  for (const scene::ScanHand hand : core::kEnumerators<scene::ScanHand>) {
    for (int tick = 0; tick < 20; ++tick) {
      bench.renderer.store(scene::ScanLead{.time_ns = bench.now_ns,
                                           .apex_xy_m = {1e-11 * tick, 0.0},
                                           .height_m = 1e-9,
                                           .gain_per_s = 100.0,
                                           .hand = hand,
                                           .feedback = 1});
      bench.tick();
    }
  }
  bench.run(0.05);
  bench.unseen = true;
  bench.run(0.05);
  bench.unseen = false;
  bench.renderer.store(scene::RendererHeartbeat{.time_ns = bench.now_ns, .stop = 1});
  bench.loop->tick(bench.now_ns += bench.loop->period_ns(), 0);
}

TEST(ServoTick, HasCodeForEveryEnumeratorOfAMaterialAScanAndARenderer) {
  std::set<Law> laws;
  std::set<FrictionLaw> frictions;
  std::set<LatticeKind> lattices;
  std::set<scene::ScaleMode> scales;
  std::size_t turn = 0;
  std::size_t known = 0;
  for (const Law law : core::kEnumerators<Law>) {
    if (!physics::is_known(law)) continue;  // Count
    ++known;
    for (const FrictionLaw friction : core::kEnumerators<FrictionLaw>) {
      for (const LatticeKind kind : core::kEnumerators<LatticeKind>) {
        if (friction != FrictionLaw::Lattice && kind != LatticeKind::Rows) continue;
        const scene::ScaleMode scale = core::kEnumerators<scene::ScaleMode>[turn++ % scene::kScaleModes.size()];
        SCOPED_TRACE(fmt::format("law {}, friction {}, lattice {}, scale {}", static_cast<int>(law),
                                 static_cast<int>(friction), static_cast<int>(kind), static_cast<int>(scale)));
        const scene::SharedModel model = model_of(law, friction_of(friction, kind));
        if (!scene::why_no_friction(friction, law, model.materials[test::kMica].contact.reduced_modulus).empty()) {
          EXPECT_FALSE(scene::validate(model));
          continue;
        }
        ServoBench bench(model);
        ASSERT_NO_FATAL_FAILURE(feel(bench, scale));
        laws.insert(law);
        frictions.insert(friction);
        if (friction == FrictionLaw::Lattice) lattices.insert(kind);
        scales.insert(scale);
      }
    }
  }
  EXPECT_EQ(laws.size(), known);
  EXPECT_EQ(frictions.size(), core::kEnumerators<FrictionLaw>.size());
  EXPECT_EQ(lattices.size(), core::kEnumerators<LatticeKind>.size());
  EXPECT_EQ(scales.size(), scene::kScaleModes.size());
}

}  // namespace servo_enumerators_test
}  // namespace afm

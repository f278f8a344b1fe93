// SPDX-License-Identifier: Apache-2.0
#include "app/micro/physics_benchmarks.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "physics/dynamic_model.h"
#include "physics/force_model.h"
#include "physics/law_tables.h"

namespace afm::app {
namespace {

using namespace physics::literals;
using physics::Law;
using physics::Length;

constexpr double kTickBar_s = 50e-9;
constexpr double kTablesBar_s = 5e-3;
constexpr double kSubStepBar_s = 20e-9;
constexpr double kCurveBar_s = 10e-3;

// Mica under a silicon nitride tip, as in docs/physics.md.
physics::ContactParameters mica() {
  physics::ContactParameters contact;
  contact.tip_radius = 50_nm;
  contact.spring_constant = 0.1_N_per_m;
  contact.sample_stiffness = physics::Stiffness(std::numeric_limits<double>::infinity());
  contact.hamaker = 24.5_zJ;
  contact.mean_surface_energy = 2.228_mJ_per_m2;
  contact.reduced_modulus = physics::Pressure(51.5e9);
  return contact;
}

// Repeated cycles of the hand: down from above the jump off contact to 2 nm into the sample, and up again.
class Path {
 public:
  explicit Path(Length z_joc) {
    const Length top = 1.2 * z_joc + 1_nm, bottom = -2_nm;
    constexpr std::size_t kHalf = kCount / 2;
    for (std::size_t i = 0; i < kHalf; ++i) {
      z_[i] = top + static_cast<double>(i) / kHalf * (bottom - top);
      z_[kHalf + i] = bottom + static_cast<double>(i) / kHalf * (top - bottom);
    }
  }

  Length next() {
    at_ = (at_ + 1) % kCount;
    return z_[at_];
  }

 private:
  static constexpr std::size_t kCount = 4096;
  std::array<Length, kCount> z_;
  std::size_t at_ = 0;
};

void tick(benchmark::State& state, Law law) {
  physics::ApproachRetractModel model(physics::build_law_tables(law, mica()));
  Path path(model.figures().z_joc);
  for (auto turn : state) benchmark::DoNotOptimize(model.step(path.next()));
}

void tables(benchmark::State& state, Law law) {
  for (auto turn : state) benchmark::DoNotOptimize(physics::build_law_tables(law, mica()));
}

void dynamic_tick(benchmark::State& state) {
  physics::DynamicModel model(Law::Dmt, mica(), {12_kHz, 2.5, 298_K}, physics::Time(1e-3));
  Path path(model.figures().z_joc);
  for (auto turn : state) benchmark::DoNotOptimize(model.step(path.next()));
}

// Starts the program as a shell would, and waits for it. Discards its output.
bool run_quietly(const std::string& program, std::vector<std::string> arguments) {
  std::vector<char*> argv;
  arguments.insert(arguments.begin(), program);
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const bool started = posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return started && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// Computes a curve of 10,001 samples.
void whole_curve(benchmark::State& state, const std::string& program) {
  for (auto turn : state) {
    if (!run_quietly(program, {"curve", "--material", "mica", "--from", "20nm", "--to", "-5nm", "--step", "0.005nm"})) {
      state.SkipWithError("touchafm curve failed");
      return;
    }
  }
}

}  // namespace

std::vector<BenchmarkCase> physics_benchmarks(const std::string& program) {
  std::vector<BenchmarkCase> cases;
  const std::vector<Law> laws = physics::laws_with(&physics::LawTraits::computed);
  cases.reserve(laws.size());
  for (const Law law : laws) {
    cases.push_back({.name = "tick " + std::string(name_of(law)),
                     .bar_s = kTickBar_s,
                     .run = [law](benchmark::State& state) { tick(state, law); }});
  }
  for (const Law law : laws) {
    cases.push_back({.name = "tables " + std::string(name_of(law)),
                     .bar_s = kTablesBar_s,
                     .run = [law](benchmark::State& state) { tables(state, law); }});
  }
  cases.push_back({.name = "sub-step dynamic-dmt",
                   .bar_s = kSubStepBar_s,
                   .operations = static_cast<double>(physics::DynamicModel::kSubSteps),
                   .run = dynamic_tick});
  cases.push_back({.name = "curve of 10,000 points",
                   .bar_s = kCurveBar_s,
                   .clock = BenchmarkClock::Wall,
                   .run = [program](benchmark::State& state) { whole_curve(state, program); }});
  return cases;
}

}  // namespace afm::app

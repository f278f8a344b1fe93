// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/lesson_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "curves/curve_output.h"
#include "curves/tapping/driven_setup.h"

namespace afm::exhibit {

namespace {

double f_ad_n(const curves::SampleModel& sample) { return std::abs(sample.figures().force_before_joc.si); }

core::Result<void> check_threshold(const LessonStep& step, const curves::SampleModel& standard, double strongest_n) {
  const double most_n = (1.0 + step.threshold.most) * f_ad_n(standard);
  if (most_n <= strongest_n) return {};
  return core::failure(
      core::ErrorCategory::BadInputFile,
      fmt::format("lesson step {}: its strongest pull-off would be {:.4g} nN, and no material of the lesson lets go at "
                  "more than {:.4g} nN, so that the common scale would hide the difference; lower most or add a "
                  "stronger material",
                  step.id, most_n * 1e9, strongest_n * 1e9));
}

}  // namespace

core::Result<void> check_samples(const Lesson& lesson, std::span<const curves::SampleModel> samples) {
  double strongest_n = 0;
  for (const curves::SampleModel& sample : samples) strongest_n = std::max(strongest_n, f_ad_n(sample));
  for (const LessonStep& step : lesson.steps) {
    for (const std::size_t material : step.materials) {
      if (samples[material].figures().hysteretic) continue;
      return core::failure(
          core::ErrorCategory::BadInputFile,
          fmt::format("lesson step {}: {} {}, so that no cycle of it ends", step.id, lesson.materials[material],
                      lesson.tapping ? "has one state of the swing at each height" : "neither snaps in nor pulls off"));
    }
    if (step.kind != StepKind::Threshold) continue;
    if (auto checked = check_threshold(step, samples[step.materials.front()], strongest_n); !checked) return checked;
  }
  return {};
}

core::Result<curves::ContactSetup> lesson_setup(const Lesson& lesson, const scene::MaterialEntry& entry) {
  if (!lesson.tapping) return curves::ContactSetup{entry, {}, {}};
  auto setup = curves::tapped_setup(entry, *lesson.tapping);
  if (setup) return setup;
  return core::failure(core::ErrorCategory::BadInputFile, "tapping: " + setup.error().message);
}

core::Result<std::vector<curves::SampleModel>> lesson_samples(const Lesson& lesson,
                                                              const scene::MaterialLibrary& library) {
  std::vector<curves::SampleModel> samples;
  for (const std::string& name : lesson.materials) {
    const auto entry = library.require(name);
    if (!entry) return tl::unexpected(entry.error());
    const auto setup = lesson_setup(lesson, **entry);
    if (!setup) return tl::unexpected(setup.error());
    auto sample = curves::make_sample_model(*setup);
    if (!sample) return tl::unexpected(sample.error());
    samples.push_back(std::move(*sample));
  }
  if (auto checked = check_samples(lesson, samples); !checked) return tl::unexpected(checked.error());
  return samples;
}

core::Result<std::string> samples_json(const Lesson& lesson, const scene::MaterialLibrary& library) {
  nlohmann::ordered_json samples = nlohmann::ordered_json::object();
  for (const std::string& name : lesson.materials) {
    const auto entry = library.require(name);
    if (!entry) return tl::unexpected(entry.error());
    const auto setup = lesson_setup(lesson, **entry);
    if (!setup) return tl::unexpected(setup.error());
    nlohmann::ordered_json sample{{"parameters", curves::parameters_json(*setup)}};
    curves::add_sources(sample, *setup);
    // the data set names the program once
    sample.erase("software");
    sample.erase("software_version");
    samples[name] = std::move(sample);
  }
  return samples.dump();
}

// F_ad is proportional to the surface energy. Multiplying stiffness and Hamaker constant by the same factor multiplies
// the whole curve F(Z), so its folds keep their places (3.8), (3.13).
core::Result<curves::SampleModel> comparison_sample(const curves::SampleModel& standard, DistanceCue distance, double w,
                                                    double rove) {
  curves::ContactSetup changed = standard.setup;
  physics::ContactParameters& contact = changed.material.contact;
  contact.mean_surface_energy.si *= 1.0 + w;
  const double stiffer = distance == DistanceCue::Kept ? 1.0 + w : rove;
  contact.spring_constant.si *= stiffer;
  contact.sample_stiffness.si *= stiffer;
  if (distance == DistanceCue::Kept) contact.hamaker.si *= 1.0 + w;
  return curves::make_sample_model(standard, changed);
}

}  // namespace afm::exhibit

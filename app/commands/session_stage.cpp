// SPDX-License-Identifier: Apache-2.0
#include "app/commands/session_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "curves/measured_material.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/recorded_map.h"
#include "scene/samples/particle_set.h"
#include "servo/session_file.h"

namespace afm::app {

namespace {

// Curve of a session without its map, as a sample.
scene::MaterialEntry entry_of_curve(const servo::RecordedSession& session) {
  scene::MaterialEntry entry;
  entry.name = session.material;
  entry.title = "Measured curve";
  if (session.curve->column >= 0) entry.title += fmt::format(" ({},{})", session.curve->column, session.curve->row);
  entry.look = scene::kPaperMaterials.front();
  entry.contact = session.parameters.contact;
  return entry;
}

core::Result<exhibit::ExhibitFiles> files_for(const servo::RecordedSession& session, const std::string& path,
                                              const exhibit::ExhibitFiles& given) {
  auto with_map = exhibit::with_recorded_map(session, path, given);
  if (!with_map) return with_map;
  exhibit::ExhibitFiles files = std::move(*with_map);
  const auto& paper = scene::kPaperMaterials;
  if (!session.wall.empty() && files.shown.empty()) {
    files.shown = session.shown;
    std::erase(files.shown, curves::kMeasuredName);  // in no material file: drawn with the session's curve or map
  }
  const bool shown_anyway = !files.materials.empty() || !files.shown.empty() ||
                            std::find(paper.begin(), paper.end(), session.material) != paper.end();
  if (session.curve && files.force_map.empty()) {
    files.added.push_back(entry_of_curve(session));
  } else if (!shown_anyway && !session.law_map && !session.curve) {
    files.shown = {session.material};
  }
  if (!session.particles) return files;
  if (!files.sample.empty()) {
    return core::wrong_usage("--sample: the session's particles rest on a level sample of their own; leave it out");
  }
  files.recorded_particles =
      std::make_shared<const scene::ParticleSet>(scene::recorded_set(session.particles->set, files.assets_dir));
  return files;
}

// The session's own sample with the recorded parameters.
core::Result<curves::SampleModel> felt_model(const servo::RecordedSession& session, const scene::MaterialEntry& entry,
                                             const exhibit::Stage& stage) {
  if (stage.pixel && stage.pixel->felt_map) {
    curves::SampleModel map = *stage.pixel;
    map.parameters = session.parameters;
    return map;
  }
  std::vector<scene::SharedMeasuredCurve> recorded;
  if (session.curve) recorded.push_back(*session.curve);
  auto model = curves::make_sample_model(entry, session.parameters, recorded);
  if (model && stage.pixel) model->pixel = stage.pixel->pixel;
  return model;
}

}  // namespace

core::Result<exhibit::Stage> stage_of_session(const servo::RecordedSession& session, const std::string& path,
                                              const exhibit::ExhibitFiles& files) {
  const auto drawn = files_for(session, path, files);
  if (!drawn) return tl::unexpected(drawn.error());
  auto stage = exhibit::load_exhibit(*drawn);
  if (!stage && stage.error().category == core::ErrorCategory::WrongUsage) {  // unusable materials in the session file
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("session file {}: {}", path, stage.error().message));
  }
  if (!stage) return stage;
  exhibit::compare_map(session, path, *stage);
  const auto& materials = stage->materials.materials;
  if (std::any_of(materials.begin(), materials.end(), [&](const auto& m) { return m.name == session.material; }))
    return stage;
  return core::failure(
      core::ErrorCategory::BadInputFile,
      fmt::format(
          "session file {}: its material \"{}\" is not in the material file; name the right file with --materials",
          path, session.material));
}

core::Result<std::vector<curves::SampleModel>> models_of_session(const servo::RecordedSession& session,
                                                                 const exhibit::Stage& stage) {
  std::vector<curves::SampleModel> models;
  models.reserve(stage.materials.materials.size());
  for (const scene::MaterialEntry& entry : stage.materials.materials) {
    auto one = entry.name == session.material ? felt_model(session, entry, stage)
                                              : curves::make_sample_model(curves::ContactSetup{entry, {}, {}});
    if (!one) return tl::unexpected(one.error());
    models.push_back(std::move(*one));
  }
  return models;
}

}  // namespace afm::app

// SPDX-License-Identifier: Apache-2.0
#include "curves/measured_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "core/log.h"
#include "curves/curve_file.h"
#include "physics/measured_branches.h"

namespace afm::curves {

std::string title_of(const std::string& path) {
  std::string title = std::filesystem::path(path).stem().string();
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

namespace {

scene::MaterialEntry entry_of(const std::string& path, const CurveMetadata& metadata,
                              const scene::MaterialEntry& like) {
  scene::MaterialEntry entry;
  entry.name = kMeasuredName;
  entry.title = title_of(path);
  entry.look = like.look;
  entry.note = metadata.instrument;
  entry.contact = like.contact;
  if (metadata.spring_constant) {
    entry.contact.spring_constant = *metadata.spring_constant;
    entry.sources.push_back({"spring_constant", fmt::format("{:g} N/m", metadata.spring_constant->si),
                             std::filesystem::path(path).filename().string(), false});
  }
  return entry;
}

}  // namespace

core::Result<MeasuredMaterial> load_measured_material(const std::string& path, const scene::MaterialEntry& like) {
  const auto recorded = load_curve(path);
  if (!recorded) return tl::unexpected(recorded.error());
  return measured_material(*recorded, path, like);
}

core::Result<MeasuredMaterial> measured_material(const RecordedCurve& recorded, const std::string& path,
                                                 const scene::MaterialEntry& like) {
  for (const std::string& remark : recorded.metadata.remarks) core::log_line(fmt::format("{}: {}", path, remark));
  try {
    const auto branches = physics::measured_branches(recorded.points, scene::kMaxMeasuredPoints);
    MeasuredMaterial measured{entry_of(path, recorded.metadata, like), {}, physics::analyse(recorded.points)};
    measured.curve.approach_count = static_cast<std::uint32_t>(branches.approach.size());
    measured.curve.retract_count = static_cast<std::uint32_t>(branches.retract.size());
    measured.curve.jumps = branches.jumps;
    std::copy(branches.approach.begin(), branches.approach.end(), measured.curve.approach.begin());
    std::copy(branches.retract.begin(), branches.retract.end(), measured.curve.retract.begin());
    return measured;
  } catch (const std::invalid_argument& error) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("curve file {}: {}", path, error.what()));
  }
}

}  // namespace afm::curves

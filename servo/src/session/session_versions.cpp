// SPDX-License-Identifier: Apache-2.0
#include "session_versions.h"

#include <algorithm>

#include "scene/shared/map_vibration.h"
#include "session_particles.h"
#include "session_records.h"

namespace afm::servo {

namespace {

template <bool (*Test)(const RecordedParticles&)>
bool with(const RecordedSession& session) {
  return session.particles && Test(*session.particles);
}

template <bool (*Test)(const scene::SharedParticles&)>
bool with(const RecordedSession& session) {
  return session.particles && Test(session.particles->set);
}

bool vibrates(const RecordedSession& session) {
  return session.law_map && session.parameters.map_vibration != scene::MapVibration::None;
}

bool is_viscous(const RecordedSession& session) { return session.law_map && session.parameters.viscous_map != 0; }
bool has_law_map(const RecordedSession& session) { return session.law_map != nullptr; }

template <scene::OlderTapping Older>
bool taps(const RecordedSession& session) {
  return scene::taps(session.parameters) && session.parameters.older_tapping == Older;
}

bool has_no_particles(const RecordedSession& session) { return !session.particles; }
bool lifts(const scene::SharedParticles& set) { return scene::has_pads(set) || scene::has_lift(set); }
bool has_plans(const RecordedSession& session) { return session.has_plans; }
bool is_any(const RecordedSession&) { return true; }

constexpr bool kPlans = true;

// Versions with chunks. Missing numbers were in no release; 3, of TouchAFM 0.1.0, has no chunks.
constexpr std::array kVersions{
    SessionVersion{20, kSampleBytesWithoutPush, !kPlans, {"LAWS"}, vibrates},
    SessionVersion{18, kSampleBytesWithoutPush, !kPlans, {"LAWS"}, is_viscous},
    SessionVersion{15, kSampleBytesWithoutPush, !kPlans, {"LAWS"}, has_law_map},
    SessionVersion{22, kSampleBytesWithoutPlan, !kPlans, {}, taps<scene::OlderTapping::None>},
    SessionVersion{21, kSampleBytesWithoutPlan, !kPlans, {}, taps<scene::OlderTapping::Version21>},
    SessionVersion{10, kSampleBytesWithoutPlan, !kPlans, {}, taps<scene::OlderTapping::Version10>},
    SessionVersion{6, kSampleBytesWithoutPush, !kPlans, {}, has_no_particles},
    SessionVersion{17, kSampleBytesWithoutLevel, kPlans, {"SOFT"}, with<is_soft>},
    SessionVersion{19, kSampleBytesWithoutLevel, kPlans, {"INKS"}, with<is_ink>},
    SessionVersion{14, kMostSampleBytes, kPlans, {"PRTC", "RODS", "LEVL"}, with<has_level>},
    SessionVersion{13, kSampleBytesWithoutLevel, kPlans, {"PRTC", "RODS", "ISLE"}, with<scene::has_islands>},
    SessionVersion{12, kSampleBytesWithoutLevel, kPlans, {"PRTC", "RODS", "PADS"}, with<lifts>},
    SessionVersion{11, kSampleBytesWithoutLevel, kPlans, {"PRTC", "RODS"}, has_plans},
    SessionVersion{9, kSampleBytesWithoutSwing, !kPlans, {"PRTC", "RODS"}, with<scene::has_hold>},
    SessionVersion{8, kSampleBytesWithoutSwing, !kPlans, {"PRTC", "RODS"}, with<scene::has_rods>},
    SessionVersion{7, kSampleBytesWithoutSwing, !kPlans, {"PRTC"}, is_any}};

}  // namespace

std::span<const SessionVersion> session_versions() { return kVersions; }

const SessionVersion& version_of(const RecordedSession& session) {
  return *std::find_if(kVersions.begin(), kVersions.end(),
                       [&](const SessionVersion& version) { return version.is_of(session); });
}

const SessionVersion* find_version(std::uint32_t number) {
  const auto found = std::find_if(kVersions.begin(), kVersions.end(),
                                  [&](const SessionVersion& version) { return version.number == number; });
  return found == kVersions.end() ? nullptr : &*found;
}

bool may_have(const SessionVersion& version, std::string_view chunk) {
  return std::find(version.chunks.begin(), version.chunks.end(), chunk) != version.chunks.end();
}

}  // namespace afm::servo

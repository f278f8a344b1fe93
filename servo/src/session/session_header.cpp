// SPDX-License-Identifier: Apache-2.0
#include "session_header.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "core/written_by.h"
#include "scene/shared/map_vibration.h"
#include "scene/shared/shared_segment.h"
#include "session_versions.h"

namespace afm::servo {

namespace {

constexpr const char* kHarmonics = "harmonics";
constexpr const char* kOfTheDrive = "of-the-drive";  // harmonics of the drive; without this word those of the resonance
constexpr const char* kJumpOff = "jump_off";
constexpr const char* kWhereSeen = "where-seen";  // Z of a jump off; without this word that of the last crossed phase
constexpr const char* kFeltMeanForce = "mean-force";  // felt mean force of a tapping lever; without this word its push

// Omits rigid values: JSON has no infinity.
nlohmann::json json_of(const physics::ContactParameters& contact) {
  nlohmann::json json;
  for (const physics::ContactField& field : physics::kContactFields) {
    if (std::isfinite(field.get(contact))) json[field.json_key] = field.get(contact);
  }
  return json;
}

physics::ContactParameters contact_of(const nlohmann::json& json) {
  physics::ContactParameters contact;
  for (const physics::ContactField& field : physics::kContactFields) {
    const bool rigid = field.infinity == physics::Infinity::Allowed && !json.contains(field.json_key);
    field.set(contact, rigid ? HUGE_VAL : json.at(field.json_key).get<double>());
  }
  return contact;
}

nlohmann::json json_of(const physics::FrictionParameters& friction) {
  return {{"law", static_cast<std::uint32_t>(friction.law)},
          {"lattice", static_cast<std::uint32_t>(friction.lattice)},
          {"coefficient", friction.coefficient},
          {"shear_strength_Pa", friction.shear_strength.si},
          {"period_m", friction.period.si},
          {"corrugation_m", friction.corrugation.si},
          {"lateral_stiffness_N_per_m", friction.lateral_stiffness.si}};
}

physics::FrictionParameters friction_of(const nlohmann::json& json) {
  return {.law = static_cast<physics::FrictionLaw>(json.at("law").get<std::uint32_t>()),
          .lattice = static_cast<physics::LatticeKind>(json.at("lattice").get<std::uint32_t>()),
          .coefficient = json.at("coefficient").get<double>(),
          .shear_strength = physics::Pressure(json.at("shear_strength_Pa").get<double>()),
          .period = physics::Length(json.at("period_m").get<double>()),
          .corrugation = physics::Length(json.at("corrugation_m").get<double>()),
          .lateral_stiffness = physics::Stiffness(json.at("lateral_stiffness_N_per_m").get<double>())};
}

nlohmann::json json_of(const physics::LeverDynamics& lever) {
  return {{"resonance_Hz", lever.resonance.si},
          {"quality_factor", lever.quality_factor},
          {"temperature_K", lever.temperature.si}};
}

nlohmann::json json_of(const scene::SharedContact& m) {
  nlohmann::json json{{"law", static_cast<std::uint32_t>(m.law)},
                      {"interaction", json_of(m.contact)},
                      {"exact_hamaker_sphere", m.exact_hamaker_sphere != 0},
                      {"retardation_wavelength_m", m.retardation_wavelength_m}};
  if (m.has_meniscus != 0) {
    json["meniscus"] = {{"surface_tension_N_per_m", m.meniscus.surface_tension.si},
                        {"contact_angle_rad", m.meniscus.contact_angle_rad},
                        {"relative_humidity", m.meniscus.relative_humidity}};
  }
  if (m.height_field == scene::kTopography || m.law_map != 0) {
    json["topography"] = {{"lateral", m.topography.lateral}, {"vertical", m.topography.vertical}};
  }
  if (m.surface_release_m != 0.0) json["surface_release_m"] = m.surface_release_m;
  if (m.law_map != 0) json["law_map"] = true;
  if (m.viscous_map != 0) json["viscous_map"] = true;
  if (m.map_vibration != scene::MapVibration::None) {
    json["map_vibration"] = static_cast<std::uint32_t>(m.map_vibration);
  }
  if (m.dynamic != 0) json["dynamics"] = json_of(m.lever);
  if (scene::taps(m)) {
    json["tapping"] = json_of(m.lever);
    json["tapping"].update(
        {{"free_amplitude_m", m.free_amplitude_m}, {"drive_Hz", m.drive_hz}, {"viscosity_Pa_s", m.viscosity_pa_s}});
    if (m.older_tapping != scene::OlderTapping::Version10) json["tapping"][kHarmonics] = kOfTheDrive;
    if (m.older_tapping == scene::OlderTapping::None) json["tapping"][kJumpOff] = kWhereSeen;
    if (m.felt_mean_force != 0) json["tapping"]["felt"] = kFeltMeanForce;
  }
  if (m.friction.law != physics::FrictionLaw::None) json["friction"] = json_of(m.friction);
  return json;
}

physics::LeverDynamics lever_of(const nlohmann::json& json) {
  return {.resonance = physics::Frequency(json.at("resonance_Hz").get<double>()),
          .quality_factor = json.at("quality_factor").get<double>(),
          .temperature = physics::Temperature(json.at("temperature_K").get<double>())};
}

scene::SharedContact parameters_of(const nlohmann::json& json, const std::string& name) {
  scene::SharedContact m;
  m.name = scene::to_name(name);
  m.law = static_cast<physics::Law>(json.at("law").get<std::uint32_t>());
  if (m.law == physics::Law::Measured) m.measured_curve = 0;
  m.contact = contact_of(json.at("interaction"));
  m.exact_hamaker_sphere = json.at("exact_hamaker_sphere").get<bool>() ? 1 : 0;
  m.retardation_wavelength_m = json.at("retardation_wavelength_m").get<double>();
  if (const auto meniscus = json.find("meniscus"); meniscus != json.end()) {
    m.has_meniscus = 1;
    m.meniscus = {.surface_tension = physics::SurfaceEnergy(meniscus->at("surface_tension_N_per_m").get<double>()),
                  .contact_angle_rad = meniscus->at("contact_angle_rad").get<double>(),
                  .relative_humidity = meniscus->at("relative_humidity").get<double>()};
  }
  if (const auto topography = json.find("topography"); topography != json.end()) {
    m.topography = {.lateral = topography->at("lateral").get<double>(),
                    .vertical = topography->at("vertical").get<double>()};
  }
  m.surface_release_m = json.value("surface_release_m", 0.0);
  m.law_map = json.value("law_map", false) ? 1 : 0;
  m.viscous_map = json.value("viscous_map", false) ? 1 : 0;
  m.map_vibration = static_cast<scene::MapVibration>(json.value("map_vibration", std::uint32_t{0}));
  if (const auto dynamics = json.find("dynamics"); dynamics != json.end()) {
    m.dynamic = 1;
    m.lever = lever_of(*dynamics);
  }
  if (const auto tapping = json.find("tapping"); tapping != json.end()) {
    m.free_amplitude_m = tapping->at("free_amplitude_m").get<double>();
    m.drive_hz = tapping->at("drive_Hz").get<double>();
    m.viscosity_pa_s = tapping->at("viscosity_Pa_s").get<double>();
    m.lever = lever_of(*tapping);
    m.older_tapping = tapping->value(kHarmonics, "") != kOfTheDrive ? scene::OlderTapping::Version10
                      : tapping->value(kJumpOff, "") != kWhereSeen  ? scene::OlderTapping::Version21
                                                                    : scene::OlderTapping::None;
    m.felt_mean_force = tapping->value("felt", "") == kFeltMeanForce ? 1 : 0;
  }
  if (const auto friction = json.find("friction"); friction != json.end()) m.friction = friction_of(*friction);
  return m;
}

nlohmann::json json_of(std::span<const physics::MeasuredPoint> branch) {
  nlohmann::json json = nlohmann::json::array();
  for (const physics::MeasuredPoint& point : branch) json.push_back({point.z.si, point.force.si});
  return json;
}

std::uint32_t branch_of(const nlohmann::json& json, std::span<physics::MeasuredPoint> branch) {
  const auto count = static_cast<std::uint32_t>(std::min(json.size(), branch.size()));
  for (std::uint32_t i = 0; i < count; ++i) {
    branch[i] = {.z = physics::Length(json.at(i).at(0).get<double>()),
                 .force = physics::Force(json.at(i).at(1).get<double>())};
  }
  return count;
}

nlohmann::json json_of(const scene::SharedDevice& device) {
  nlohmann::json json{{"name", device.name.data()},
                      {"max_force_N", device.max_force_n},
                      {"max_continuous_force_N", device.max_continuous_force_n},
                      {"max_stiffness_N_per_m", device.max_stiffness_n_per_m},
                      {"workspace_min_m", device.workspace_min_m},
                      {"workspace_max_m", device.workspace_max_m}};
  // omitted if unlimited
  if (std::isfinite(device.max_slew_n_per_s)) json["max_slew_N_per_s"] = device.max_slew_n_per_s;
  if (std::isfinite(device.max_speed_m_per_s)) json["max_speed_m_per_s"] = device.max_speed_m_per_s;
  return json;
}

scene::SharedDevice device_of(const nlohmann::json& json) {
  scene::SharedDevice device{.name = {},
                             .max_force_n = json.at("max_force_N").get<double>(),
                             .max_continuous_force_n = json.at("max_continuous_force_N").get<double>(),
                             .max_stiffness_n_per_m = json.at("max_stiffness_N_per_m").get<double>(),
                             .max_slew_n_per_s = json.value("max_slew_N_per_s", HUGE_VAL),
                             .max_speed_m_per_s = json.value("max_speed_m_per_s", HUGE_VAL),
                             .max_vibration_n = json.value("max_vibration_N", 0.0),
                             .workspace_min_m = json.at("workspace_min_m").get<std::array<double, 3>>(),
                             .workspace_max_m = json.at("workspace_max_m").get<std::array<double, 3>>()};
  const auto name = json.at("name").get<std::string>();
  device.name = scene::to_name(name);
  return device;
}

// Sources as RecordedSession has them. Throws json::exception if one lacks a member or has it of another type.
nlohmann::json sources_of(const nlohmann::json& json) {
  nlohmann::json sources = nlohmann::json::object();
  for (const auto& [key, source] : json.get_ref<const nlohmann::json::object_t&>()) {
    sources[key] = {{"value", source.at("value").get<std::string>()},
                    {"source", source.at("source").get<std::string>()},
                    {"estimated", source.at("estimated").get<bool>()}};
  }
  return sources;
}

// Size written in place of a height field's if the sample has a topography. A TouchAFM without topographies then
// rejects the session instead of replaying a plane.
constexpr std::size_t kTopographyBytes = 0;

std::size_t surface_bytes_of(const RecordedSession& session) {
  return session.topography.columns > 0 ? kTopographyBytes : sizeof(scene::SharedHeightField);
}

}  // namespace

nlohmann::json header_of(const RecordedSession& session) {
  nlohmann::json header{{"material", session.material},
                        {"parameters", json_of(session.parameters)},
                        {"rate_hz", session.rate_hz},
                        {"realtime", session.realtime},
                        {"hand_m_per_m", session.hand_m_per_m},
                        {"hand_N_per_N", session.hand_n_per_n},
                        {"slow_motion", session.slow_motion},
                        {"room_from_sample", session.room_from_sample},
                        {"device", json_of(session.device)},
                        {"dead_man", session.dead_man},
                        {"sample_bytes", version_of(session).sample_bytes},
                        {"event_bytes", sizeof(scene::TipEvent)},
                        {"surface_bytes", surface_bytes_of(session)}};
  if (const auto& curve = session.curve) {
    header["measured"] = {{"approach", json_of(std::span(curve->approach).first(curve->approach_count))},
                          {"retract", json_of(std::span(curve->retract).first(curve->retract_count))},
                          {"jumps", {curve->jumps.approach, curve->jumps.retract}}};
    if (curve->column >= 0) header["measured"]["pixel"] = {curve->column, curve->row};
  }
  if (session.parameters.map_vibration != scene::MapVibration::None) {
    header["device"]["max_vibration_N"] = session.device.max_vibration_n;
  }
  if (!session.sources.empty()) header["sources"] = nlohmann::json::parse(session.sources);
  if (const auto& map = session.force_map) {
    header["force_map"] = {
        {"file", map->file}, {"digest", map->digest}, {"reading", map->reading}, {"pixel", map->pixel}};
  }
  if (!session.shown.empty()) header["shown"] = session.shown;
  if (!session.earlier_curves.empty()) header["earlier_curves"] = json_of(session.earlier_curves);
  core::name_software(header);
  return header;
}

bool fits_records(const nlohmann::json& header, std::size_t sample_bytes) {
  const auto surface_bytes = header.at("surface_bytes").get<std::size_t>();
  return header.at("sample_bytes") == sample_bytes && header.at("event_bytes") == sizeof(scene::TipEvent) &&
         (surface_bytes == sizeof(scene::SharedHeightField) || surface_bytes == kTopographyBytes);
}

RecordedSession session_of(const nlohmann::json& header) {
  RecordedSession session;
  session.material = header.at("material").get<std::string>();
  session.parameters = parameters_of(header.at("parameters"), session.material);
  if (const auto sources = header.find("sources"); sources != header.end()) {
    session.sources = sources_of(*sources).dump();
  }
  session.rate_hz = header.at("rate_hz").get<double>();
  session.realtime = header.at("realtime").get<bool>();
  session.hand_m_per_m = header.at("hand_m_per_m").get<double>();
  session.hand_n_per_n = header.at("hand_N_per_N").get<double>();
  session.slow_motion = header.at("slow_motion").get<double>();
  session.room_from_sample = header.at("room_from_sample").get<std::array<double, 16>>();
  session.device = device_of(header.at("device"));
  session.dead_man = header.at("dead_man").get<bool>();
  if (const auto measured = header.find("measured"); measured != header.end()) {
    scene::SharedMeasuredCurve& curve = session.curve.emplace();
    curve.approach_count = branch_of(measured->at("approach"), curve.approach);
    curve.retract_count = branch_of(measured->at("retract"), curve.retract);
    // missing from files of 0.1.0
    const auto jumps = measured->value("jumps", std::array<std::uint32_t, 2>{});
    curve.jumps = {.approach = jumps[0], .retract = jumps[1]};
    const auto pixel = measured->value("pixel", std::array<std::int32_t, 2>{-1, -1});
    curve.column = pixel[0];
    curve.row = pixel[1];
  }
  if (const auto map = header.find("force_map"); map != header.end()) {
    session.force_map = {.file = map->at("file").get<std::string>(),
                         .digest = map->at("digest").get<std::string>(),
                         .reading = map->at("reading").get<std::string>(),
                         .pixel = map->at("pixel").get<std::array<std::size_t, 2>>()};
  }
  if (const auto shown = header.find("shown"); shown != header.end()) shown->get_to(session.shown);
  if (const auto curves = header.find("earlier_curves"); curves != header.end()) {
    session.earlier_curves = curves_of(*curves);
  }
  return session;
}

}  // namespace afm::servo

// SPDX-License-Identifier: Apache-2.0
#include "servo/session_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <type_traits>

#include "core/fnv1a.h"
#include "core/whole_file.h"
#include "scene/shared/shared_segment.h"

namespace afm::servo {

namespace {

static_assert(std::endian::native == std::endian::little, "session records are little-endian");

constexpr std::string_view kMagic = "AFMS";
constexpr std::uint32_t kVersion = 3;

using scene::SharedHeightField;
using scene::TipEvent;
using scene::TipSample;

// The records of version 3, to the byte.
static_assert(sizeof(TipSample) == 216 && offsetof(TipSample, tip) == 16 && offsetof(TipSample, hand_height_m) == 56 &&
              offsetof(TipSample, servo_state) == 72 && offsetof(TipSample, hand_from_contact_m) == 104 &&
              offsetof(TipSample, surface) == 176 && offsetof(TipSample, motor_heat) == 200);
static_assert(sizeof(TipEvent) == 40 && offsetof(TipEvent, time_ns) == 8 && offsetof(TipEvent, z_m) == 16);

template <class T>
void put(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <class T>
bool take(std::string_view& bytes, T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (bytes.size() < sizeof(T)) return false;
  const std::string_view here = bytes.substr(0, sizeof(T));
  std::copy(here.begin(), here.end(), reinterpret_cast<char*>(&value));
  bytes.remove_prefix(sizeof(T));
  return true;
}

template <class T>
void put_all(std::string& bytes, const std::vector<T>& values) {
  put(bytes, std::uint64_t{values.size()});
  for (const T& value : values) put(bytes, value);
}

template <class T>
bool take_all(std::string_view& bytes, std::vector<T>& values) {
  std::uint64_t count = 0;
  if (!take(bytes, count) || count > bytes.size() / sizeof(T)) return false;
  values.resize(count);
  return std::all_of(values.begin(), values.end(), [&](T& value) { return take(bytes, value); });
}

template <class Record>
bool finite(const Record& record) {
  bool all = true;
  scene::for_each_leaf(
      [&]<class Value>(const char*, const Value& value) {
        if constexpr (std::is_floating_point_v<Value>) {
          all = all && std::isfinite(value);
        } else if constexpr (!std::is_integral_v<Value> && !std::is_enum_v<Value>) {
          all = all && std::all_of(value.begin(), value.end(), [](double number) { return std::isfinite(number); });
        }
      },
      record);
  return all;
}

// JSON has no infinity: what is rigid has no entry.
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
  if (m.dynamic != 0) {
    json["dynamics"] = {{"resonance_Hz", m.lever.resonance.si},
                        {"quality_factor", m.lever.quality_factor},
                        {"temperature_K", m.lever.temperature.si}};
  }
  return json;
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
  if (const auto dynamics = json.find("dynamics"); dynamics != json.end()) {
    m.dynamic = 1;
    m.lever = {.resonance = physics::Frequency(dynamics->at("resonance_Hz").get<double>()),
               .quality_factor = dynamics->at("quality_factor").get<double>(),
               .temperature = physics::Temperature(dynamics->at("temperature_K").get<double>())};
  }
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
  // what is not limited has no entry
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
                             .workspace_min_m = json.at("workspace_min_m").get<std::array<double, 3>>(),
                             .workspace_max_m = json.at("workspace_max_m").get<std::array<double, 3>>()};
  const auto name = json.at("name").get<std::string>();
  device.name = scene::to_name(name);
  return device;
}

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
                        {"sample_bytes", sizeof(TipSample)},
                        {"event_bytes", sizeof(TipEvent)},
                        {"surface_bytes", sizeof(SharedHeightField)}};
  if (const auto& curve = session.curve) {
    header["measured"] = {{"approach", json_of(std::span(curve->approach).first(curve->approach_count))},
                          {"retract", json_of(std::span(curve->retract).first(curve->retract_count))}};
  }
  return header;
}

// Throws nlohmann::json::exception when a key is missing or of the wrong type.
RecordedSession session_of(const nlohmann::json& header) {
  RecordedSession session;
  session.material = header.at("material").get<std::string>();
  session.parameters = parameters_of(header.at("parameters"), session.material);
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
  }
  return session;
}

}  // namespace

double RecordedSession::seconds_since_start(std::int64_t time_ns) const {
  return samples.empty() ? 0.0 : static_cast<double>(time_ns - samples.front().time_ns) * 1e-9;
}

const TipEvent* RecordedSession::find(physics::EventKind kind) const {
  const auto found = std::find_if(events.begin(), events.end(), [&](const TipEvent& e) { return e.kind == kind; });
  return found == events.end() ? nullptr : &*found;
}

std::unique_ptr<scene::SharedModel> model_of(const RecordedSession& session) {
  auto model = std::make_unique<scene::SharedModel>();
  model->node_count = 1;
  model->nodes[0].parent_from_node = session.room_from_sample;
  model->material_count = 2;
  model->materials[0] = model->materials[1] = session.parameters;
  if (session.curve) {
    model->curve_count = 1;
    model->curves[0] = *session.curve;
  }
  if (!session.samples.empty() && session.samples.front().scale_mode == scene::ScaleMode::Common) {
    model->common_hand_m_per_m = session.hand_m_per_m;  // what other materials asked for as well
    model->common_hand_n_per_n = session.hand_n_per_n;
  }
  if (session.surface) {
    model->height_field_count = 1;
    model->height_fields[0] = *session.surface;
  }
  return model;
}

core::Result<void> save_session(const RecordedSession& session, const std::string& path) {
  const std::string header = header_of(session).dump();
  std::string bytes(kMagic);
  put(bytes, kVersion);
  put(bytes, std::uint64_t{header.size()});
  bytes += header;
  put_all(bytes, session.samples);
  put_all(bytes, session.events);
  if (session.surface) {
    put(bytes, std::uint64_t{1});
    put(bytes, *session.surface);
  } else {
    put(bytes, std::uint64_t{0});
  }
  put(bytes, core::fnv1a(bytes));
  return core::write_file(path, bytes);
}

core::Result<RecordedSession> load_session(const std::string& path) {
  const auto bad = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("session file {}: {}", path, why));
  };
  const auto file = core::read_file(path);
  if (!file) return tl::unexpected(file.error());

  std::string_view bytes = *file;
  if (!bytes.starts_with(kMagic)) return bad("this is not a TouchAFM session; give a file that `touchafm demo` wrote");
  std::string_view body = bytes.substr(kMagic.size());
  std::uint32_t version = 0;
  std::uint64_t header_size = 0;
  if (!take(body, version)) return bad("it is cut short; record it again");
  if (version != kVersion) {
    return bad(fmt::format("it has version {}, this program reads version {}; record it again", version, kVersion));
  }
  const std::size_t sum_size = sizeof(std::uint64_t);
  std::uint64_t sum = 0;
  if (bytes.size() < sum_size + kMagic.size()) return bad("it is cut short; record it again");
  std::memcpy(&sum, bytes.data() + bytes.size() - sum_size, sum_size);
  if (sum != core::fnv1a(bytes.substr(0, bytes.size() - sum_size)))
    return bad("its checksum is wrong: it is cut short or altered; record it again");
  body.remove_suffix(sum_size);

  if (!take(body, header_size) || header_size > body.size()) return bad("it is cut short; record it again");
  try {
    const nlohmann::json header = nlohmann::json::parse(body.substr(0, header_size));
    body.remove_prefix(header_size);
    RecordedSession session = session_of(header);
    if (header.at("sample_bytes") != sizeof(TipSample) || header.at("event_bytes") != sizeof(TipEvent) ||
        header.at("surface_bytes") != sizeof(SharedHeightField)) {
      return bad("its records have another size than this program's; record it again");
    }
    std::vector<SharedHeightField> surface;
    if (!take_all(body, session.samples) || !take_all(body, session.events) || !take_all(body, surface) ||
        surface.size() > 1 || !body.empty()) {
      return bad("its records do not fill the file; record it again");
    }
    if (!surface.empty()) session.surface = surface.front();
    session.parameters.height_field = session.surface ? 0 : scene::kNoHeightField;
    if (const auto valid = scene::validate(*model_of(session)); !valid) {
      return bad(valid.error().message + "; record it again");
    }
    if (!scene::is_valid(session.device)) return bad("its device has limits that cannot be; record it again");
    if (!(session.rate_hz > 0 && std::isfinite(session.hand_m_per_m) && std::isfinite(session.hand_n_per_n))) {
      return bad("its rate or its scale cannot be; record it again");
    }
    if (session.samples.empty()) return bad("it holds no sample; record it again");
    const auto is_finite = [](const auto& record) { return finite(record); };
    if (!std::all_of(session.samples.begin(), session.samples.end(), is_finite) ||
        !std::all_of(session.events.begin(), session.events.end(), is_finite)) {
      return bad("it holds numbers that are not finite; record it again");
    }
    return session;
  } catch (const nlohmann::json::exception& error) {
    return bad(fmt::format("its header is damaged ({}); record it again", error.what()));
  }
}

}  // namespace afm::servo

// SPDX-License-Identifier: Apache-2.0
#include "instrument/json_door.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "answer_arrays.h"
#include "arguments.h"
#include "core/printable.h"
#include "core/written_by.h"
#include "curves/curve_output.h"
#include "curves/tapping/tapping_output.h"
#include "fits/thermal_fit.h"
#include "instrument/simulated_instrument.h"
#include "kept_results.h"
#include "refused_request.h"
#include "request_text.h"

namespace afm::instrument {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kProtocol = 1;
constexpr double kUsualSpeedM = 1e-6;  // default speed, m/s
constexpr double kLeastSpeedM = 1e-12, kMostSpeedM = 1.0;
constexpr double kMostWaitS = 1e7;
constexpr std::size_t kMostSpectrumPoints = 100'000, kMostSpectrumWork = 10'000'000;

double speed_of(Arguments& arguments) {
  return arguments.number_or("speed_m_per_s", kUsualSpeedM, kLeastSpeedM, kMostSpeedM);
}

Json position_json(const SimulatedInstrument& instrument) {
  const SimulatedInstrument::Position& at = instrument.position();
  return {{"x_m", at.x_m}, {"y_m", at.y_m}, {"z_m", at.z_m}, {"engaged", at.engaged}};
}

}  // namespace

// Functions of the verbs: each reads its arguments and returns the members of the answer.
struct JsonDoor::Verbs {
  struct Row {
    std::string_view name;
    std::string_view meaning;
    Json (*run)(JsonDoor& door, Arguments& arguments, const Json& id, const Send& send);
  };
  static const std::array<Row, 16> kRows;

  static Json hello(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    constexpr double kMostSeed = 9007199254740992.0;  // largest integer that every JSON library preserves
    const auto seed = arguments.number("seed", 0.0, kMostSeed);
    if (seed && *seed != std::floor(*seed)) throw RefusedRequest("\"seed\": give a whole number");
    arguments.finish();
    if (seed) {
      value_of(door.instrument_.reset(static_cast<std::uint64_t>(*seed)));
      door.results_->forget();
    }
    Json verbs = Json::object();
    for (const Row& row : kRows) verbs[std::string(row.name)] = row.meaning;
    Json answer = Json::object();
    core::name_software(answer);
    answer["protocol"] = kProtocol;
    answer["arrays"] = Arguments::kArrayForms;
    answer["verbs"] = std::move(verbs);
    return answer;
  }

  static Json get(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    arguments.finish();
    Json answer = position_json(door.instrument_);
    answer["values"] = settings_json(door.instrument_.settings(), door.instrument_.setup());
    return answer;
  }

  static Json set(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    const Json* values = arguments.member("values");
    arguments.finish();
    if (values == nullptr) throw RefusedRequest("\"values\": give an object of settings, {\"material\": \"gold\"}");
    InstrumentSettings settings(door.instrument_.settings());
    value_of(change(*values, settings));
    value_of(door.instrument_.change(settings));
    return Json::object();
  }

  static Json approach(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    const double speed = speed_of(arguments);
    arguments.finish();
    door.instrument_.approach(speed);
    return position_json(door.instrument_);
  }

  static Json withdraw(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    const double distance_m = arguments.number_or("distance_m", 1e-6, 0.0, kMostPlaceM), speed = speed_of(arguments);
    arguments.finish();
    door.instrument_.withdraw(distance_m, speed);
    return position_json(door.instrument_);
  }

  static Json move(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    const SimulatedInstrument::Position& at = door.instrument_.position();
    const double x_m = arguments.number_or("x_m", at.x_m, -kMostPlaceM, kMostPlaceM),
                 y_m = arguments.number_or("y_m", at.y_m, -kMostPlaceM, kMostPlaceM), speed = speed_of(arguments);
    arguments.finish();
    door.instrument_.move_to(x_m, y_m, speed);
    return position_json(door.instrument_);
  }

  static Json set_z(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    const auto z_m = arguments.number("z_m", -kMostPlaceM, kMostPlaceM);
    const double speed = speed_of(arguments);
    arguments.finish();
    if (!z_m) throw RefusedRequest("\"z_m\": give the height of the lever's base above the sample's mean level, in m");
    value_of(door.instrument_.set_z(*z_m, speed));
    Json answer = position_json(door.instrument_);
    answer["force_N"] = door.instrument_.shown_force();
    return answer;
  }

  static Json wait(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    const auto time_s = arguments.number("time_s", 0.0, kMostWaitS);
    arguments.finish();
    if (!time_s) throw RefusedRequest("\"time_s\": give the simulated time to wait, in seconds");
    door.instrument_.wait(*time_s);
    return Json::object();
  }

  static Json curve(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    const SimulatedInstrument::CurveRequest request{
        .z_from_m = arguments.number("z_from_m", -kMostPlaceM, kMostPlaceM),
        .z_to_m = arguments.number("z_to_m", -kMostPlaceM, kMostPlaceM),
        .points = arguments.count_or("points", 500, 2, SimulatedInstrument::kMostCurvePoints),
        .speed_m_per_s = speed_of(arguments)};
    const AnswerArrays arrays(arguments);
    arguments.finish();
    SimulatedInstrument::Curve curve = value_of(door.instrument_.curve(request));
    const auto& samples = curve.run.curve.samples;
    const auto turn = std::find_if(samples.begin(), samples.end(), [](const physics::CurveSample& sample) {
      return sample.branch == physics::Branch::Retract;
    });
    Json answer{{"z_m", arrays.of(samples, [](const physics::CurveSample& sample) { return sample.z.si; })},
                {"force_N", arrays.of(curve.shown_n)},
                {"approach_points", turn - samples.begin()},
                {"spring_constant_N_per_m", curve.run.setup.material.contact.spring_constant.si}};
    door.results_->keep(std::move(curve.run), std::move(curve.shown_n));
    return answer;
  }

  // True if the next request has arrived completely and is "stop".
  static bool is_stopped(const JsonDoor& door) {
    constexpr std::size_t kLongestStop = 200;
    const std::string_view next = door.sent_meanwhile();
    const auto size = door.request_size(next);
    if (!size || *size > kLongestStop) return false;
    const Json request = Json::parse(next.substr(0, *size), nullptr, false);
    return request.is_object() && request.value("do", Json()) == "stop";
  }

  static Json tapping_curve(JsonDoor& door, Arguments& arguments, const Json& id, const Send& send) {
    const auto from = arguments.number("z_from_m", -kMostPlaceM, kMostPlaceM);
    const auto to = arguments.number("z_to_m", -kMostPlaceM, kMostPlaceM);
    const std::size_t points = arguments.count_or("points", 400, 2, SimulatedInstrument::kMostCurvePoints);
    const bool shows_progress = arguments.flag("progress");
    const AnswerArrays arrays(arguments);
    arguments.finish();
    const auto watch = [&](std::size_t done, std::size_t all) {
      if (shows_progress && !send(Json{{"id", id}, {"done", done}, {"of", all}}.dump() + "\n")) return false;
      return !is_stopped(door);
    };
    const curves::TappingRun run = value_of(door.instrument_.tapping_curve(from, to, points, watch));
    const auto& rows = run.curve.points;
    using physics::TapPoint;
    Json answer{{"z_m", arrays.of(rows, [](const TapPoint& row) { return row.z.si; })},
                {"amplitude_m", arrays.of(rows, [](const TapPoint& row) { return row.state.amplitude.si; })},
                {"phase_rad", arrays.of(rows, [](const TapPoint& row) { return row.state.phase; })},
                {"approach_points", std::count_if(rows.begin(), rows.end(), [](const TapPoint& row) {
                   return row.branch == physics::Branch::Approach;
                 })}};
    answer["figures"] = curves::tapping_json(run);
    return answer;
  }

  // Answers "stop"; a stopped scan or tapping curve has reported that in its own answer.
  static Json stop(JsonDoor&, Arguments& arguments, const Json&, const Send&) {
    arguments.finish();
    return Json::object();
  }

  static Json scan(JsonDoor& door, Arguments& arguments, const Json& id, const Send& send) {
    const AnswerArrays arrays(arguments);
    arguments.finish();
    bool stopped = false;
    physics::ScanImage image = value_of(door.instrument_.scan([&](const physics::ScanLine& line, double time_s) {
      const auto track = [&arrays, taps = door.instrument_.settings().taps](const physics::ScanTrack& pass) {
        if (taps) {
          return Json{{"height_m", arrays.of(pass.height_m)},
                      {"error_m", arrays.of(pass.error_n)},
                      {"phase_deg", arrays.of(pass.phase_deg)},
                      {"energy_J", arrays.of(pass.energy_j)},
                      {"peak_force_N", arrays.of(pass.peak_force_n)}};
        }
        return Json{{"height_m", arrays.of(pass.height_m)},
                    {"error_N", arrays.of(pass.error_n)},
                    {"lateral_N", arrays.of(pass.lateral_n)}};
      };
      const Json text{{"id", id},
                      {"line", line.row},
                      {"time_s", time_s},
                      {"trace", track(line.trace)},
                      {"retrace", track(line.retrace)}};
      stopped = is_stopped(door);
      return send(text.dump() + "\n") && !stopped;
    }));
    Json answer{{"columns", image.columns},       {"rows", image.rows},
                {"width_m", image.width_m},       {"height_m", image.height_m},
                {"x_offset_m", image.x_offset_m}, {"y_offset_m", image.y_offset_m}};
    if (stopped) answer["stopped"] = true;
    if (door.instrument_.settings().taps) answer["conventions"] = curves::tapping_conventions();
    image.metadata = image_metadata(door.instrument_.settings());
    door.results_->keep(std::move(image));
    return answer;
  }

  static Json thermal(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    const double resonance_hz = door.instrument_.setup().material.lever.resonance.si;
    const std::size_t points = arguments.count_or("points", 2000, 20, kMostSpectrumPoints),
                      averages = arguments.count_or("averages", 100, 1, kMostSpectrumWork / points);
    const double most_hz = arguments.number_or("most_Hz", 2.0 * resonance_hz, 1.0, 1e9);
    const AnswerArrays arrays(arguments);
    arguments.finish();
    const auto spectrum = door.instrument_.thermal(points, most_hz, averages);
    return {{"frequency_Hz", arrays.of(spectrum, [](const fits::SpectrumPoint& point) { return point.frequency_hz; })},
            {"density_m2_per_Hz", arrays.of(spectrum, [](const fits::SpectrumPoint& point) { return point.density; })},
            {"averages", averages}};
  }

  static Json truth(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    arguments.finish();
    const SimulatedInstrument::Truth truth = door.instrument_.truth();
    return {{"tip_radius_m", truth.tip_radius_m},
            {"tip_growth_m", truth.tip_growth_m},
            {"touching", truth.touching},
            {"second_apex", truth.second_apex},
            {"surface_m", truth.surface_m},
            {"sample_x_m", truth.sample_x_m},
            {"sample_y_m", truth.sample_y_m},
            {"highest_force_N", truth.highest_force_n},
            {"state_flips", truth.state_flips},
            {"contact", curves::parameters_json(door.instrument_.setup())},
            {"sources", curves::sources_json(curves::acting_sources(door.instrument_.setup()))}};
  }

  static Json save(JsonDoor& door, Arguments& arguments, const Json&, const Send&) {
    constexpr std::size_t kMostLetters = 100;
    const std::string name = arguments.text("file", kMostLetters).value_or("");
    arguments.finish();
    door.results_->save(name);
    return {{"file", name}};
  }

  static Json quit(JsonDoor&, Arguments& arguments, const Json&, const Send&) {
    arguments.finish();
    return Json::object();
  }

  static const Row* find(std::string_view name) {
    const auto found = std::find_if(kRows.begin(), kRows.end(), [name](const Row& row) { return row.name == name; });
    return found == kRows.end() ? nullptr : &*found;
  }
};

constexpr std::array<JsonDoor::Verbs::Row, 16> JsonDoor::Verbs::kRows{{
    {"hello", "names the program; \"seed\" starts anew", &Verbs::hello},
    {"get", "every setting and where the tip is", &Verbs::get},
    {"set", "changes settings, all or none: \"values\"", &Verbs::set},
    {"approach", "lowers the tip until the setpoint is reached: \"speed_m_per_s\"", &Verbs::approach},
    {"withdraw", "lifts the tip: \"distance_m\", \"speed_m_per_s\"", &Verbs::withdraw},
    {"move", "goes to another place: \"x_m\", \"y_m\", \"speed_m_per_s\"", &Verbs::move},
    {"set_z", "moves the lever's base without feedback: \"z_m\", \"speed_m_per_s\"", &Verbs::set_z},
    {"wait", "lets simulated time pass: \"time_s\"", &Verbs::wait},
    {"curve", "a force curve: \"z_from_m\", \"z_to_m\", \"points\", \"speed_m_per_s\"", &Verbs::curve},
    {"tapping_curve", "amplitude and phase over the height: \"z_from_m\", \"z_to_m\", \"points\", \"progress\"",
     &Verbs::tapping_curve},
    {"scan", "an image around the tip, line by line", &Verbs::scan},
    {"stop", "ends a scan after its line, or a tapping curve", &Verbs::stop},
    {"thermal", "spectrum of the free lever: \"points\", \"most_Hz\", \"averages\"", &Verbs::thermal},
    {"truth", "what no microscope shows", &Verbs::truth},
    {"save", "writes the newest image or curve: \"file\"", &Verbs::save},
    {"quit", "ends the server", &Verbs::quit},
}};

JsonDoor::JsonDoor(SimulatedInstrument& instrument, std::string folder)
    : instrument_(instrument), results_(std::make_unique<KeptResults>(std::move(folder))) {}
JsonDoor::~JsonDoor() = default;

std::optional<std::size_t> JsonDoor::request_size(std::string_view bytes) const {
  const std::size_t end = bytes.find('\n');
  return end == std::string_view::npos ? std::nullopt : std::optional(end + 1);
}

std::string_view JsonDoor::too_long() const {
  return "{\"id\":null,\"ok\":false,\"error\":\"a request has more than 1 MiB\"}\n";
}

Door::Then JsonDoor::answer(std::string_view request, const Send& send) {
  Json id = nullptr;
  Then then = Then::GoOn;
  const auto say = [&](const Json& answer) {
    send(answer.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  };
  const auto refuse = [&](const std::string& why) {
    say({{"id", id}, {"ok", false}, {"error", core::printable(why)}});
  };
  try {
    const Json parsed = parsed_request(request);
    id = id_of(parsed);
    Arguments arguments(parsed);
    const auto name = arguments.text("do", 32).value_or("");
    const Verbs::Row* verb = Verbs::find(name);
    if (verb == nullptr)
      throw RefusedRequest(fmt::format("there is no verb \"{}\"; \"hello\" lists them", core::printable(name)));
    static_cast<void>(arguments.packs_arrays());  // check that refuses an unknown form, whatever the verb
    if (verb->run == &Verbs::quit) then = Then::Quit;
    Json members = verb->run(*this, arguments, id, send);
    Json answer{{"id", id}, {"ok", true}, {"time_s", instrument_.position().time_s}};
    for (auto& [key, value] : members.items()) answer[key] = std::move(value);
    say(answer);
  } catch (const RefusedRequest& refusal) {
    then = Then::GoOn;
    refuse(refusal.what());
  } catch (const std::bad_alloc&) {
    refuse("there is not enough memory for this");
  } catch (const std::exception& error) {
    refuse(error.what());
  }
  return then;
}

}  // namespace afm::instrument

// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_wand.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"
#include "input/hid_source.h"

namespace afm::app {

namespace {

constexpr std::int64_t kSimulatedStepNs = 5'000'000'000;  // time on each swatch
constexpr double kSimulatedAimS = 1.0;
constexpr double kSimulatedPressS = 2.0;  // long enough to be seen in the slowest frame
constexpr double kLongestFrameS = 0.1;
constexpr double kTurnedRad = 0.02;  // rotation greater than the noise of a wand at rest on a table

core::Result<void> parse_place(std::string_view option, std::string_view text, input::DtrackSettings& tracker) {
  const std::size_t colon = text.rfind(':');
  const std::string_view port = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (port.empty() || error != std::errc() || end != port.data() + port.size() || number == 0) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("{}: \"{}\" is not ADDRESS:PORT, such as 127.0.0.1:5000", option, text));
  }
  tracker.address = std::string(text.substr(0, colon));
  tracker.port = number;
  return {};
}

core::Result<void> parse_source(const std::string& text, WandChoice& choice) {
  using Source = WandChoice::Source;
  constexpr std::string_view kDtrack = "dtrack:", kHid = "hid:";
  if (text == "auto") {
    choice.source = choice.file.dtrack ? Source::Dtrack : Source::Auto;
  } else if (text == "hid" || (text.rfind(kHid, 0) == 0 && text.size() > kHid.size())) {
    choice.source = Source::Hid;
    if (text != "hid") choice.hid_name = text.substr(kHid.size());
  } else if (text == "sim") {
    choice.source = Source::Simulated;
  } else if (text == "mouse") {
    choice.source = Source::Mouse;
  } else if (text == "dtrack" || text.rfind(kDtrack, 0) == 0) {
    choice.source = Source::Dtrack;
    if (!choice.file.dtrack) choice.file.dtrack.emplace();
    if (text != "dtrack") return parse_place("--wand", text.substr(kDtrack.size()), *choice.file.dtrack);
  } else {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format(
            "--wand: unknown source \"{}\"; choose auto, hid, hid:NAME, dtrack, dtrack:ADDRESS:PORT, sim or mouse",
            text));
  }
  return {};
}

core::Result<void> parse_head(const std::string& text, WandChoice& choice) {
  if (text.empty()) {
    choice.head_body = choice.file.head_body;
    return {};
  }
  constexpr std::string_view kScript = "sim:";
  if (text.rfind(kScript, 0) == 0 && text.size() > kScript.size()) {
    auto script = input::load_head_script(text.substr(kScript.size()));
    if (!script) return tl::unexpected(script.error());
    choice.head_script = std::move(*script);
    return {};
  }
  constexpr std::string_view kDtrack = "dtrack:";
  const std::size_t at = text.find('@');
  std::uint32_t body = 0;
  const std::string number = text.rfind(kDtrack, 0) == 0 ? text.substr(kDtrack.size(), at - kDtrack.size()) : "";
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), body);
  if (number.empty() || error != std::errc() || end != number.data() + number.size() || body > 63) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("--head: unknown source \"{}\"; give dtrack:BODY or dtrack:BODY@ADDRESS:PORT with "
                                     "a body from 0 to 63, such as dtrack:0@127.0.0.1:5000, or sim:FILE",
                                     text));
  }
  choice.head_body = body;
  if (!choice.file.dtrack) choice.file.dtrack.emplace();
  if (at == std::string::npos) return {};
  return parse_place("--head", std::string_view(text).substr(at + 1), *choice.file.dtrack);
}

// The contact point, which is the centre of rotation and scaling for caps and sticks.
glm::dvec3 contact_point(const exhibit::WallScene& wall_scene) {
  return glm::dvec3(wall_scene.node_transforms({})[wall_scene.sample_node()][3]);
}

}  // namespace

core::Result<WandChoice> parse_wand_choice(const WandOptions& options) {
  WandChoice choice;
  if (!options.file.empty()) {
    auto file = input::load_wand_file(options.file);
    if (!file) return tl::unexpected(file.error());
    choice.file = std::move(*file);
    choice.has_tracker_file = choice.file.dtrack.has_value();
  }
  if (auto parsed = parse_source(options.source, choice); !parsed) return tl::unexpected(parsed.error());
  if (auto parsed = parse_head(options.head, choice); !parsed) return tl::unexpected(parsed.error());
  return choice;
}

ViewWand::ViewWand(const exhibit::Stage& stage, const glm::dvec3& grip_m)
    : swatches_(stage.wall_scene.swatch_targets()), navigation_(contact_point(stage.wall_scene)) {
  wand_.position_m = grip_m;
}

core::Result<std::unique_ptr<ViewWand>> ViewWand::open(const WandChoice& choice, const exhibit::Stage& stage,
                                                       const std::string& assets_dir, const core::Clock& clock) {
  const glm::dvec3 hand = choice.file.hand_m.value_or(stage.wall_scene.places().wand_grip_m());
  std::unique_ptr<ViewWand> wand(new ViewWand(stage, hand));
  const input::HandPlace place{.position_m = hand, .forward = contact_point(stage.wall_scene) - hand};
  using Source = WandChoice::Source;
  if (choice.source == Source::Dtrack || choice.head_body) {
    if (auto opened = wand->open_dtrack(choice, clock); !opened) return tl::unexpected(opened.error());
  }
  if (choice.source == Source::Auto || choice.source == Source::Hid) {
    auto opened = wand->open_hid(choice, assets_dir, place, clock);
    const bool bad_file = !opened && opened.error().category == core::ErrorCategory::BadInputFile;
    if (!opened && (choice.source == Source::Hid || bad_file)) return tl::unexpected(opened.error());
    if (!opened) core::log_line(opened.error().message + "; using the mouse as the pointer");
  }
  if (choice.source == Source::Simulated) wand->simulated_.emplace(hand);
  return wand;
}

core::Result<void> ViewWand::open_hid(const WandChoice& choice, const std::string& assets_dir,
                                      const input::HandPlace& place, const core::Clock& clock) {
  auto mappings = input::load_mappings(assets_dir + "/wands");
  if (!mappings) return tl::unexpected(mappings.error());
  if (choice.file.device) mappings->insert(mappings->begin(), *choice.file.device);
  auto source = input::HidSource::open(std::move(*mappings), place, clock, choice.hid_name);
  if (!source) return tl::unexpected(source.error());
  wand_thread_ = std::make_unique<input::WandThread>(std::move(*source));
  return {};
}

core::Result<void> ViewWand::open_dtrack(const WandChoice& choice, const core::Clock& clock) {
  tracker_ = *choice.file.dtrack;
  head_body_ = choice.head_body;
  auto source = input::DtrackSource::open(tracker_, clock);
  if (!source) return tl::unexpected(source.error());
  dtrack_ = source->get();
  const std::string place = fmt::format("{}:{}", tracker_.address, tracker_.port);
  core::log_line("listening for a tracker at " + place);
  if (!choice.has_tracker_file) {
    core::log_line(
        "tracker: assuming that z points up and y towards the wall, from the room's origin; to change this, set "
        "room_from_tracker in a wand file");
  }
  tracker_report_.emplace(place, clock.now_ns(), head_body_);
  auto& thread = choice.source == WandChoice::Source::Dtrack ? wand_thread_ : head_thread_;
  thread = std::make_unique<input::WandThread>(std::move(*source));
  return {};
}

void ViewWand::aim_simulated(std::int64_t now_ns) {
  if (now_ns >= simulated_next_ns_) {
    if (simulated_next_ns_ != 0) simulated_target_ = (simulated_target_ + 1) % swatches_.size();
    simulated_->aim_at(swatches_[simulated_target_].center_m, kSimulatedAimS, now_ns);
    simulated_->press(kSimulatedPressS, now_ns + static_cast<std::int64_t>(1.5e9 * kSimulatedAimS));
    simulated_next_ns_ = now_ns + kSimulatedStepNs;
  }
  wand_ = simulated_->state(now_ns);
}

void ViewWand::update(std::int64_t now_ns, const scene::TipState& tip, const glm::dvec3& eye_m) {
  const double frame_s =
      updated_ns_ == 0 ? 0.0 : std::clamp(static_cast<double>(now_ns - updated_ns_) * 1e-9, 0.0, kLongestFrameS);
  updated_ns_ = now_ns;
  const bool pressed_before = wand_.pressed(input::WandButton::Select);
  const std::uint32_t stops_before = wand_.stops;
  if (wand_thread_) wand_ = wand_thread_->newest();
  if (controller_) {
    wand_ = *controller_;
  } else if (!wand_thread_ && !simulated_) {
    wand_.connected = false;
  }
  if (tracker_report_) {
    if (const auto line = tracker_report_->follow(dtrack_->newest(), now_ns)) core::log_line(*line);
  }
  stop_pressed_ = wand_.stops > stops_before;
  if (simulated_) aim_simulated(now_ns);
  select_pressed_ = points() && wand_.pressed(input::WandButton::Select) && !pressed_before;
  pointing_ = selector_.update(wand_, eye_m, swatches_);

  const glm::dvec3 direction = input::ray_of(wand_).direction;
  if (points() && (wand_.buttons != 0 || glm::distance(direction, used_direction_) > kTurnedRad)) {
    used_ns_ = now_ns;
    used_direction_ = direction;
  }

  const bool locked = input::navigation_locked(tip);
  navigation_.update(wand_, frame_s, locked);
  const bool moved = navigation_.room_from_scene() != glm::dmat4(1.0);
  if (moved != was_moved_) core::log_line(moved ? "wand: the scene was moved" : "wand: the scene is back in its place");
  was_moved_ = moved;
  const bool moves = wand_.pressed(input::WandButton::Grab) || wand_.pressed(input::WandButton::Scale);
  const bool refused = locked && moves;
  if (refused && !was_locked_) core::log_line("wand: the scene is locked while the tip is in contact");
  was_locked_ = refused;
}

void ViewWand::log_losses() const {
  if (tracker_report_) core::log_line(tracker_report_->total());
}

std::optional<ViewWand::Head> ViewWand::head() const {
  if (dtrack_ == nullptr || !head_body_) return std::nullopt;
  const input::DtrackUpdate update = dtrack_->newest();
  const input::DtrackBody* const body = update.frame.body(*head_body_);
  if (body == nullptr || !body->tracked) return std::nullopt;
  const input::DtrackBody in_room = input::in_room(*body, tracker_);
  return Head{.pose = {.position_m = in_room.position_m, .room_from_head = in_room.tracker_from_body},
              .time_ns = update.time_ns};
}

}  // namespace afm::app

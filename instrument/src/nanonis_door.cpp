// SPDX-License-Identifier: Apache-2.0
#include "instrument/nanonis_door.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <numbers>
#include <utility>

#include "core/printable.h"
#include "instrument/simulated_instrument.h"
#include "nanonis_bytes.h"
#include "nanonis_others.h"
#include "nanonis_properties.h"
#include "nanonis_signals.h"
#include "physics/imaging/scan_image.h"
#include "refused_request.h"

namespace afm::instrument {
namespace {

constexpr std::size_t kNameBytes = 32, kHeaderBytes = 40;
constexpr double kRadPerDegree = std::numbers::pi / 180.0;
constexpr double kWithdrawnM = 1e-6;
constexpr double kMotorStepM = 100e-9;  // step of the coarse motor along z

}  // namespace

// Functions of the protocol: each reads its arguments, acts, and writes its results before the error.
struct NanonisDoor::Functions {
  using Run = void (*)(NanonisDoor& door, NanonisReader& in, NanonisWriter& out);
  struct Row {
    std::string_view name;
    std::size_t blank;  // zeros in place of the results of a failed call, because clients look for the error after them
    Run run;
  };
  static const std::array<Row, 38> kRows;

  template <class Edit>
  static void change(NanonisDoor& door, const Edit& edit) {
    InstrumentSettings settings(door.instrument_.settings());
    edit(settings);
    value_of(door.instrument_.change(settings));
  }

  static float signal(NanonisDoor& door, std::int32_t index) {
    const SimulatedInstrument::Position& at = door.instrument_.position();
    switch (index) {
      case 1:
        return static_cast<float>(door.instrument_.shown_force());
      case 24:
        return door.bias_v_;
      case 27:
        return static_cast<float>(at.x_m);
      case 28:
        return static_cast<float>(at.y_m);
      case 30:
        return static_cast<float>(at.z_m);
      default:
        return 0.0F;
    }
  }

  static void names_get(NanonisDoor&, NanonisReader&, NanonisWriter& out) {
    NanonisWriter names;
    for (std::int32_t i = 0; i < kSignals; ++i) names.add_text(name_of_signal(i));
    out.add_count(names.bytes().size()).add(kSignals);
    for (std::int32_t i = 0; i < kSignals; ++i) out.add_text(name_of_signal(i));
  }
  static void val_get(NanonisDoor& door, NanonisReader& in, NanonisWriter& out) {
    const std::int32_t index = index_of(in);
    in.read<std::uint32_t>();  // flag of waiting for the newest value, which is this one
    out.add(signal(door, index));
  }
  static void vals_get(NanonisDoor& door, NanonisReader& in, NanonisWriter& out) {
    const std::vector<std::int32_t> indexes = indexes_of(in);
    in.read<std::uint32_t>();
    out.add_count(indexes.size());
    for (const std::int32_t index : indexes) out.add(signal(door, index));
  }
  static void in_slots_get(NanonisDoor&, NanonisReader&, NanonisWriter& out) {
    NanonisWriter names;
    for (const Signal& row : kNamed) names.add_text(row.name);
    out.add_count(names.bytes().size()).add_count(kNamed.size());
    for (const Signal& row : kNamed) out.add_text(row.name);
    out.add_count(kNamed.size());
    for (const Signal& row : kNamed) out.add(row.index);
  }

  static void bias_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    door.bias_v_ = static_cast<float>(within("bias", in.real(), -10.0, 10.0));
  }
  static void bias_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) { out.add(door.bias_v_); }
  // Writes a status that is always zero, and a current, which the instrument does not have.
  template <class T>
  static void zero(NanonisDoor&, NanonisReader&, NanonisWriter& out) {
    out.add(T{0});
  }

  static void z_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    out.add(static_cast<float>(door.instrument_.position().z_m));
  }
  static void z_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    const double z_m = within("z", in.real(), -kMostPlaceM, kMostPlaceM);
    if (door.feedback_) throw RefusedRequest("the Z controller is on; switch it off first");
    value_of(door.instrument_.set_z(z_m, kApproachSpeedM));
  }
  static void on_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    out.add(std::uint32_t{door.feedback_ ? 1U : 0U});
  }
  static void on_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    switch_feedback(door, in.read<std::uint32_t>() != 0);
  }
  static void switch_feedback(NanonisDoor& door, bool on) {
    change(door, [on](InstrumentSettings& settings) {
      settings.scan.feedback = on ? physics::Feedback::On : physics::Feedback::Off;
    });
    if (on && !door.instrument_.position().engaged) door.instrument_.approach(kApproachSpeedM);
    door.feedback_ = on;
  }
  static void setpoint_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    out.add(static_cast<float>(door.instrument_.settings().scan.setpoint.si));
  }
  static void setpoint_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    const double force_n = in.real();
    change(door, [force_n](InstrumentSettings& settings) { settings.scan.setpoint = physics::Force(force_n); });
  }
  // Three numbers for two: I = P/T, in 1/s. Without a proportional gain T is zero.
  static void gain_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    const physics::ScanSettings& scan = door.instrument_.settings().scan;
    const double integral = scan.integral_gain.si, proportional = scan.proportional_gain;
    const double constant_s = proportional == 0 ? 0.0 : proportional / integral;
    out.add(static_cast<float>(proportional)).add(static_cast<float>(constant_s)).add(static_cast<float>(integral));
  }
  static void gain_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    const double proportional = in.real();
    in.real();
    const double integral = in.real();
    change(door, [&](InstrumentSettings& settings) {
      settings.scan.proportional_gain = proportional;
      settings.scan.integral_gain = physics::Frequency(integral);
    });
  }
  static void withdraw(NanonisDoor& door, NanonisReader& in, NanonisWriter& out) {
    in.read<std::uint32_t>();
    in.read<std::int32_t>();
    home(door, in, out);
  }
  static void home(NanonisDoor& door, NanonisReader&, NanonisWriter&) {
    door.instrument_.withdraw(kWithdrawnM, kApproachSpeedM);
    door.feedback_ = false;
  }
  static void status_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    constexpr std::uint16_t kOff = 1, kOn = 2;
    out.add(door.feedback_ ? kOn : kOff);
  }

  static double move_speed(const NanonisDoor& door) {
    const double scan_speed = 2.0 * door.instrument_.frame().width_m * door.instrument_.settings().scan.line_rate.si;
    return door.custom_speed_ != 0 ? door.follow_speed_m_per_s_ : scan_speed;
  }
  static void scan_action(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    constexpr std::uint16_t kStart = 0, kGoToCentre = 6;  // actions; from 4 on since the protocol of June 2024
    const auto action = in.read<std::uint16_t>();
    const bool upwards = in.read<std::uint32_t>() != 0;
    if (action > kGoToCentre) throw RefusedRequest(fmt::format("there is no scan action {}", action));
    if (action == kGoToCentre || (action == kStart && door.instrument_.position().engaged)) {
      door.instrument_.move_to(door.frame_x_m_, door.frame_y_m_, move_speed(door));
    }
    if (action != kStart) return;  // no effect on a completed scan
    change(door, [upwards](InstrumentSettings& settings) { settings.upwards = upwards; });
    door.upwards_ = upwards;
    door.image_ = std::make_unique<const physics::ScanImage>(
        value_of(door.instrument_.scan([](const physics::ScanLine&, double) { return true; })));
  }
  static void scan_wait(NanonisDoor&, NanonisReader& in, NanonisWriter& out) {
    in.read<std::int32_t>();
    out.add(std::uint32_t{0}).add_text("");  // no time-out, no file
  }
  static void frame_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    const auto [width_m, height_m] = door.instrument_.frame();
    out.add(static_cast<float>(door.frame_x_m_)).add(static_cast<float>(door.frame_y_m_));
    out.add(static_cast<float>(width_m)).add(static_cast<float>(height_m));
    out.add(static_cast<float>(0.0 - door.instrument_.settings().turn_rad / kRadPerDegree));  // clockwise angle
  }
  static void frame_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    const double x_m = within("x", in.real(), -kMostPlaceM, kMostPlaceM),
                 y_m = within("y", in.real(), -kMostPlaceM, kMostPlaceM),
                 width_m = within("width", in.real(), 1e-10, 1e-4), height_m = within("height", in.real(), 1e-10, 1e-4),
                 angle = within("angle", in.real(), -360.0, 360.0);
    const double wider = door.keeps_speed_ ? width_m / door.instrument_.frame().width_m : 1.0;
    change(door, [&](InstrumentSettings& settings) {
      settings.size_m = width_m;
      settings.height_m = height_m;
      settings.turn_rad = std::remainder(0.0 - angle, 360.0) * kRadPerDegree;  // clockwise angle of the protocol
      settings.scan.line_rate = physics::Frequency(settings.scan.line_rate.si / wider);
    });
    door.frame_x_m_ = x_m;
    door.frame_y_m_ = y_m;
  }
  static void buffer_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    out.add_count(door.channels_.size());
    for (const std::int32_t channel : door.channels_) out.add(channel);
    const InstrumentSettings& settings = door.instrument_.settings();
    out.add_count(settings.pixels).add_count(settings.lines_or_pixels());
  }
  static void buffer_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    std::vector<std::int32_t> channels = indexes_of(in);
    const auto pixels = in.read<std::int32_t>(), lines = in.read<std::int32_t>();
    constexpr double kMost = static_cast<double>(kMostInstrumentPixels);
    within("pixels", pixels, 2.0, kMost);
    within("lines", lines, 1.0, kMost);
    change(door, [&](InstrumentSettings& settings) {
      settings.pixels = static_cast<std::size_t>(pixels);
      settings.lines = static_cast<std::size_t>(lines);
    });
    door.channels_ = std::move(channels);
  }
  static void props_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    const NanonisProperties& properties = door.properties_;
    out.add(properties.continuous).add(properties.bouncing).add(properties.autosave);
    out.add_text(properties.series).add_text(properties.comment);
  }
  static void props_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    door.properties_ = changed(door.properties_, in);
  }
  static void speed_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    const auto [width_m, height_m] = door.instrument_.frame();
    const double forward_s = 0.5 / door.instrument_.settings().scan.line_rate.si;
    const auto ratio = static_cast<double>(door.speed_ratio_);
    out.add(static_cast<float>(width_m / forward_s)).add(static_cast<float>(ratio * width_m / forward_s));
    out.add(static_cast<float>(forward_s)).add(static_cast<float>(forward_s / ratio));
    constexpr std::uint16_t kConstantSpeed = 0, kConstantTime = 1;
    out.add(door.keeps_speed_ ? kConstantSpeed : kConstantTime).add(door.speed_ratio_);
  }
  static void speed_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    const double speed = in.real();
    in.real();
    double forward_s = in.real();
    in.real();
    constexpr std::uint16_t kNoChange = 0, kKeepSpeed = 1;
    const auto kept = in.read<std::uint16_t>();
    const bool keeps_speed = kept == kNoChange ? door.keeps_speed_ : kept == kKeepSpeed;
    if (keeps_speed) forward_s = door.instrument_.frame().width_m / speed;
    const double ratio = within("ratio of the speeds", in.real(), 1e-3, 1e3);
    within("forward line time", forward_s, 1e-5, 1e5);
    change(door, [forward_s](InstrumentSettings& settings) {
      settings.scan.line_rate = physics::Frequency(0.5 / forward_s);
    });
    door.speed_ratio_ = static_cast<float>(ratio);
    door.keeps_speed_ = keeps_speed;
  }
  static void frame_data(NanonisDoor& door, NanonisReader& in, NanonisWriter& out) {
    const auto index = in.read<std::int32_t>();
    const bool forward = in.read<std::uint32_t>() != 0;
    if (!door.image_) throw RefusedRequest("there is no image yet; start a scan first");
    const Signal* signal = find_signal(index);
    const std::string wanted = (signal != nullptr ? std::string(signal->channel) : "") + (forward ? "" : " (retrace)");
    const auto& channels = door.image_->channels;
    const auto found = std::find_if(channels.begin(), channels.end(),
                                    [&](const physics::ImageChannel& channel) { return channel.name == wanted; });
    if (found == channels.end()) {
      throw RefusedRequest(fmt::format("signal {} is not recorded; choose 30 (height), 1 or 2", index));
    }
    out.add_text(name_of_signal(index)).add_count(door.image_->rows).add_count(door.image_->columns);
    for (const double value : found->values) out.add(static_cast<float>(value));
    out.add(std::uint32_t{door.upwards_ ? 1U : 0U});
  }

  static void xy_get(NanonisDoor& door, NanonisReader& in, NanonisWriter& out) {
    in.read<std::uint32_t>();
    out.add(door.instrument_.position().x_m).add(door.instrument_.position().y_m);
  }
  static void xy_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    const double x_m = within("x", in.read<double>(), -kMostPlaceM, kMostPlaceM),
                 y_m = within("y", in.read<double>(), -kMostPlaceM, kMostPlaceM);
    in.read<std::uint32_t>();
    door.instrument_.move_to(x_m, y_m, move_speed(door));
  }
  static void follow_speed_get(NanonisDoor& door, NanonisReader&, NanonisWriter& out) {
    out.add(static_cast<float>(move_speed(door))).add(door.custom_speed_);
  }
  static void follow_speed_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    const double speed = within("speed", in.real(), 1e-12, 1.0);
    const auto custom = in.read<std::uint32_t>();
    door.follow_speed_m_per_s_ = speed;
    door.custom_speed_ = custom;
  }

  static void approach_open(NanonisDoor&, NanonisReader&, NanonisWriter&) {}
  static void approach_set(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    if (in.read<std::uint16_t>() != 0) switch_feedback(door, true);
  }
  static void motor_move(NanonisDoor& door, NanonisReader& in, NanonisWriter&) {
    constexpr std::uint32_t kUp = 4, kLast = 5;
    const auto direction = in.read<std::uint32_t>();
    const auto steps = in.read<std::uint16_t>();
    in.read<std::uint32_t>();
    in.read<std::uint32_t>();
    if (direction > kLast) throw RefusedRequest(fmt::format("there is no direction {}", direction));
    if (direction != kUp) throw RefusedRequest("the motor of this microscope only lifts the tip: Z+");
    door.instrument_.withdraw(kMotorStepM * steps, kApproachSpeedM);
    door.feedback_ = false;
  }
};

constexpr std::array<NanonisDoor::Functions::Row, 38> NanonisDoor::Functions::kRows{{
    {"Signals.NamesGet", 8, &Functions::names_get},
    {"Signals.ValGet", 4, &Functions::val_get},
    {"Signals.ValsGet", 4, &Functions::vals_get},
    {"Signals.InSlotsGet", 12, &Functions::in_slots_get},
    {"Bias.Set", 0, &Functions::bias_set},
    {"Bias.Get", 4, &Functions::bias_get},
    {"Current.Get", 4, &Functions::zero<float>},
    {"ZCtrl.ZPosGet", 4, &Functions::z_get},
    {"ZCtrl.ZPosSet", 0, &Functions::z_set},
    {"ZCtrl.OnOffGet", 4, &Functions::on_get},
    {"ZCtrl.OnOffSet", 0, &Functions::on_set},
    {"ZCtrl.SetpntGet", 4, &Functions::setpoint_get},
    {"ZCtrl.SetpntSet", 0, &Functions::setpoint_set},
    {"ZCtrl.GainGet", 12, &Functions::gain_get},
    {"ZCtrl.GainSet", 0, &Functions::gain_set},
    {"ZCtrl.Withdraw", 0, &Functions::withdraw},
    {"ZCtrl.Home", 0, &Functions::home},
    {"ZCtrl.StatusGet", 2, &Functions::status_get},
    {"Scan.Action", 0, &Functions::scan_action},
    {"Scan.StatusGet", 4, &Functions::zero<std::uint32_t>},
    {"Scan.WaitEndOfScan", 8, &Functions::scan_wait},
    {"Scan.FrameGet", 20, &Functions::frame_get},
    {"Scan.FrameSet", 0, &Functions::frame_set},
    {"Scan.BufferGet", 12, &Functions::buffer_get},
    {"Scan.BufferSet", 0, &Functions::buffer_set},
    {"Scan.PropsGet", 20, &Functions::props_get},
    {"Scan.PropsSet", 0, &Functions::props_set},
    {"Scan.SpeedGet", 22, &Functions::speed_get},
    {"Scan.SpeedSet", 0, &Functions::speed_set},
    {"Scan.FrameDataGrab", 16, &Functions::frame_data},
    {"FolMe.XYPosGet", 16, &Functions::xy_get},
    {"FolMe.XYPosSet", 0, &Functions::xy_set},
    {"FolMe.SpeedGet", 8, &Functions::follow_speed_get},
    {"FolMe.SpeedSet", 0, &Functions::follow_speed_set},
    {"AutoApproach.Open", 0, &Functions::approach_open},
    {"AutoApproach.OnOffGet", 2, &Functions::zero<std::uint16_t>},
    {"AutoApproach.OnOffSet", 0, &Functions::approach_set},
    {"Motor.StartMove", 0, &Functions::motor_move},
}};
NanonisDoor::NanonisDoor(SimulatedInstrument& instrument) : instrument_(instrument) {}
NanonisDoor::~NanonisDoor() = default;

// True for input of a client with another protocol.
bool NanonisDoor::announces_too_much(std::string_view bytes) const {
  return bytes.size() >= kHeaderBytes &&
         kHeaderBytes + NanonisReader(bytes.substr(kNameBytes)).read<std::uint32_t>() > most_request_bytes();
}

std::optional<std::size_t> NanonisDoor::request_size(std::string_view bytes) const {
  if (bytes.size() < kHeaderBytes) return std::nullopt;
  const auto body = NanonisReader(bytes.substr(kNameBytes)).read<std::uint32_t>();
  const std::size_t whole = kHeaderBytes + body;
  return whole <= bytes.size() ? std::optional(whole) : std::nullopt;
}

Door::Then NanonisDoor::answer(std::string_view request, const Send& send) {
  const std::string_view name = request.substr(0, std::min(kNameBytes, request.find('\0')));
  const bool wanted = NanonisReader(request.substr(kNameBytes + 4)).read<std::uint16_t>() != 0;
  NanonisWriter written;
  std::string results, error;
  const auto row = std::find_if(Functions::kRows.begin(), Functions::kRows.end(),
                                [name](const Functions::Row& each) { return each.name == name; });
  if (row == Functions::kRows.end()) {
    results.assign(result_size_of_other(name), '\0');
    error = fmt::format("TouchAFM does not have the function {}", core::printable(name));
  } else {
    try {
      NanonisReader in(request.substr(kHeaderBytes));
      row->run(*this, in, written);
      results = written.bytes();
    } catch (const std::exception& failure) {
      results.assign(row->blank, '\0');
      error = failure.what();
    }
  }
  if (!wanted) return Then::GoOn;
  NanonisWriter ending, header;
  ending.add(std::uint32_t{error.empty() ? 0U : 1U}).add_text(error);
  header.add_count(results.size() + ending.bytes().size()).add(std::uint32_t{0});
  std::string bytes(request.substr(0, kNameBytes));
  bytes += header.bytes();
  bytes += results;
  bytes += ending.bytes();
  send(bytes);
  return Then::GoOn;
}

}  // namespace afm::instrument

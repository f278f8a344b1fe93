// SPDX-License-Identifier: Apache-2.0
#include "forcedimension/dhd_setup.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "core/printable.h"
#include "drivers/command_fade.h"

namespace afm::haptics::dhd {

namespace {

// Largest force and radius of the sphere around the origin that every device of the model reaches: CHAI3D's table
// (CDeltaDevices.cpp, 3.3). Type numbers: SDK 3.17. Types that SDK 3 no longer lists, and what it calls a custom
// device, have no row.
struct Model {
  int type;
  std::string_view name;
  double max_force_n;
  double radius_m;
};
constexpr Model kModels[] = {
    {63, "delta.3", 20.0, 0.150},    {33, "omega.3", 12.0, 0.075},      {34, "omega.6", 12.0, 0.075},
    {36, "omega.6", 12.0, 0.075},    {35, "omega.7", 12.0, 0.075},      {37, "omega.7", 12.0, 0.075},
    {104, "sigma.7", 12.0, 0.075},   {105, "sigma.7", 12.0, 0.075},     {108, "lambda.7", 12.0, 0.1125},
    {109, "lambda.7", 12.0, 0.1125}, {60, "Novint Falcon", 8.0, 0.040},
};
constexpr Model kUnknownModel{0, "unknown Force Dimension device", 8.0, 0.040};  // weakest values of all rows

// Assumed: the rating of the weakest pen that TouchAFM drives, so that a lasting force is derated early.
constexpr double kContinuousForceN = 0.88;

// Largest stiffness behind a mailbox at 1 kHz (docs/decisions/0005), not that of a device's own loop at 4 kHz.
constexpr double kStiffnessNPerM = 400.0;

// Share of the workspace below the sample's surface; a stroke of 50 mm and the recoil need the rest.
constexpr double kContactShare = 1.0 / 3.0;

constexpr unsigned short kNoSerialNumber = 0xFFFF;  // serial number of every Falcon (sawForceDimensionSDK)

struct Wanted {
  std::optional<int> index;
  std::optional<unsigned short> serial_number;
};

core::Result<Wanted> parse(const std::string& wanted) {
  if (wanted.empty()) return Wanted{};
  const bool is_index = wanted.front() == '#';
  const char* begin = wanted.data() + (is_index ? 1 : 0);
  const char* end = wanted.data() + wanted.size();
  unsigned short number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || stop != end || (is_index && number > 99)) {
    return core::wrong_usage(fmt::format(
        "\"{}\" names no force dimension device: give a serial number, or #0 for the first device", wanted));
  }
  return is_index ? Wanted{.index = number, .serial_number = {}} : Wanted{.index = {}, .serial_number = number};
}

std::optional<unsigned short> serial_number(const DhdFunctions& functions, DhdId device) {
  unsigned short number = 0;
  if (functions.get_serial_number(&number, device) < 0 || number == kNoSerialNumber) return std::nullopt;
  return number;
}

}  // namespace

std::string error_text(const DhdFunctions& functions, int error) {
  const char* words = functions.get_error_string(error);
  return fmt::format("{} (error {})", words == nullptr ? "unnamed error" : core::printable_line(words), error);
}

core::Result<DhdId> take_device(const DhdFunctions& functions, const std::string& wanted) {
  const auto parsed = parse(wanted);
  if (!parsed) return tl::unexpected(parsed.error());
  const int count = functions.count_devices();
  if (count <= 0) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         count < 0 ? fmt::format("the library cannot look for devices: {}",
                                                 error_text(functions, functions.get_last_error()))
                                   : "no device is connected, or permission is denied; switch it on, or install "
                                     "70-touchafm-haptics.rules (in assets/haptics; in a bundle: "
                                     "lib/udev/rules.d) and plug it in again");
  }

  std::string refusals;
  const auto refuse = [&](int index, const std::string& why) {
    refusals += fmt::format("{}#{}: {}", refusals.empty() ? "" : ", ", index, why);
  };
  const int first = parsed->index.value_or(0);
  const int end = parsed->index ? std::min(first + 1, count) : count;
  if (first >= count) refuse(first, fmt::format("only {} connected", count));
  for (int index = first; index < end; ++index) {
    const int opened = functions.open_index(static_cast<char>(index));
    if (opened < 0) {
      refuse(index, error_text(functions, functions.get_last_error()));
      continue;
    }
    const DhdId device = static_cast<DhdId>(opened);
    if (!parsed->serial_number) return device;
    const auto number = serial_number(functions, device);
    if (number == parsed->serial_number) return device;
    functions.close(device);
    refuse(index, number ? fmt::format("serial {}", *number) : "it has no serial number");
  }
  return core::failure(core::ErrorCategory::DeviceMissing,
                       fmt::format("no force dimension device can be opened ({}); check cable and power, close other "
                                   "programs, and check that the manufacturer's test program finds it",
                                   refusals));
}

DeviceSpec model_spec(int type, const std::string& name) {
  const auto found =
      std::find_if(std::begin(kModels), std::end(kModels), [&](const Model& m) { return m.type == type; });
  const Model& model = found == std::end(kModels) ? kUnknownModel : *found;
  const double r = model.radius_m;
  std::string called = name.empty() ? std::string(model.name) : name;
  if (found == std::end(kModels)) called += fmt::format(" (type {} is unknown, with the limits of a Falcon)", type);
  return {.name = std::move(called),
          .max_force_n = model.max_force_n,
          .max_continuous_force_n = kContinuousForceN,
          .max_stiffness_n_per_m = kStiffnessNPerM,
          .force_lasts_s = core::seconds(CommandFade::kStaleNs),
          .max_vibration_n = found == std::end(kModels) ? 0.0 : kMostVibrationN,
          .measures = true,
          .workspace_min_m = glm::dvec3(-r),
          .workspace_max_m = glm::dvec3(r),
          .contact_point_m = {0.0, -r + kContactShare * 2.0 * r, 0.0}};
}

core::Result<DeviceSpec> query_spec(const DhdFunctions& functions, DhdId device) {
  const int type = functions.get_type(device);
  if (type < 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("the force dimension device does not report its type: {}",
                                     error_text(functions, functions.get_last_error())));
  }
  const char* name = functions.get_name(device);
  DeviceSpec spec = model_spec(type, name == nullptr ? std::string() : core::printable_line(name));
  if (const auto number = serial_number(functions, device)) spec.name += fmt::format(", serial {}", *number);
  return spec;
}

}  // namespace afm::haptics::dhd

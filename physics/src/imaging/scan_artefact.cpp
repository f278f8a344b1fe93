// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/scan_artefact.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace afm::physics {
namespace {

constexpr double kShareOffForLost = 0.95;    // of the line
constexpr double kShareOfLimit = 0.6;        // of the gain at which the loop swings: it rings behind each step
constexpr double kShareOnSecondApex = 0.02;  // of the line
constexpr double kShareDrifted = 0.03;       // of the area, while a frame is taken
constexpr double kShareOfNoise = 0.25;       // of the relief's rms
constexpr double kShareOfError = 0.3;        // of the relief's rms: an image flatter by 5 %, late by 17 degrees

double rms_about_mean(const std::vector<double>& values) {
  double mean = 0.0, square = 0.0;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) mean += value / count;
  for (const double value : values) square += (value - mean) * (value - mean) / count;
  return std::sqrt(square);
}

bool drifts(const ScanArea& area, const ScanSettings& settings) {
  const double frame_s = static_cast<double>(area.rows) / settings.line_rate.si;
  return std::abs(settings.drift_x.si) * frame_s > kShareDrifted * area.width.si ||
         std::abs(settings.drift_y.si) * frame_s > kShareDrifted * area.height.si;
}

bool rings(const Scanner& scanner) {
  const ScanSettings& settings = scanner.settings();
  return settings.feedback == Feedback::On &&
         settings.integral_gain.si > kShareOfLimit * scanner.loop().largest_integral_gain().si;
}

}  // namespace

std::string_view name_of(ScanArtefact artefact) {
  for (const ScanArtefactName& row : kScanArtefacts) {
    if (row.artefact == artefact) return row.name;
  }
  throw std::logic_error("no such artefact");
}

ScanArtefact main_artefact(const Scanner& scanner, const ScanLine& line) {
  const ScanSettings& settings = scanner.settings();
  const double off = std::max(line.trace.off_surface, line.retrace.off_surface);
  if (off > kShareOffForLost) return ScanArtefact::LostContact;
  if (rings(scanner)) return ScanArtefact::Ringing;
  if (off * static_cast<double>(scanner.area().columns) > 1.0) return ScanArtefact::Parachuting;
  const double highest_n = std::max(line.trace.highest_force_n, line.retrace.highest_force_n);
  if (highest_n - settings.setpoint.si > std::abs(settings.setpoint.si)) return ScanArtefact::Overload;
  if (std::max(line.trace.on_second_apex, line.retrace.on_second_apex) > kShareOnSecondApex) {
    return ScanArtefact::DoubleTip;
  }
  if (drifts(scanner.area(), settings)) return ScanArtefact::Drift;
  const double relief_m = rms_about_mean(line.trace.height_m);
  if (noise_of_height(settings).si > kShareOfNoise * relief_m) return ScanArtefact::Noise;
  const double error_m = rms_about_mean(line.trace.error_n) / settings.spring_constant.si;
  const bool follows = settings.feedback == Feedback::On;
  return follows && error_m > kShareOfError * relief_m ? ScanArtefact::Blur : ScanArtefact::None;
}

}  // namespace afm::physics

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "exhibit/report/measurement.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/shared/shared_blocks.h"
#include "servo/session_file.h"

namespace afm::exhibit {

// One cycle on a sample whose parameters were changed while the servo ran.
struct Variation {
  std::size_t material = 0;  // index of the original material
  curves::SampleModel model;
  servo::RecordedSession session;
  Measurement measurement;
};

// Results of a run of the demo.
struct DemoResult {
  std::vector<servo::RecordedSession> sessions;  // one per material, in the order of the materials file
  std::vector<Measurement> measurements;
  std::vector<Variation> variations;
  scene::ServoTiming servo;
  std::uint64_t lost_samples = 0;
  std::vector<double> frame_ms;
  double seconds = 0;
  std::string vulkan_device;
  std::string haptic_device;
  std::uint32_t eye_width = 0, eye_height = 0;
  double hand_speed_m_per_s = 0;
};

// Contents of summary.json: SI units, magnitudes, relative errors.
nlohmann::json summary_json(const DemoResult& result);

struct ReportPicture {
  std::string caption;
  std::string png;  // contents of a PNG file
};

// Returns one self-contained HTML file with all pictures and plots.
std::string report_html(const DemoResult& result, const std::vector<ReportPicture>& pictures,
                        const std::string& curves_svg, const Phrases& phrases);

// Every sample of a session as CSV, with all parameters and events in a # header.
std::string session_csv(const servo::RecordedSession& session);

}  // namespace afm::exhibit

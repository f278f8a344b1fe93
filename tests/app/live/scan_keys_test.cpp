// SPDX-License-Identifier: Apache-2.0
// Invariant: each artefact of a scan can be produced and undone with the keys that the manual names
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/live/view_keys.h"
#include "app/view/view_panels.h"
#include "core/whole_file.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/scan/scan_cause.h"
#include "exhibit/scan/scan_subject.h"
#include "physics/imaging/scan_artefact.h"
#include "support/places.h"

// A visitor makes each artefact in the image with Tab, + and - as the manual says, and undoes it: what the image itself
// shows is measured, beside the cause that the wall names.
namespace afm::app {
namespace scan_keys_test {

using exhibit::LiveScan;
using physics::ScanArtefact;

constexpr std::size_t kGold = 1, kPixels = LiveScan::kPixels;
constexpr double kFrameS = 1.0 / 60.0;
constexpr std::size_t kLines = 8;  // number of newest whole lines to check

// ---- what the manual says ----

struct Press {
  std::string row;  // beginning of the row's name
  int times = 0;    // number of presses of +, or of - if negative
};

struct ManualRow {
  std::string artefact;  // name such as "double tip"
  std::vector<Press> presses;
};

// "Setpoint - four times", "Gain -, -, -".
Press press_of(const std::string& text) {
  static const std::map<std::string, int> kNumbers{{"two", 2},  {"three", 3}, {"four", 4},
                                                   {"five", 5}, {"six", 6},   {"thirteen", 13}};
  const std::size_t sign = text.find_first_of("+-");
  Press press{text.substr(0, sign - 1), 0};
  int times = static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) { return c == '+' || c == '-'; }));
  if (const std::size_t word = text.find(" times"); word != std::string::npos) {
    const std::size_t begin = text.rfind(' ', word - 1) + 1;
    times = kNumbers.at(text.substr(begin, word - begin));
  }
  press.times = text[sign] == '+' ? times : -times;
  return press;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<ManualRow> rows_of_the_manual() {
  const std::string manual = core::read_file(support::source("docs/manual/teach.md")).value();
  std::size_t line = manual.find("| press, on the row | artefact |");
  std::vector<ManualRow> rows;
  if (line == std::string::npos) return rows;
  for (line = manual.find('\n', manual.find('\n', line) + 1) + 1; manual[line] == '|';
       line = manual.find('\n', line) + 1) {
    const std::size_t middle = manual.find('|', line + 1);
    const std::string keys = manual.substr(line + 1, middle - line - 1);
    ManualRow row{trimmed(manual.substr(middle + 1, manual.find(':', middle) - middle - 1)), {}};
    for (std::size_t begin = 0; begin < keys.size();) {
      const std::size_t end = std::min(keys.find(';', begin), keys.size());
      row.presses.push_back(press_of(trimmed(keys.substr(begin, end - begin))));
      begin = end + 1;
    }
    rows.push_back(row);
  }
  return rows;
}

// ---- the visitor ----

const exhibit::Stage& stage() {
  static const exhibit::Stage loaded = [] {
    exhibit::ExhibitFiles files;
    files.assets_dir = support::source("assets");
    return exhibit::load_exhibit(files).value();
  }();
  return loaded;
}

std::vector<curves::SampleModel> models() {
  std::vector<curves::SampleModel> all;
  for (const scene::MaterialEntry& entry : stage().materials.materials) {
    all.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
  }
  return all;
}

class Visitor {
 public:
  Visitor() { panels_.set_scan(&scan_); }

  // Tab until the row is marked, then + or -.
  void press(const Press& keys) {
    for (int tabs = 0; tabs < 20 && !marked_row().starts_with(keys.row); ++tabs) panels_.mark_next(kGold);
    ASSERT_TRUE(marked_row().starts_with(keys.row)) << keys.row;
    for (int i = 0; i < std::abs(keys.times); ++i) panels_.step_marked(keys.times > 0 ? 1 : -1, kGold, nullptr);
  }

  // Waits until this many lines of a frame are whole, if necessary of the next frame.
  void wait_for_line(std::size_t line) {
    const std::uint32_t frame = scan_.progress().frame + (scan_.row() >= line ? 1 : 0);
    while (scan_.progress().frame < frame || scan_.row() < line) scan_.advance(kFrameS);
  }

  const LiveScan& scan() const { return scan_; }

 private:
  std::string marked_row() {
    render::FrameState frame;
    panels_.add_to(frame, {}, kGold, "Gold", {}, HandSource::Mouse);
    return frame.panels.control.content.marked
               ? frame.panels.control.content.rows.at(*frame.panels.control.content.marked).name
               : "";
  }

  std::vector<curves::SampleModel> models_ = models();
  LiveScan scan_{exhibit::scan_subject(stage().wall_scene, kGold, models_[kGold])};
  ViewPanels panels_{stage().wall_scene, models_, key_list};
};

// ---- what the image shows ----

struct Image {
  explicit Image(const LiveScan& shown)
      : scan(shown), last(*shown.newest_row()), true_m(shown.subject().traced(shown.usual().tip_radius_m)) {}

  double pixel_m() const { return scan.subject().side_m / kPixels; }
  double place_m(std::size_t column, std::size_t row, double right_px, double up_px) const {
    return true_m((static_cast<double>(column) + 0.5 - 0.5 * kPixels - right_px) * pixel_m(),
                  (0.5 * kPixels - 0.5 - static_cast<double>(row) - up_px) * pixel_m());
  }
  double height_m(std::size_t pass, std::size_t column, std::size_t row) const {
    return scan.maps().height_m[pass][row * kPixels + column];
  }
  double error_n(std::size_t column, std::size_t row) const { return scan.maps().error_n[0][row * kPixels + column]; }

  // The mean over the newest lines, without their ends.
  template <class Value>
  double mean(const Value& value) const {
    constexpr std::size_t kRim = 16;
    double sum = 0;
    for (std::size_t row = last + 1 - kLines; row <= last; ++row) {
      for (std::size_t column = kRim; column < kPixels - kRim; ++column) sum += value(column, row);
    }
    return sum / static_cast<double>(kLines * (kPixels - 2 * kRim));
  }

  const LiveScan& scan;
  std::size_t last;
  physics::Scanner::Surface true_m;
};

double square(double value) { return value * value; }

// The way in pixels, at most 16, by which something is least.
double least_at(const std::function<double(int)>& value) {
  int best = 0;
  for (int way = -16; way <= 16; ++way) {
    if (value(way) < value(best)) best = way;
  }
  return std::abs(best);
}

// Mean height above the sample, nm.
double mean_above(const Image& image) {
  return 1e9 * image.mean([&](auto c, auto r) { return image.height_m(0, c, r) - image.place_m(c, r, 0, 0); });
}

// The share of the pixels over which the tip flies: well above the sample, without any force for three in a row.
double flown_share(const Image& image) {
  constexpr double kAboveM = 1e-9, kNoForceN = 0.2e-9;
  return image.mean([&](auto c, auto r) {
    if (image.height_m(0, c, r) - image.place_m(c, r, 0, 0) < kAboveM) return 0.0;
    for (const std::size_t at : {c - 1, c, c + 1}) {
      if (std::abs(image.error_n(at, r) + image.scan.choice().setpoint_n) > kNoForceN) return 0.0;
    }
    return 1.0;
  });
}

// Median curvature from pixel to pixel beyond the sample's own shape, nm: steps of the sample do not matter.
double roughness(const Image& image) {
  std::vector<double> bends_m;
  image.mean([&](auto c, auto r) {
    const auto beyond_m = [&](auto at) { return image.height_m(0, at, r) - image.place_m(at, r, 0, 0); };
    bends_m.push_back(std::abs(beyond_m(c - 1) - 2.0 * beyond_m(c) + beyond_m(c + 1)));
    return 0.0;
  });
  std::nth_element(bends_m.begin(), bends_m.begin() + std::ssize(bends_m) / 2, bends_m.end());
  return 1e9 * bends_m[bends_m.size() / 2];
}

// Strength of an artefact in an image.
double shown(const Image& image, ScanArtefact artefact) {
  const double setpoint_n = std::abs(image.scan.choice().setpoint_n);
  switch (artefact) {
    case ScanArtefact::LostContact:
    case ScanArtefact::DoubleTip:
    case ScanArtefact::BluntTip:
      return mean_above(image);
    case ScanArtefact::Ringing:  // change from pixel to pixel of the error, in setpoints
      return std::sqrt(
                 image.mean([&](auto c, auto r) { return square(image.error_n(c, r) - image.error_n(c - 1, r)); })) /
             setpoint_n;
    case ScanArtefact::Parachuting:
      return flown_share(image);
    case ScanArtefact::Overload: {  // brightest point of the error, in setpoints
      double most_n = 0;
      image.mean([&](auto c, auto r) { return most_n = std::max(most_n, image.error_n(c, r)); });
      return most_n / setpoint_n;
    }
    case ScanArtefact::Drift:  // offset of the newest lines from the sample, in pixels to the right as above
      return least_at([&](int way) {
        return image.mean(
            [&](auto c, auto r) { return square(image.height_m(0, c, r) - image.place_m(c, r, way, way)); });
      });
    case ScanArtefact::Noise:
      return roughness(image);
    case ScanArtefact::Blur:  // offset between trace and retrace, in pixels
      return least_at([&](int way) {
        return image.mean([&](auto c, auto r) {
          const auto there = static_cast<std::size_t>(static_cast<int>(c) - way);
          return square(image.height_m(0, c, r) - image.height_m(1, there, r));
        });
      });
    case ScanArtefact::StateFlips:  // only in tapping mode
    case ScanArtefact::Saturation:
    case ScanArtefact::None:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Largest strength in a clean image, and smallest in one with the artefact.
struct Bounds {
  ScanArtefact artefact;
  double clean, present;
};

constexpr std::array kBounds{Bounds{ScanArtefact::LostContact, 0.1, 10},      Bounds{ScanArtefact::Ringing, 0.3, 0.8},
                             Bounds{ScanArtefact::Parachuting, 0.002, 0.015}, Bounds{ScanArtefact::Overload, 2.2, 4},
                             Bounds{ScanArtefact::DoubleTip, 0.1, 0.3},       Bounds{ScanArtefact::Drift, 1, 6},
                             Bounds{ScanArtefact::Noise, 0.1, 0.25},          Bounds{ScanArtefact::Blur, 3, 7},
                             Bounds{ScanArtefact::BluntTip, 0.1, 0.3}};

std::string words_of(ScanArtefact artefact) {
  std::string name(physics::name_of(artefact));
  std::replace(name.begin(), name.end(), '-', ' ');
  return name;
}

TEST(KeysOfTheManual, MakeEachArtefactInTheImageAndUndoIt) {
  const std::vector<ManualRow> rows = rows_of_the_manual();
  ASSERT_EQ(rows.size(), kBounds.size());
  for (const Bounds& bounds : kBounds) {
    const std::string name = words_of(bounds.artefact);
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const ManualRow& each) { return each.artefact == name; });
    ASSERT_NE(row, rows.end()) << name;
    // drift grows with the lines; a tip that has let go engages with the next frame
    const bool drifts = bounds.artefact == ScanArtefact::Drift, lost = bounds.artefact == ScanArtefact::LostContact;
    const std::size_t with_line = drifts ? 110 : 28, after_line = drifts ? 110 : (lost ? 14 : 42);
    Visitor visitor;
    visitor.wait_for_line(14);
    EXPECT_LE(shown(Image(visitor.scan()), bounds.artefact), bounds.clean) << name;
    for (const Press& keys : row->presses) visitor.press(keys);
    visitor.wait_for_line(with_line);
    EXPECT_GE(shown(Image(visitor.scan()), bounds.artefact), bounds.present) << name;
    EXPECT_EQ(physics::name_of(cause_of(visitor.scan())), physics::name_of(bounds.artefact));
    for (const Press& keys : row->presses) visitor.press({keys.row, -keys.times});
    EXPECT_EQ(visitor.scan().choice(), visitor.scan().usual()) << name;
    visitor.wait_for_line(after_line);
    EXPECT_LE(shown(Image(visitor.scan()), bounds.artefact), bounds.clean) << name;
    EXPECT_EQ(physics::name_of(cause_of(visitor.scan())), physics::name_of(ScanArtefact::None)) << name;
  }
}

}  // namespace scan_keys_test
}  // namespace afm::app

// SPDX-License-Identifier: Apache-2.0
// touchafm-hdf5: reads and writes afmformats' HDF5 curves, and reads Nanosurf's .nhf, for touchafm in a confined
// process, because HDF5 1.10 crashes on damaged files, and Debian's library loads curl, Kerberos and LDAP, which no
// other command needs.
//
// touchafm-hdf5 read INDEX 1 K S        reads an .h5 or .nhf from stdin, writes its curve as afmformats .tab to stdout
// touchafm-hdf5 count                   writes the number of its curves
// touchafm-hdf5 stream FIRST STEP K S   writes every STEP-th curve from FIRST on, each as a message of a ConfinedStream
// touchafm-hdf5 write                   reads .tabs, each ended by a NUL, writes an .h5
// touchafm-hdf5 image                   reads a .nhf of Nanosurf from stdin, writes its image as .gwy
//
// K and S calibrate a lever that the file does not: spring constant in N/m and sensitivity in m/V; 0: not given.
//
// Exit codes are those of confined/confined_child.h; a fault of the file is reported on stdout.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "confined/confined_child.h"
#include "confined/confinement.h"
#include "core/log.h"
#include "core/write_all.h"
#include "curves/curve_error.h"
#include "curves/image_output.h"
#include "formats/handed_curve.h"
#include "formats/segments.h"
#include "formats/tab_file.h"
#include "hdf5_file.h"
#include "images/nhf_pages.h"
#include "nhf_curves.h"
#include "nhf_image.h"

namespace {

using namespace afm;

std::string read_stdin() {
  std::string bytes;
  char buffer[65536];
  for (ssize_t count = 0; (count = ::read(STDIN_FILENO, buffer, sizeof(buffer))) > 0;) {
    bytes.append(buffer, static_cast<std::size_t>(count));
  }
  return bytes;
}

template <class Number>
Number number_of(std::string_view text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Curves that the arguments request.
struct Asked {
  std::size_t first = 0, step = 1;
  curves::CurveReading reading;
};

Asked asked_for(int count, char** arguments) {
  Asked asked;
  if (count > 2) asked.first = number_of<std::size_t>(arguments[2]);
  if (count > 3) asked.step = std::max<std::size_t>(1, number_of<std::size_t>(arguments[3]));
  const double spring = count > 4 ? number_of<double>(arguments[4]) : 0.0;
  const double sensitivity = count > 5 ? number_of<double>(arguments[5]) : 0.0;
  if (spring > 0.0) asked.reading.spring_constant = physics::Stiffness(spring);
  if (sensitivity > 0.0) asked.reading.sensitivity_m_per_v = sensitivity;
  return asked;
}

std::vector<curves::RecordedCurve> read_tabs(std::string_view bytes) {
  std::vector<curves::RecordedCurve> read;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\0'), bytes.size());
    read.push_back(curves::read_tab(bytes.substr(0, end)));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  return read;
}

template <class Curves>
void stream(const Curves& file, const Asked& asked) {
  const std::size_t count = file.size();
  for (std::size_t i = asked.first; i < count; i += asked.step) {
    try {
      curves::put_message({false, handed_bytes(file.curve(i, asked.reading))});
    } catch (const curves::CurveError& fault) {
      curves::put_message({true, fault.what()});
    }
  }
}

template <class Curves>
std::string converted_curves(const Curves& file, std::string_view how, const Asked& asked) {
  if (how == "count") {
    const std::size_t count = file.size();
    if (count == 0) return tab_bytes(file.curve(0, asked.reading));  // throws the reason
    return std::to_string(count);
  }
  if (how == "read") {
    curves::RecordedCurve curve = file.curve(asked.first, asked.reading);
    curves::remark_index(asked.first, file.size(), curve.metadata);
    return tab_bytes(curve);
  }
  stream(file, asked);
  return {};
}

// Output written to stdout at the end; a stream has written everything before.
std::string converted(std::string_view how, const Asked& asked) {
  const std::string bytes = read_stdin();
  curves::confine_this_process((how == "stream" ? curves::kStreamTime : curves::kMapTime).processor_time);
  if (how == "write") return curves::hdf5_bytes(read_tabs(bytes));
  if (how == "image") return curves::gwy_bytes(curves::nhf_image(bytes));
  if (curves::is_nhf(bytes)) return converted_curves(curves::NhfCurves(bytes), how, asked);
  return converted_curves(curves::Hdf5Curves(bytes), how, asked);
}

curves::ChildExit convert(std::string_view how, const Asked& asked) {
  try {
    return core::write_all(STDOUT_FILENO, converted(how, asked)) == 0 ? curves::ChildExit::Done
                                                                      : curves::ChildExit::Failed;
  } catch (const curves::CurveError& fault) {
    if (how == "stream") {
      curves::put_message({true, fault.what()});
      return curves::ChildExit::Done;
    }
    return core::write_all(STDOUT_FILENO, fault.what()) == 0 ? curves::ChildExit::Fault : curves::ChildExit::Failed;
  } catch (const std::exception& fault) {
    core::log_line(fault.what());
    return curves::ChildExit::Failed;
  }
}

}  // namespace

int main(int count, char** arguments) {
  constexpr std::array<std::string_view, 5> kWays{"read", "count", "stream", "write", "image"};
  const std::string_view how = count > 1 ? arguments[1] : "";
  if (std::find(kWays.begin(), kWays.end(), how) == kWays.end()) {
    core::log_line("touchafm-hdf5 is started by touchafm; run 'touchafm analyse FILE.h5' instead");
    return 2;
  }
  // skips HDF5's own clean-up, which may crash
  ::_exit(static_cast<int>(convert(how, asked_for(count, arguments))));
}

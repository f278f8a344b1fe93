// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace afm::curves {

// Reason why a file is not a curve, and a remedy. Thrown only within the readers; parse_curve() converts it to an error
// that names the file.
class CurveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Advice for a file, or a part of it, that lacks its end.
inline constexpr const char* kCopyAgain = "copy the file again from where it was saved";

// Message "it is cut short: it has 3 of its 64 curves; copy ...". `there`: the existing or the missing part; may be
// empty.
inline std::string cut_short(const std::string& there = {}) {
  return "it is cut short" + (there.empty() ? std::string() : ": " + there) + "; " + kCopyAgain;
}

// The file ends before its data do: an image is refused, even if only one channel is incomplete; of several curves
// those are read that are there.
class CutShort : public CurveError {
 public:
  explicit CutShort(const std::string& there = {}) : CurveError(cut_short(there)) {}
};

}  // namespace afm::curves

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace afm::curves {

// The key=value lines of JPK's .properties files (Java's, without line continuation, which JPK does not write).
class JpkProperties {
 public:
  // Adds properties; a later value replaces an earlier one.
  void add(std::string_view text);

  // Newer files store the segments' common properties in one place: for "channel.height.lcd-info.*=2" everything in
  // `shared` below "lcd-info.2." is added below "channel.height.".
  void take_shared(const JpkProperties& shared);

  std::optional<std::string> text(std::string_view key) const;

  // Throws CurveError if it exists but is not a finite number.
  std::optional<double> number(std::string_view key) const;

 private:
  std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace afm::curves

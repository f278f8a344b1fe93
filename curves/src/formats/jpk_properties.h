// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace afm::curves {

// The key=value lines of JPK's .properties files (Java's, without line continuation, which JPK does not write).
class JpkProperties {
 public:
  // Adds properties; a later value replaces an earlier one.
  void add(std::string_view text);

  // Properties of the whole file, which go before those added here. Must outlive the object.
  void set_general(const JpkProperties& general) { general_ = &general; }

  // Newer files store the segments' common properties in one place: for "channel.height.lcd-info.*=2" everything in
  // `shared` below "lcd-info.2." is found below "channel.height.", where nothing else is. Must outlive the object.
  void set_shared(const JpkProperties& shared);

  std::optional<std::string> text(std::string_view key) const;

  // Number of a key. Throws CurveError if it exists but is not a finite number.
  std::optional<double> number(std::string_view key) const;

 private:
  struct Reference {
    std::string prefix;  // prefix of the referring keys, "channel.height."
    std::string place;   // place in the shared properties, "lcd-info.2."
  };

  std::map<std::string, std::string, std::less<>> values_;
  std::vector<Reference> references_;
  const JpkProperties* general_ = nullptr;
  const JpkProperties* shared_ = nullptr;
};

}  // namespace afm::curves

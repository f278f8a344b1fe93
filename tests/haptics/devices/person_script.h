// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <vector>

namespace afm::support {

// Actions of a person with the device of a mock, repeated: lines "seconds x_mm y_mm z_mm buttons", to the right,
// up and towards the user, with straight paths between them.
class PersonScript {
 public:
  struct Moment {
    std::array<double, 3> position_mm{};
    int buttons = 0;
  };

  // Reads the file; false if it has no line. The only function here that allocates.
  bool load(const char* file_name) {
    std::ifstream file(file_name);
    KeyFrame key;
    while (file >> key.seconds >> key.at.position_mm[0] >> key.at.position_mm[1] >> key.at.position_mm[2] >>
           key.at.buttons)
      keys_.push_back(key);
    return !keys_.empty();
  }

  bool empty() const { return keys_.empty(); }
  void clear() { keys_.clear(); }

  // Moment of a script that is not empty.
  Moment at(double played_s) const {
    const double whole = keys_.back().seconds;
    const double seconds = whole > 0 ? std::fmod(played_s, whole) : 0.0;
    const auto after = std::find_if(keys_.begin(), keys_.end(), [&](const KeyFrame& k) { return k.seconds > seconds; });
    const KeyFrame& to = after == keys_.end() ? keys_.back() : *after;
    const KeyFrame& from = after == keys_.begin() ? keys_.front() : *(after - 1);
    const double span = to.seconds - from.seconds;
    const double share = span > 0 ? std::clamp((seconds - from.seconds) / span, 0.0, 1.0) : 0.0;
    Moment moment = from.at;
    for (unsigned axis = 0; axis < 3; ++axis)
      moment.position_mm[axis] += share * (to.at.position_mm[axis] - from.at.position_mm[axis]);
    return moment;
  }

 private:
  struct KeyFrame {
    double seconds = 0;
    Moment at;
  };
  std::vector<KeyFrame> keys_;
};

}  // namespace afm::support

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace afm::study {

// Ages in years, in bands that are wide enough to stay anonymous: values of --age-band and in participants.tsv.
struct AgeBandRow {
  std::string_view word;
};
inline constexpr std::array kAgeBands{AgeBandRow{"under-14"}, AgeBandRow{"14-17"}, AgeBandRow{"18-24"},
                                      AgeBandRow{"25-39"},    AgeBandRow{"40-59"}, AgeBandRow{"60-or-more"}};

}  // namespace afm::study

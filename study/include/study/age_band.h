// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace afm::study {

// Ages in years, in bands that are wide enough to stay anonymous: values of --age-band and in participants.tsv.
struct AgeBandRow {
  std::string_view word, meaning;
};
inline constexpr std::array kAgeBands{
    AgeBandRow{"under-14", "younger than 14 years"}, AgeBandRow{"14-17", "14 to 17 years"},
    AgeBandRow{"18-24", "18 to 24 years"},           AgeBandRow{"25-39", "25 to 39 years"},
    AgeBandRow{"40-59", "40 to 59 years"},           AgeBandRow{"60-or-more", "60 years or older"}};

}  // namespace afm::study

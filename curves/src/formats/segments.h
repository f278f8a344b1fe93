// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "curves/recorded_curve.h"

namespace afm::curves {

// Sets the branch of each point by its number in afmformats' column "segment": 0 approach, 1 retract. With more
// segments the first is the approach and the last the retract; those between them are left out, with a remark, if the
// tip rests there. Throws CurveError for any other numbers.
void assign_branches(std::span<const double> segments, RecordedCurve& curve);

inline constexpr const char* kBeforeApproach = "before the approach";
inline constexpr const char* kBetweenBranches = "between approach and retract";
inline constexpr const char* kAfterRetract = "after the retract";

// Adds a remark on points that were left out: `when` is one of the texts above, `what_it_does` "rests".
void remark_left_out(std::size_t points, std::string_view when, std::string_view what_it_does,
                     std::optional<double> duration_s, CurveMetadata& metadata);

// Adds a remark on which curve of a file with several it is.
void remark_index(std::size_t index, std::size_t count, CurveMetadata& metadata);

// Exchanges the first `first_count` points, which lead away from the sample, with those behind them, and their
// branches. Forgets the times, and adds a remark.
void put_second_part_first(std::size_t first_count, RecordedCurve& curve);

// Makes both branches lead the way that every reader of them expects: heights fall on the approach, all of which are
// counted the other way otherwise, and rise on the retract. Adds a remark on what was turned.
void set_directions(RecordedCurve& curve);

}  // namespace afm::curves

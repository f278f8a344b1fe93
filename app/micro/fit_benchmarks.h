// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/micro/benchmark.h"

namespace afm::app {

// Benchmarks of the fit of a paraboloid to one curve of 2 x 2000 points, with and without its interval, and of curves
// of 2 x 500 points on one thread and on two.
std::vector<BenchmarkCase> fit_benchmarks();

// Ratios of these figures compared with the goals, one line each; empty for figures of other benchmarks.
std::string fit_ratios(const std::vector<BenchmarkFigure>& figures);

}  // namespace afm::app

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/micro/benchmark.h"

namespace afm::app {

// Benchmarks of a tick and the tables of each law, of a sub-step of the dynamics, and of a curve of 10,000 points
// computed by `program` as a separate process.
std::vector<BenchmarkCase> physics_benchmarks(const std::string& program);

}  // namespace afm::app

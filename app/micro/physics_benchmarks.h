// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/micro/benchmark.h"

namespace afm::app {

// A tick and the tables of each law, a sub-step of the dynamics, and a curve of 10,000 points by `program` as a person
// runs it.
std::vector<BenchmarkCase> physics_benchmarks(const std::string& program);

}  // namespace afm::app

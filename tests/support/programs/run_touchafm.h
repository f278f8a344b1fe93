// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/places.h"
#include "support/run_program.h"

namespace afm::support {

// Runs the program with these arguments, as typed by a person, and waits.
inline ProgramResult run_touchafm(const std::string& arguments) { return run_program(touchafm() + " " + arguments); }

// Expects a refusal in one line, with nothing on standard output.
inline void expect_refusal(const ProgramResult& result, int exit_code, const std::string& part) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_THAT(result.err, testing::HasSubstr(part));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.out, "");
}

}  // namespace afm::support

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "exhibit/lesson/data_set.h"
#include "exhibit/lesson/lesson.h"

namespace afm::app {

// A lesson to run in the window.
struct ViewLesson {
  exhibit::Lesson lesson;
  std::optional<exhibit::DataSetEntry> study;
};

}  // namespace afm::app

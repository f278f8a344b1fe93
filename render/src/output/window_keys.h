// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "render/key.h"

namespace afm::render {

// Label that the layout in use prints on the key with this GLFW code, without Shift, in UTF-8; empty: none.
using LabelOfKey = std::function<std::string(int glfw_code)>;

// Key that was pressed: the one with the GLFW code `code` (negative: unknown), which typed the sign `typed` (0: none).
Key key_of(int code, char32_t typed, const LabelOfKey& label_of);

// Labels of the keys A to Z, 26 characters of UTF-8: the letter itself, or what the key at its place on a US keyboard
// is labelled with where the layout lacks the letter. Empty if it lacks none.
std::string letters_of(const LabelOfKey& label_of);

}  // namespace afm::render

// SPDX-License-Identifier: Apache-2.0
// The compiled part of toml++, which Debian has as a shared library alone. Linked into the programs of the bundle
// (cmake/AfmBundle.cmake).
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>

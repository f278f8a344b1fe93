// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "gltf_document.h"
#include "gltf_material_extensions.h"
#include "gltf_schema.h"
#include "support/places.h"

namespace afm::scene {
namespace gltf_extensions_test {

std::string row_of_the_manual() {
  std::ifstream file(support::source("docs/gltf.md"));
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| extensions |")) return line;
  }
  return {};
}

TEST(GltfExtensions, AreThoseThatTheManualNames) {
  const std::string row = row_of_the_manual();
  const std::regex name("`((?:KHR|EXT)_\\w+)`");
  std::set<std::string> named;
  for (std::sregex_iterator match(row.begin(), row.end(), name), none; match != none; ++match) {
    named.insert((*match)[1]);
  }
  const std::set<std::string_view> known = gltf_extensions();
  EXPECT_EQ(named, (std::set<std::string>(known.begin(), known.end())));
  EXPECT_GE(known.size(), 13U);
}

TEST(GltfExtensions, OfMaterialsAreAllInTheSchema) {
  for (const GltfMaterialExtension& extension : gltf_material_extensions()) {
    EXPECT_TRUE(gltf_extensions().contains(extension.schema.name)) << extension.schema.name;
    EXPECT_NE(extension.read, nullptr) << extension.schema.name;
  }
}

class RequiredExtensions : public GltfFolder {};

TEST_F(RequiredExtensions, AreAcceptedWhereTheyAreKnown) {
  for (const std::string_view name : gltf_extensions()) {
    nlohmann::json document = square_json();
    document["extensionsUsed"] = document["extensionsRequired"] = {std::string(name)};
    EXPECT_TRUE(load(document, square_binary())) << name;
  }
}

}  // namespace gltf_extensions_test
}  // namespace afm::scene

// SPDX-License-Identifier: Apache-2.0
// Every function of a production header is used by production code: one that only a test calls belongs to the tests.
// Invariant: every function that a production header declares is used outside the tests
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "architecture/function_names.h"
#include "architecture/production.h"
#include "core/whole_file.h"
#include "support/places.h"

namespace afm {
namespace unused_functions_test {

using support::function_names_of;
using support::FunctionNames;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

// Text of each source, by its path.
using Sources = std::map<std::string, std::string>;

// "header: function" for each function of a header that no source uses.
std::vector<std::string> faults_of(const Sources& sources) {
  std::map<std::string, std::string> headers;  // header by declared function
  std::map<std::string, int> used;
  for (const auto& [path, text] : sources) {
    const FunctionNames names = function_names_of(text);
    for (const auto& [name, times] : names.used) used[name] += times;
    if (!path.ends_with(".h")) continue;
    for (const std::string& name : names.declared) headers.emplace(name, path);
  }
  std::vector<std::string> faults;
  for (const auto& [name, header] : headers) {
    if (used[name] <= 0) faults.push_back(header + ": " + name);
  }
  return faults;
}

TEST(FunctionNames, AreThoseOfDeclarationsAndDefinitions) {
  const FunctionNames names = function_names_of(
      "namespace a { template <class T, int N = (1)> T b(T t = c()); class D : public E<int> { public: explicit D(int "
      "f);\n"
      " int g() const noexcept(true) { return h(); } static std::map<int, int> i(); int j_ = k(); void l() override; "
      "};\n"
      "enum class M { N }; constexpr int kO = p(1); D::D(int f) : q_{f}, r_(f) { s(); }\n"
      "bool operator==(const D&, const D&); static_assert(t()); extern \"C\" { int u(void); } using V = int(int); "
      "}\n#define W(x) \\\n  y(x)\n");
  EXPECT_THAT(names.declared, UnorderedElementsAre("b", "g", "i", "u"));
  for (const char* used : {"c", "h", "k", "l", "p", "s", "t", "y", "E", "D"}) EXPECT_GT(names.used.at(used), 0) << used;
  for (const char* unused : {"b", "g", "i", "u"}) EXPECT_EQ(names.used.at(unused), 0) << unused;
}

TEST(UnusedFunctions, AreFoundInAMadeUpFolder) {
  Sources sources{{"a.h", "struct A { int b() const { return c_; } int d() const; int c_; };\nint e(const A& a);\n"},
                  {"a.cpp", "int A::d() const { return 2 * c_; }\nint e(const A& a) { return a.b(); }\n"},
                  {"f.cpp", "int main() { return e(A{}); }\n"}};
  EXPECT_THAT(faults_of(sources), ElementsAre("a.h: d"));
  sources["f.cpp"] = "int main() { return e(A{}) + A{}.d(); }\n";
  EXPECT_THAT(faults_of(sources), IsEmpty());
}

TEST(UnusedFunctions, AreInNoProductionHeader) {
  namespace fs = std::filesystem;
  Sources sources;
  for (const std::string& root : support::production_folders()) {
    for (const auto& entry : fs::recursive_directory_iterator(support::source(root))) {
      const std::string ending = entry.path().extension().string();
      if (!entry.is_regular_file() || (ending != ".cpp" && ending != ".h")) continue;
      sources.emplace(fs::relative(entry.path(), support::source()).string(),
                      core::read_file(entry.path().string()).value());
    }
  }
  EXPECT_GT(sources.size(), 1000U);
  const std::vector<std::string> faults = faults_of(sources);
  EXPECT_THAT(faults, IsEmpty()) << fmt::format("{}", fmt::join(faults, "\n"));
}

}  // namespace unused_functions_test
}  // namespace afm

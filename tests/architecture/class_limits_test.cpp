// SPDX-License-Identifier: Apache-2.0
// A class has one task: few fields, few functions, and few sources that define its members.
// Invariant: a class has at most 30 fields, 40 functions and two sources that define them
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "architecture/class_shape.h"
#include "architecture/production.h"
#include "core/whole_file.h"
#include "support/places.h"

namespace afm {
namespace class_limits_test {

using support::classes_of;
using support::ClassShape;
using support::owners_of_members;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr int kMostFields = 30;
constexpr int kMostFunctions = 40;
constexpr std::size_t kMostSources = 2;

std::string text_of(const std::vector<ClassShape>& shapes) {
  std::string text;
  for (const ClassShape& shape : shapes) text += fmt::format("{} {} {};", shape.name, shape.fields, shape.functions);
  return text;
}

std::vector<std::string> faults_of(const std::string& file, const std::vector<ClassShape>& shapes) {
  std::vector<std::string> faults;
  for (const ClassShape& shape : shapes) {
    if (shape.fields > kMostFields) {
      faults.push_back(fmt::format("{}: {} has {} fields, {} at most", file, shape.name, shape.fields, kMostFields));
    }
    if (shape.functions > kMostFunctions) {
      faults.push_back(
          fmt::format("{}: {} has {} functions, {} at most", file, shape.name, shape.functions, kMostFunctions));
    }
  }
  return faults;
}

TEST(ClassShape, CountsFieldsByTheirNames) {
  EXPECT_EQ(text_of(classes_of("struct A { int a = 1, b{2}; std::map<int, int> c; static constexpr int kD = f(1); };")),
            "A 3 0;");
  EXPECT_EQ(text_of(classes_of("class A final : public B<int> { std::function<void(int, int)> call; double d[2]; "
                               "enum class E { F, G }; using H = int; friend class I; E e = E::F; };")),
            "A 3 0;");
  EXPECT_EQ(text_of(classes_of("struct A; enum class B { C }; template <class D, class E> void f(struct A a);")), "");
}

TEST(ClassShape, CountsFunctionsWithAndWithoutBody) {
  EXPECT_EQ(
      text_of(classes_of("class A { public: A(int a) : a_(a), b_{1, 2} { f(); } ~A() = default; "
                         "bool operator==(const A&) const = default; int operator()() const { return a_; }\n"
                         "bool operator<(const A& other) const; template <class T> static T g(T t) { return t; }\n"
                         "private: int a_; std::array<int, 2> b_; };")),
      "A 2 6;");
}

TEST(ClassShape, CountsNestedClassesByThemselves) {
  EXPECT_EQ(
      text_of(classes_of("namespace n { class A { struct B { int c; void d(); int e; } ; B b_; int f; int g(); }; }")),
      "B 2 1;A 2 1;");
}

TEST(ClassShape, IsNotMisledByCommentsAndLiterals) {
  EXPECT_EQ(text_of(classes_of(
                "// class Z { int a; };\n#define Y struct X {\nstruct A { /* int b; */ const char* c = \"; int d;\"; "
                "char e = ';'; int f = 1'000; };\nint g = R\"x(struct B { int c; };)x\";")),
            "A 3 0;");
}

TEST(ClassShape, OwnersAreThoseOfDefinitions) {
  EXPECT_THAT(owners_of_members("namespace n { A::A(int a) : a_(B::make(a)) { C::f(); }\nint D::E::g() { return 0; }\n"
                                "F::~F() = default;\nbool G::operator==(const G&) const { return true; }\n"
                                "const int kH = I::h();\nint j() { return K::k(); } }"),
              UnorderedElementsAre("A", "D::E", "F", "G"));
}

TEST(ClassLimits, FindMadeUpFaults) {
  std::string source = "struct A {";
  for (int i = 0; i < kMostFields; ++i) source += fmt::format(" int field{};", i);
  for (int i = 0; i < kMostFunctions; ++i) source += fmt::format(" void function{}();", i);
  EXPECT_THAT(faults_of("a.h", classes_of(source + " };")), IsEmpty());
  EXPECT_THAT(faults_of("a.h", classes_of(source + " int one_more; void another(); };")),
              UnorderedElementsAre("a.h: A has 31 fields, 30 at most", "a.h: A has 41 functions, 40 at most"));
}

TEST(ClassLimits, HoldForEveryClass) {
  namespace fs = std::filesystem;
  std::vector<std::string> faults;
  std::size_t classes = 0, files = 0;
  for (const std::string& root : support::production_folders()) {
    std::set<std::string> names;
    std::map<std::string, std::set<std::string>> sources;  // source files per class
    for (const auto& entry : fs::recursive_directory_iterator(support::source(root))) {
      const std::string ending = entry.path().extension().string();
      if (!entry.is_regular_file() || (ending != ".cpp" && ending != ".h")) continue;
      ++files;
      const std::string file = fs::relative(entry.path(), support::source()).string();
      const std::string text = core::read_file(entry.path().string()).value();
      const std::vector<ClassShape> shapes = classes_of(text);
      classes += shapes.size();
      for (const ClassShape& shape : shapes) names.insert(shape.name);
      for (std::string& fault : faults_of(file, shapes)) faults.push_back(std::move(fault));
      if (ending != ".cpp") continue;
      for (const std::string& owner : owners_of_members(text)) sources[owner].insert(file);
    }
    for (const auto& [name, of_class] : sources) {
      if (names.contains(name.substr(name.rfind(':') + 1)) && of_class.size() > kMostSources) {
        faults.push_back(fmt::format("{}: {} sources define its members, {} at most: {}", name, of_class.size(),
                                     kMostSources, fmt::join(of_class, ", ")));
      }
    }
  }
  EXPECT_GT(files, 1000U);
  EXPECT_GT(classes, 900U);
  EXPECT_THAT(faults, IsEmpty()) << fmt::format("{}", fmt::join(faults, "\n"));
}

}  // namespace class_limits_test
}  // namespace afm

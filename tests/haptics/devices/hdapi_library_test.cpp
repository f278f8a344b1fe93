// SPDX-License-Identifier: Apache-2.0
#include "devices/hdapi_library.h"
#include "support/places.h"

#include <dlfcn.h>
#include <gmock/gmock.h>

#include <iterator>

namespace hdapi_library_test {

using afm::haptics::HdapiSearch;
using afm::haptics::load_hdapi;
using testing::HasSubstr;
using testing::SizeIs;

TEST(HdapiLibrary, TriesTheKnownNamesAndSaysWhatTheLinkerSaid) {
  const HdapiSearch search = load_hdapi("");
  ASSERT_FALSE(search.functions) << "a vendor's library is installed on this machine";
  ASSERT_THAT(search.attempts, SizeIs(3));
  EXPECT_EQ(search.attempts[0].name, "libHD.so.3.4");
  EXPECT_EQ(search.attempts[1].name, "libHD.so.3.0");
  EXPECT_EQ(search.attempts[2].name, "libHD.so");
  for (const auto& attempt : search.attempts) {
    EXPECT_THAT(attempt.refusal, HasSubstr(attempt.name + ": cannot open shared object file"));
  }
}

TEST(HdapiLibrary, TakesTheConfiguredOneAndNoOther) {
  const HdapiSearch found = load_hdapi(afm::support::mock_hd());
  ASSERT_TRUE(found.functions);
  ASSERT_THAT(found.attempts, SizeIs(1));
  EXPECT_EQ(found.attempts[0].refusal, "");

  const HdapiSearch missing = load_hdapi("/nowhere/libHD.so");
  EXPECT_FALSE(missing.functions);
  ASSERT_THAT(missing.attempts, SizeIs(1));
  EXPECT_THAT(missing.attempts[0].refusal, HasSubstr("No such file"));
}

TEST(HdapiLibrary, RefusesALibraryThatLacksAFunctionByItsName) {
  const HdapiSearch search = load_hdapi(afm::support::mock_hd_without_unschedule());
  EXPECT_FALSE(search.functions);
  ASSERT_THAT(search.attempts, SizeIs(1));
  EXPECT_EQ(search.attempts[0].refusal, "it lacks the function hdUnschedule");
}

TEST(HdapiLibrary, GivesTheSameFunctionsWhenItIsLoadedAgain) {
  EXPECT_EQ(load_hdapi(afm::support::mock_hd()).functions->init_device,
            load_hdapi(afm::support::mock_hd()).functions->init_device);
}

TEST(MockHd, ExportsTheThirtySixFunctionsOfTheInterface) {
  void* library = ::dlopen(afm::support::mock_hd().c_str(), RTLD_NOW);
  ASSERT_NE(library, nullptr);
  const char* const names[] = {"hdInitDevice",
                               "hdDisableDevice",
                               "hdMakeCurrentDevice",
                               "hdBeginFrame",
                               "hdEndFrame",
                               "hdGetCurrentDevice",
                               "hdGetError",
                               "hdGetErrorString",
                               "hdEnable",
                               "hdDisable",
                               "hdIsEnabled",
                               "hdGetBooleanv",
                               "hdGetIntegerv",
                               "hdGetFloatv",
                               "hdGetDoublev",
                               "hdGetLongv",
                               "hdSetBooleanv",
                               "hdSetIntegerv",
                               "hdSetFloatv",
                               "hdSetDoublev",
                               "hdSetLongv",
                               "hdGetString",
                               "hdCheckCalibration",
                               "hdCheckCalibrationStyle",
                               "hdUpdateCalibration",
                               "hdUpdateCalibrationMessage",
                               "hdScaleGimbalAngles",
                               "hdDeploymentLicense",
                               "hdStartScheduler",
                               "hdStopScheduler",
                               "hdSetSchedulerRate",
                               "hdScheduleSynchronous",
                               "hdScheduleAsynchronous",
                               "hdUnschedule",
                               "hdWaitForCompletion",
                               "hdGetSchedulerTimeStamp"};
  static_assert(std::size(names) == 36);
  for (const char* name : names) EXPECT_NE(::dlsym(library, name), nullptr) << name;
}

}  // namespace hdapi_library_test

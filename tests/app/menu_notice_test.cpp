// SPDX-License-Identifier: Apache-2.0
#include "app/options/menu_notice.h"

#include <gmock/gmock.h>
#include <systemd/sd-bus.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

// A program that was started from a menu reports its failure as a notification. The test provides the bus and the
// notification service.
namespace afm::app {
namespace menu_notice_test {

using ::testing::HasSubstr;
using ::testing::Not;

class MenuNotice : public ::testing::Test {
 protected:
  MenuNotice() {
    folder_.write("session.conf",
                  "<!DOCTYPE busconfig PUBLIC \"-//freedesktop//DTD D-Bus Bus Configuration 1.0//EN\" "
                  "\"http://www.freedesktop.org/standards/dbus/1.0/busconfig.dtd\">\n"
                  "<busconfig><type>session</type><listen>" +
                      address() +
                      "</listen><auth>EXTERNAL</auth><policy context='default'><allow send_destination='*'/>"
                      "<allow receive_sender='*'/><allow own='*'/></policy></busconfig>");
    daemon_ = std::make_unique<support::LiveProgram>(
        std::vector<std::string>{"/usr/bin/dbus-daemon", "--nofork", "--nopidfile",
                                 "--config-file=" + folder_.file("session.conf")},
        "");
  }
  ~MenuNotice() override { sd_bus_flush_close_unref(bus_); }

  std::string address() const { return "unix:path=" + folder_.file("bus"); }

  // Provides the notification service of a desktop.
  void become_the_desktop() {
    ASSERT_TRUE(daemon_->within(std::chrono::seconds(20), [&] {
      if (sd_bus_new(&bus_) < 0) return false;
      if (sd_bus_set_address(bus_, address().c_str()) >= 0 && sd_bus_set_bus_client(bus_, 1) >= 0 &&
          sd_bus_start(bus_) >= 0)
        return true;
      bus_ = sd_bus_unref(bus_);
      return false;
    })) << daemon_->said();
    static const sd_bus_vtable kTable[] = {
        SD_BUS_VTABLE_START(0),
        SD_BUS_METHOD("Notify", "susssasa{sv}i", "u", &MenuNotice::notify, SD_BUS_VTABLE_UNPRIVILEGED),
        SD_BUS_VTABLE_END};
    ASSERT_GE(sd_bus_add_object_vtable(bus_, nullptr, "/org/freedesktop/Notifications", "org.freedesktop.Notifications",
                                       kTable, this),
              0);
    ASSERT_GE(sd_bus_request_name(bus_, "org.freedesktop.Notifications", 0), 0);
  }
  static int notify(sd_bus_message* message, void* self, sd_bus_error*) {
    const char *program = nullptr, *icon = nullptr, *summary = nullptr, *body = nullptr;
    unsigned replaces = 0;
    sd_bus_message_read(message, "susss", &program, &replaces, &icon, &summary, &body);
    static_cast<MenuNotice*>(self)->shown_ = std::string(summary) + ": " + body;
    return sd_bus_reply_method_return(message, "u", 1U);
  }

  std::unique_ptr<support::LiveProgram> start(const std::vector<std::string>& environment) const {
    std::vector<std::string> command{"/usr/bin/env", "DBUS_SESSION_BUS_ADDRESS=" + address()};
    command.insert(command.end(), environment.begin(), environment.end());
    command.insert(command.end(), {support::touchafm(), "view", "--wall", "/no/<such>.toml"});
    return std::make_unique<support::LiveProgram>(command, "");
  }

  support::ScratchFolder folder_;
  std::unique_ptr<support::LiveProgram> daemon_;
  sd_bus* bus_ = nullptr;
  std::string shown_;
};

TEST_F(MenuNotice, SaysWhyTheProgramEnds) {
  ASSERT_NO_FATAL_FAILURE(become_the_desktop());
  const auto program = start({std::string(kFromMenu) + "=1"});
  program->within(std::chrono::minutes(1), [&] {
    while (sd_bus_process(bus_, nullptr) > 0) {
    }
    return !shown_.empty();
  });
  EXPECT_EQ(program->ends(), 3) << program->said();
  EXPECT_THAT(shown_, HasSubstr("TouchAFM has ended with an error: "));
  EXPECT_THAT(shown_, HasSubstr("/no/&lt;such&gt;.toml"));
}

TEST_F(MenuNotice, IsNotForATerminal) {
  ASSERT_NO_FATAL_FAILURE(become_the_desktop());
  const auto program = start({});
  EXPECT_EQ(program->ends(), 3) << program->said();
  while (sd_bus_process(bus_, nullptr) > 0) {
  }
  EXPECT_EQ(shown_, "");
}

TEST_F(MenuNotice, IsNotWaitedForWhereTheDesktopHasNone) {
  const auto program = start({std::string(kFromMenu) + "=1"});
  EXPECT_EQ(program->ends(), 3) << program->said();
  EXPECT_THAT(program->said(), HasSubstr("error: "));
  EXPECT_THAT(program->said(), HasSubstr("the desktop cannot show this error"));
}

}  // namespace menu_notice_test
}  // namespace afm::app

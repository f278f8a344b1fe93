// SPDX-License-Identifier: Apache-2.0
#include "app/doctor/diagnosis.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace afm::app {
namespace diagnosis_test {

using ::testing::HasSubstr;

// A machine of a lab that lacks nothing.
MachineFacts good_machine() {
  MachineFacts facts;
  facts.kernel = "6.1.0, PREEMPT_RT";
  facts.priority_limit = 80;
  facts.pages_can_be_locked = true;
  facts.jitter.grant.priority = 80;
  facts.jitter.ticks = 2000;
  facts.jitter.late_us[30] = 2000;
  facts.jitter.max_us = 30;
  facts.graphics = {{"A GPU", "discrete GPU", "its driver 1.0", true, ""}};
  facts.display = "DISPLAY=:0";
  facts.saver = "X's screen saver: suspended, with DPMS; org.freedesktop.ScreenSaver: no session bus";
  facts.saver_stays_off = true;
  facts.render_nodes = {{"/dev/dri/renderD128", true}};
  facts.hid_nodes = {{"/dev/hidraw0", true}};
  facts.haptic_ports = {{"/dev/ttyACM0", "Touch", haptics::HapticBus::Serial, true, "dialout"}};
  facts.haptics = {{"hdapi library libHD.so.3.4", true, "loaded"}, {"hdapi device", true, "Touch"}};
  facts.packages = core::package_system_of("ID=debian\n");
  facts.servo_program = "/usr/bin/touchafm-servo";
  return facts;
}

Finding finding(const MachineFacts& facts, const std::string& check) {
  const auto all = diagnose(facts);
  const auto found = std::find_if(all.begin(), all.end(), [&](const Finding& f) { return f.check == check; });
  return found == all.end() ? Finding{} : *found;
}

TEST(Diagnosis, FindsNothingToFixOnAGoodMachine) {
  const auto findings = diagnose(good_machine());
  EXPECT_GE(findings.size(), 10U);
  for (const Finding& f : findings) {
    EXPECT_EQ(f.verdict, Verdict::Good) << f.check;
    EXPECT_EQ(f.fix, "") << f.check;
    EXPECT_NE(f.found, "") << f.check;
  }
}

TEST(Diagnosis, NamesTheLineThatFixesEachLack) {
  struct Case {
    const char* check;
    Verdict verdict;
    const char* fix;
    void (*spoil)(MachineFacts&);
  };
  const Case cases[] = {
      {"real-time priority", Verdict::Limited, "- rtprio 80\" | sudo tee -a /etc/security/limits.d/touchafm.conf",
       [](MachineFacts& m) { m.jitter.grant.priority = 0; }},
      {"locked memory", Verdict::Limited, "- memlock unlimited\" | sudo tee",
       [](MachineFacts& m) { m.pages_can_be_locked = false; }},
      {"wake-up at 1 kHz", Verdict::Limited, "linux-image-rt-amd64", [](MachineFacts& m) { m.jitter.missed = 1; }},
      {"wake-up at 1 kHz", Verdict::Limited, "linux-image-rt-amd64",
       [](MachineFacts& m) {
         m.jitter.late_us[500] = 10;
         m.jitter.max_us = 500;
       }},
      {"servo program", Verdict::Missing, "touchafm-servo",
       [](MachineFacts& m) { m.missing_program = m.servo_program; }},
      {"graphics", Verdict::Limited, "Vulkan driver", [](MachineFacts& m) { m.graphics[0].kind = "CPU"; }},
      {"graphics", Verdict::Limited, "sudo usermod -aG render,video",
       [](MachineFacts& m) {
         m.graphics[0].kind = "CPU";
         m.render_nodes[0].accessible = false;
       }},
      {"graphics", Verdict::Missing, "Vulkan driver", [](MachineFacts& m) { m.graphics.clear(); }},
      {"display", Verdict::Missing, "DISPLAY=:0", [](MachineFacts& m) { m.display.clear(); }},
      {"display", Verdict::Missing, "DISPLAY=:0",
       [](MachineFacts& m) {
         m.display_refusal = "cannot open it";
         m.saver_stays_off = false;  // nothing to keep off
       }},
      {"headset", Verdict::Limited, "unset XR_RUNTIME_JSON",
       [](MachineFacts& m) {
         m.headset_manifest = "/nonexistent.json";
         m.headset_manifest_exists = false;
       }},
      {"screen saver", Verdict::Limited, "xset s off -dpms", [](MachineFacts& m) { m.saver_stays_off = false; }},
      {"headset", Verdict::Limited, "start the runtime of /etc/xdg/openxr/1/active_runtime.json",
       [](MachineFacts& m) { m.headset_manifest = "/etc/xdg/openxr/1/active_runtime.json"; }},
      {"haptic device", Verdict::Limited, "TOUCHAFM_HD_LIBRARY", [](MachineFacts& m) { m.haptics.clear(); }},
      {"haptic device", Verdict::Limited, "switch it on", [](MachineFacts& m) { m.haptics[1].usable = false; }},
      {"haptic device", Verdict::Limited, "OpenHaptics for a PHANTOM or Touch, a HID one too",
       [](MachineFacts& m) { m.haptics.clear(); }},
      {"system packages", Verdict::Limited, "sudo apt install libsdl2-2.0-0 espeak-ng",
       [](MachineFacts& m) { m.missing_parts = {core::SystemPart::Sdl2, core::SystemPart::EspeakNg}; }},
      {"graphics", Verdict::Missing, "sudo dnf install mesa-vulkan-drivers",
       [](MachineFacts& m) {
         m.packages = core::package_system_of("ID=fedora\n");
         m.graphics.clear();
       }},
      {"haptic port (USB)", Verdict::Missing, "sudo usermod -aG dialout",
       [](MachineFacts& m) { m.haptic_ports[0].accessible = false; }},
      {"haptic port (USB)", Verdict::Missing, "sudo usermod -aG uucp",
       [](MachineFacts& m) {
         m.haptic_ports[0].accessible = false;
         m.haptic_ports[0].group = "uucp";
       }},
      {"haptic port (USB)", Verdict::Missing,
       "echo 'SUBSYSTEM==\"hidraw\", KERNELS==\"*:2988:*\", TAG+=\"uaccess\"' | sudo tee "
       "/etc/udev/rules.d/70-touchafm-haptics.rules && sudo udevadm control --reload",
       [](MachineFacts& m) { m.haptic_ports = {{"/dev/hidraw1", "Touch", haptics::HapticBus::Hid, false, ""}}; }},
      {"wands (HID)", Verdict::Missing, "/etc/udev/rules.d/70-touchafm.rules",
       [](MachineFacts& m) { m.hid_nodes[0].accessible = false; }},
  };
  for (const Case& c : cases) {
    MachineFacts facts = good_machine();
    c.spoil(facts);
    const Finding f = finding(facts, c.check);
    EXPECT_EQ(f.verdict, c.verdict) << c.check;
    EXPECT_THAT(f.fix, HasSubstr(c.fix)) << c.check;
    const auto all = diagnose(facts);
    EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const Finding& any) { return any.verdict != Verdict::Good; }), 1)
        << c.check;
  }
}

TEST(Diagnosis, NamesWhatTheSystemLacksAndItsUse) {
  MachineFacts facts = good_machine();
  facts.missing_parts = {core::SystemPart::VulkanLoader, core::SystemPart::Sdl2};
  EXPECT_EQ(finding(facts, "system packages").found, "missing: the Vulkan loader; SDL2 (gamepads, sound)");
  facts.packages = nullptr;
  EXPECT_EQ(finding(facts, "system packages").fix, "install what Debian calls libvulkan1 libsdl2-2.0-0");
}

TEST(Diagnosis, WantsAShareForDrawingOnlyWhereTheProcessorDraws) {
  MachineFacts facts = good_machine();
  facts.drawing_refused = true;
  EXPECT_EQ(finding(facts, "drawing priority").verdict, Verdict::Good);
  facts.graphics[0].kind = "CPU";
  EXPECT_EQ(finding(facts, "drawing priority").verdict, Verdict::Limited);
  EXPECT_THAT(finding(facts, "drawing priority").fix, HasSubstr("- nice -10\" | sudo tee"));
}

TEST(Diagnosis, TakesNoDeviceForNoLackOfRights) {
  MachineFacts facts = good_machine();
  facts.hid_nodes.clear();
  facts.haptic_ports.clear();
  facts.render_nodes.clear();
  const auto findings = diagnose(facts);
  EXPECT_GE(findings.size(), 10U);
  for (const Finding& f : findings) EXPECT_EQ(f.verdict, Verdict::Good) << f.check;
}

TEST(Diagnosis, SaysThatADeviceIsPluggedInWithoutItsDriver) {
  MachineFacts facts = good_machine();
  facts.haptics.clear();
  facts.haptic_ports = {{"/dev/hidraw1", "Touch", haptics::HapticBus::Hid, true, ""}};
  EXPECT_THAT(finding(facts, "haptic device").found, HasSubstr("although a Touch is plugged in"));
  EXPECT_EQ(finding(facts, "haptic port (USB)").found, "/dev/hidraw1 (Touch, a HID device) can be opened");
}

TEST(Diagnosis, IsContentWithAnyDeviceThatRendersForce) {
  for (const haptics::DeviceKind& kind : haptics::device_kinds()) {
    MachineFacts facts = good_machine();
    facts.haptics = {{"hdapi library libHD.so.3.4", false, "no such file"},
                     {std::string(kind.subject), true, "the device"},
                     {std::string(haptics::simulated_kind().subject), true, "needs no device"}};
    const Finding found = finding(facts, "haptic device");
    EXPECT_EQ(found.verdict, kind.renders_force ? Verdict::Good : Verdict::Limited) << kind.word;
    EXPECT_EQ(found.found == "the device", kind.renders_force) << kind.word;
  }
}

}  // namespace diagnosis_test
}  // namespace afm::app

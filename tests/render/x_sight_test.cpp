// SPDX-License-Identifier: Apache-2.0
#include "output/x_sight.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "support/virtual_display.h"

// behind all others, since its macros spoil their names
#include <X11/Xatom.h>
#include <X11/Xlib.h>

// A window on an X server without a screen, and a window manager that is played by the test.
namespace afm::render {
namespace x_sight_test {

using DisplayPointer = std::unique_ptr<Display, int (*)(Display*)>;

DisplayPointer connect(const std::string& name) { return {XOpenDisplay(name.c_str()), XCloseDisplay}; }

class SightOfAWindow : public ::testing::Test {
 protected:
  SightOfAWindow() {
    ::setenv("DISPLAY", server_.name().c_str(), 1);
    display_ = connect(server_.name());
    root_ = DefaultRootWindow(display_.get());
    window_ = make_window(10, 10, 100, 100);
    XSync(display_.get(), False);  // another connection can select its events
    sight_ = XSight::connect({static_cast<std::uint32_t>(window_)});
    XMapWindow(display_.get(), window_);
  }

  ::Window make_window(int x, int y, unsigned width, unsigned height) const {
    return XCreateSimpleWindow(display_.get(), root_, x, y, width, height, 0, 0, 0);
  }
  Atom atom(const char* name) const { return XInternAtom(display_.get(), name, False); }
  void set(::Window window, const char* property, Atom type, long value) const {
    XChangeProperty(display_.get(), window, atom(property), type, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(&value), 1);
  }
  // State of the window according to the server, after all earlier requests.
  Sight sight() const {
    XSync(display_.get(), False);
    return sight_->look();
  }

  support::VirtualDisplay server_{320, 240};
  DisplayPointer display_{nullptr, XCloseDisplay};
  ::Window root_ = 0, window_ = 0;
  std::unique_ptr<XSight> sight_;
};

TEST_F(SightOfAWindow, EndsWhileItIsNotMapped) {
  ASSERT_NE(sight_, nullptr);
  EXPECT_EQ(sight(), Sight::Seen);
  XUnmapWindow(display_.get(), window_);
  EXPECT_EQ(sight(), Sight::Hidden);
  XMapWindow(display_.get(), window_);
  EXPECT_EQ(sight(), Sight::Seen);
}

TEST_F(SightOfAWindow, EndsWhereAnotherOneCoversItWhole) {
  const ::Window part = make_window(0, 0, 60, 240);
  XMapRaised(display_.get(), part);
  EXPECT_EQ(sight(), Sight::Seen);
  const ::Window rest = make_window(60, 0, 260, 240);
  XMapRaised(display_.get(), rest);
  EXPECT_EQ(sight(), Sight::Covered) << "by two together";
  XUnmapWindow(display_.get(), part);
  EXPECT_EQ(sight(), Sight::Seen);
}

TEST_F(SightOfAWindow, EndsWhereTheWindowManagerHidesIt) {
  set(window_, "_NET_WM_STATE", XA_ATOM, static_cast<long>(atom("_NET_WM_STATE_FULLSCREEN")));
  EXPECT_EQ(sight(), Sight::Seen);
  set(window_, "_NET_WM_STATE", XA_ATOM, static_cast<long>(atom("_NET_WM_STATE_HIDDEN")));
  EXPECT_EQ(sight(), Sight::Hidden);
}

// Without a compositor, a window manager unmaps the windows of other workspaces, and may show two at once.
TEST_F(SightOfAWindow, EndsOnAnotherWorkspaceOfAWindowManagerThatComposites) {
  set(root_, "_NET_CURRENT_DESKTOP", XA_CARDINAL, 0);
  set(window_, "_NET_WM_DESKTOP", XA_CARDINAL, 1);
  set(root_, "_NET_SUPPORTING_WM_CHECK", XA_WINDOW, static_cast<long>(make_window(0, 0, 1, 1)));
  EXPECT_EQ(sight(), Sight::Seen);
  const DisplayPointer other = connect(server_.name());
  const ::Window others = XCreateSimpleWindow(other.get(), root_, 0, 0, 1, 1, 0, 0, 0);
  XSetSelectionOwner(other.get(), XInternAtom(other.get(), "_NET_WM_CM_S0", False), others, CurrentTime);
  XSync(other.get(), False);
  EXPECT_EQ(sight(), Sight::Seen) << "another program composites";
  XSetSelectionOwner(display_.get(), atom("_NET_WM_CM_S0"), make_window(0, 0, 1, 1), CurrentTime);
  EXPECT_EQ(sight(), Sight::Hidden);
  set(window_, "_NET_WM_DESKTOP", XA_CARDINAL, 0xFFFFFFFF);
  EXPECT_EQ(sight(), Sight::Seen) << "on every workspace";
}

TEST_F(SightOfAWindow, EndsOutsideOfTheMonitors) {
  XMoveWindow(display_.get(), window_, 319, 239);
  EXPECT_EQ(sight(), Sight::Seen);
  XMoveWindow(display_.get(), window_, 320, 0);
  EXPECT_NE(sight(), Sight::Seen);
}

TEST_F(SightOfAWindow, EndsWhenTheScreenSaverIsActive) {
  XForceScreenSaver(display_.get(), ScreenSaverActive);
  EXPECT_EQ(sight(), Sight::Blanked);
  XForceScreenSaver(display_.get(), ScreenSaverReset);
  EXPECT_EQ(sight(), Sight::Seen);
}

TEST_F(SightOfAWindow, IsNotLostWithTheServer) {
  server_.die();
  EXPECT_EQ(sight_->look(), Sight::Seen);
  // not closed, because Xlib would end the program; kept reachable, so that it is no leak
  [[maybe_unused]] static Display* const kept = display_.release();
}

}  // namespace x_sight_test
}  // namespace afm::render

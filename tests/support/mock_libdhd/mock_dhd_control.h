// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a test does to the mock of Force Dimension's haptic library. The mock is a shared library of our own that
// exports the functions of the interface and drives devices that exist only in memory; a test loads it as a user's
// library is loaded and links it for these functions.
//
// A program that is started by a test is controlled by its environment: MOCK_DHD_FAULT is missing, hangs or reset;
// MOCK_DHD_SCRIPT names a file for a PersonScript.
extern "C" {

// Everything as if the library had just been loaded: one omega.3 with the serial number 1234, calibrated, its force
// off. Time does not pass until mock_dhd_set_time().
void mock_dhd_reset(void);

// Time of the device's own watchdog; mock_dhd_use_clock() makes it the machine's.
void mock_dhd_set_time(long long ns);
void mock_dhd_use_clock(void);

// This many devices, at most 4, of this type and name; the second has the serial number 1235, and so on.
void mock_dhd_set_devices(int count, int type, const char* name);
void mock_dhd_set_version(int major, int minor);

// In the library's frame: x towards the user, y right, z up.
void mock_dhd_set_position(double x_m, double y_m, double z_m);
void mock_dhd_set_buttons(int mask);
void mock_dhd_set_gripper(int has_gripper);

// Stops the flicker of 0.1 um in the positions, as of a frozen sensor.
void mock_dhd_hold_still(void);

// The next `times` calls of this function (any negative number: all) fail with this error.
void mock_dhd_fail(const char* function, int error, int times);

// The next `times` calls of this function do their work and return `value`; dhdGetPosition then gives the old place.
void mock_dhd_answer(const char* function, int value, int times);

// The device's status: powered, connected, in reset mode, failed. A device in reset mode has no current.
void mock_dhd_set_power(int on);
void mock_dhd_set_connected(int on);
void mock_dhd_set_reset(int on);
void mock_dhd_set_failed(int on);

// Reset mode ends by itself after this number of forces, as a Falcon's does.
void mock_dhd_end_reset_after(int forces);

// The device takes this long to switch its force on, once it is asked to.
void mock_dhd_delay_force_mode(int ms);

// The device itself leaves force mode for this cause (1: its button, 2: velocity, 6: dead-man switch, 0: none).
void mock_dhd_cut_force(int cause);

// The user presses the force button: force mode with the last force, without any call.
void mock_dhd_press_force_button(void);

// The cable is pulled: every call for the device fails from now on.
void mock_dhd_unplug(void);

// dhdGetPosition does not come back while this is set.
void mock_dhd_block(int blocked);

// Number of calls that wait there.
int mock_dhd_caught(void);

// The force on the hand now, in the library's frame: the last one that was set, nothing outside force mode.
void mock_dhd_force(double newtons[3]);
int mock_dhd_brakes(void);

// Calls that shape the life of a device, in order: "open", "close", "force_on", "force_off", "brakes_on", "brakes_off".
// Null past the end.
const char* mock_dhd_call(int index);

// The limit of the library, the watchdog's time and whether gravity is compensated, as they were last set.
double mock_dhd_max_force(void);
long long mock_dhd_watchdog_ns(void);
int mock_dhd_gravity(void);

// The first use of the interface that no driver may make, and null while there is none: a device that is not open, a
// force that is no number or larger than 2 N, a torque, a call that ends reset mode, an expert's call outside expert
// mode, a device that is closed with its force on or its brakes off.
const char* mock_dhd_violation(void);
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Control of the mock of Force Dimension's haptic library by a test. The mock is a shared library of our own that
// exports the functions of the interface and drives devices that exist only in memory; a test loads it as a user's
// library is loaded and links it for these functions.
//
// A program that is started by a test is controlled by its environment: MOCK_DHD_FAULT is missing, hangs or reset;
// MOCK_DHD_SCRIPT names a file for a PersonScript.
extern "C" {

// Resets to the state after loading the library: one omega.3 with the serial number 1234, calibrated, its force
// off. Time does not pass until mock_dhd_set_time().
void mock_dhd_reset(void);

// Sets the time of the device's own watchdog; mock_dhd_use_clock() makes it follow the machine's clock.
void mock_dhd_set_time(long long ns);
void mock_dhd_use_clock(void);

// Provides this many devices, at most 4, of this type and name; the second has the serial number 1235, and so on.
void mock_dhd_set_devices(int count, int type, const char* name);
void mock_dhd_set_version(int major, int minor);

// Sets the position in the library's frame: x towards the user, y right, z up.
void mock_dhd_set_position(double x_m, double y_m, double z_m);
void mock_dhd_set_buttons(int mask);
void mock_dhd_set_gripper(int has_gripper);

// Stops the flicker of 0.1 um in the positions, like a frozen sensor.
void mock_dhd_hold_still(void);

// Makes the next `times` calls of this function (any negative number: all) fail with this error.
void mock_dhd_fail(const char* function, int error, int times);

// Makes the next `times` calls of this function work and return `value`; dhdGetPosition then gives the old place.
void mock_dhd_answer(const char* function, int value, int times);

// Sets the device's status: powered, connected, in reset mode, failed. A device in reset mode has no current.
void mock_dhd_set_power(int on);
void mock_dhd_set_connected(int on);
void mock_dhd_set_reset(int on);
void mock_dhd_set_failed(int on);

// Makes reset mode end by itself after this number of forces, like a Falcon's.
void mock_dhd_end_reset_after(int forces);

// Delays the start of the force by this time after the request.
void mock_dhd_delay_force_mode(int ms);

// Makes the device leave force mode for this cause (1: its button, 2: velocity, 6: dead-man switch, 0: none).
void mock_dhd_cut_force(int cause);

// Presses the force button: force mode with the last force, without any call.
void mock_dhd_press_force_button(void);

// Pulls the cable: every call for the device fails from now on.
void mock_dhd_unplug(void);

// Blocks dhdGetPosition while this is set.
void mock_dhd_block(int blocked);

// Number of calls blocked there.
int mock_dhd_caught(void);

// Current force on the hand, in the library's frame: the last one that was set, zero outside force mode.
void mock_dhd_force(double newtons[3]);
int mock_dhd_brakes(void);

// Calls that shape the life of a device, in order: "open", "close", "force_on", "force_off", "brakes_on", "brakes_off".
// Null past the end.
const char* mock_dhd_call(int index);

// Latest settings of the library's limit, the watchdog's time, and gravity compensation.
double mock_dhd_max_force(void);
long long mock_dhd_watchdog_ns(void);
int mock_dhd_gravity(void);

// First use of the interface that no driver may make; null while there is none: a device that is not open, a
// force that is no number or larger than 2 N, a torque, a call that ends reset mode, an expert's call outside expert
// mode, a device that is closed with its force on or its brakes off.
const char* mock_dhd_violation(void);
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

// Test control of the mock of the vendor's haptic library. The mock is a shared library of our own that exports the
// 36 functions of the interface and drives a stylus that exists only in memory; a test loads it as a user's library is
// loaded and links it for these functions.
//
// A program that is started by a test is controlled by its environment: MOCK_HD_FAULT is missing, busy, hangs or
// uncalibrated; MOCK_HD_SCRIPT names a file of lines "seconds x_mm y_mm z_mm buttons", which the stylus follows by
// straight paths from the start of the scheduler, again and again. Both imply a scheduler thread.
extern "C" {

// Resets to the state after loading the library, with a scheduler that runs only in mock_hd_tick(). Any scheduler
// thread must have been stopped.
void mock_hd_reset(void);

// Makes the scheduler a thread of 1 kHz from its next start on.
void mock_hd_use_thread(void);

// Runs one period of the scheduler in the caller's thread: the callbacks run once if it runs and does not stall.
void mock_hd_tick(void);

void mock_hd_set_position(double x_mm, double y_mm, double z_mm);
void mock_hd_set_buttons(int buttons);

// Stops the flicker of 0.1 um in the positions, like a frozen sensor.
void mock_hd_hold_still(void);

// The next `times` calls of hdInitDevice with this name (null: the default) fail with this error; with "*" any name's.
void mock_hd_fail_init(const char* name, unsigned error, int times);

// Makes hdGetError return this error; a lost device stays lost.
void mock_hd_push_error(unsigned error);

// Sets the result of hdCheckCalibration. hdUpdateCalibration ends a needed update.
void mock_hd_set_calibration(unsigned status);

// Sets the first number that hdGetDoublev returns for this property.
void mock_hd_set_limit(unsigned property, double value);

// Makes the first motor's temperature NaN from now on; the second has the value set for the property.
void mock_hd_break_first_sensor(void);

// Stops the calls of the scheduler's callbacks, as if the driver hung.
void mock_hd_stall(int stalled);

// Current force on the hand, as from a real driver: the last one that was set, zero while the output is off or
// the scheduler stopped.
void mock_hd_force(double newtons[3]);

// Calls that shape the life of a device, in order: "init", "start", "stop", "unschedule", "disable_device",
// "output_on", "output_off", "update_calibration". Null past the end.
const char* mock_hd_call(int index);

// First use of the interface that the real library forbids; null while there is none: a place or a force
// outside a frame or the scheduler's thread, unpaired frames, a force that is no number, a calibration with the force
// on, a device that is released while its scheduler runs.
const char* mock_hd_violation(void);
}

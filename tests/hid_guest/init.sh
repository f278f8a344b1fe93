#!/bin/busybox sh
# The first process of the guest.
/bin/busybox mount -t proc none /proc
/bin/busybox mount -t sysfs none /sys
/bin/busybox mount -t devtmpfs none /dev
for module in hid hid-generic uhid; do /bin/busybox insmod /modules/$module.ko; done
/session
/bin/busybox poweroff -f

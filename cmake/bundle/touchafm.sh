#!/bin/sh
# bin/touchafm of the bundle: starts the program of the folder in which this file lies, or the one that a link to it names.
self=$(readlink -f "$0")
programs=${self%/bin/*}/libexec/touchafm
# without /proc, the loader learns from this variable where the program and so its libraries lie (man 8 ld.so)
[ -e /proc/self/exe ] || export LD_ORIGIN_PATH="$programs"
exec "$programs/touchafm" "$@"

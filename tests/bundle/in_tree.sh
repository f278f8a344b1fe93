#!/usr/bin/env bash
# usage: in_tree.sh alone|use|lacks COMMAND   what run.sh does within a bare tree, as a user without rights
set -euo pipefail
touchafm="/opt/some folder/touchafm/bin/touchafm"
fail() { echo "error: $*" >&2; exit 1; }
cd /home/visitor
umask 022

# a machine that stands still releases the hand again and again: then as a person would
demonstrate() {
  local status try
  for try in 1 2 3; do
    status=0
    "$touchafm" demo "$@" 2>messages || status=$?
    if [ "$status" = 0 ] || ! grep -qE 'with less load on the machine|more than 20 ms late' messages; then break; fi
    echo "the servo came too late ($try of 3)"
  done
  [ "$status" = 0 ] || { cat messages >&2; fail "demo ended with $status"; }
}

# the command that doctor prints for what this system lacks
lacks() { "$touchafm" doctor --seconds 0.1 | grep -x "  system packages: $1" || fail "doctor does not say: $1"; }

case $1 in
  alone)
    [ ! -e /proc/self ] && [ -z "${HOME:-}" ] || fail "there is a /proc or a HOME"
    "$touchafm" --version
    "$touchafm" curve --material gold --out alone.h5
    "$touchafm" analyse alone.h5 | grep -q pull-off || fail "no curve from HDF5"
    "$touchafm" render --journey 5 --material mica --eye-width 160 --out alone.png
    [ -s alone.png ] || fail "no picture"
    demonstrate --out alone --material mica --hand-speed 200mm/s --eye-width 160
    ;;
  use)
    PATH=$PATH:/home/visitor touchafm --version # a link
    "$touchafm" doctor --seconds 0.5
    lacks "sudo apt install libx11-xcb1 libxcursor1 libxi6 libxinerama1 libxrandr2 libsdl2-2.0-0 espeak-ng"
    "$touchafm" curve --material gold --out gold.h5
    "$touchafm" analyse gold.h5 | grep -q pull-off || fail "no curve from HDF5"
    "$touchafm" wall "/opt/some folder/touchafm/share/touchafm/walls/powerwall.toml" >/dev/null
    demonstrate --out out
    for file in report.html fig5a.png curve-gold.csv summary.json; do
      [ -s "out/$file" ] || fail "demo left no $file"
    done

    mkdir -p screen
    Xvfb -displayfd 3 -screen 0 1280x720x24 -fbdir screen -nolisten tcp -noreset 3>display 2>/dev/null &
    server=$!
    for _ in $(seq 100); do
      [ -s display ] && break
      sleep 0.1
    done
    [ -s display ] || fail "Xvfb does not start"
    DISPLAY=:$(cat display)
    export DISPLAY
    "$touchafm" view --frame-log frames.csv --size 1280x720 2>view.log &
    window=$!
    for _ in $(seq 300); do
      [ "$(wc -l <frames.csv 2>/dev/null || echo 0)" -gt 20 ] && break
      kill -0 $window 2>/dev/null || { cat view.log >&2; fail "view ended"; }
      sleep 0.2
    done
    [ "$(wc -l <frames.csv)" -gt 20 ] || { cat view.log >&2; fail "view draws no frames"; }
    cp screen/Xvfb_screen0 shown
    mv shown screen/Xvfb_screen0.shown
    kill -TERM $window
    wait $window || echo "view ended with $?"
    kill $server
    wait $server || true
    mv screen/Xvfb_screen0.shown screen/Xvfb_screen0
    ;;
  lacks) lacks "$2" ;;
esac

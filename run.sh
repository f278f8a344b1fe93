#!/usr/bin/env bash
# Sets TouchAFM up on Debian 12 or 13, builds it, and runs the main job: `touchafm demo --out out`.
# Arguments are passed on to the demo, for example: ./run.sh --out /tmp/afm
set -euo pipefail
cd "$(dirname "$0")"

scripts/install-packages
scripts/build release touchafm touchafm-bench touchafm-guard touchafm-hdf5 touchafm-servo
if [ $# -eq 0 ]; then set -- --out out; fi
exec build/release/bin/touchafm demo "$@"

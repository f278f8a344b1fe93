#!/usr/bin/env bash
# Sets TouchAFM up on Debian 12 or 13, builds it with its tests, and runs them. Arguments are passed on to ctest.
set -euo pipefail
cd "$(dirname "$0")"

scripts/install-packages
scripts/build release
exec scripts/run-tests release "$@"

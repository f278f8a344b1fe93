#!/usr/bin/env bash
# usage: with_pseudo_terminals.sh COMMAND [ARGUMENT ...]
# Runs COMMAND where pseudo-terminals can be opened: umockdev makes its device nodes of them, and a bare chroot has none mounted.
set -euo pipefail

[ ! -e /dev/pts/ptmx ] || exec "$@"
as_root=()
[ "$(id -u)" = 0 ] || as_root=(--map-root-user)
# seen by COMMAND alone, and gone with it; in a chroot whose root is no mount the propagation cannot be changed
private=(unshare "${as_root[@]}" --mount)
"${private[@]}" true 2>/dev/null || private+=(--propagation unchanged)
exec "${private[@]}" -- bash -c '
  mount -t devpts -o newinstance,ptmxmode=0666 devpts /dev/pts
  mount --bind /dev/pts/ptmx /dev/ptmx
  exec "$@"' with_pseudo_terminals "$@"

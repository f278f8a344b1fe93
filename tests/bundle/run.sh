#!/usr/bin/env bash
# usage: run.sh SOURCE CACHE-FOLDER
# Makes the bundle (scripts/bundle), and uses it in bare trees of Debian 12 and 13 with Mesa and Xvfb alone, as a user without rights. The trees come from
# Debian's archive, once, into CACHE-FOLDER; the picture of each window is left there.
set -euo pipefail
source=$1
cache=$2
here=$(cd "$(dirname "$0")" && pwd)
fail() { echo "error: $*" >&2; exit 1; }

[ "$(id -u)" = 0 ] || fail "not root, whom chroot needs; run: sudo ctest --preset deep -R bundle"
for tool in debootstrap unshare chroot objdump python3; do
  command -v "$tool" >/dev/null || fail "$tool is missing; run: scripts/install-packages scripts/ci-packages.txt"
done
# the mounts below go with a namespace of this script's own
[ "${OWN_MOUNTS:-}" = 1 ] || exec env OWN_MOUNTS=1 unshare --mount --propagation private "$0" "$@"

step() { echo "== after $SECONDS s: $*"; }
step the bundle
summary=$("$source/scripts/bundle" | tail -n 1)
echo "$summary"
archive=$source/${summary%%: *}
[ -s "$archive" ] || fail "scripts/bundle printed no path"
made=$(dirname "$archive")
name=$(basename "$archive" .tar.xz)
[ "$(stat -c %s "$archive")" -le $((40 * 1048576)) ] || fail "the bundle has more than 40 MiB"

step what it names
[ -z "$(tar -tvf "$archive" | awk '$2 != "0/0"')" ] || fail "the archive names an owner"
LC_ALL=C tar -tf "$archive" >"$made/names"
LC_ALL=C sort -c <(sed 's,/$,,' "$made/names" | tr / '\001') || fail "the archive is not sorted"
# a hole in the table is found, and so is a row too many
table=$source/cmake/bundle/libraries.txt
sed '/libglfw/d' "$table" >"$made/short"
"$source/scripts/bundled-libraries" "$made/short" "$made/libraries" "$made/$name/libexec/touchafm/touchafm" 2>"$made/said" &&
  fail "a library that nobody knows was not found"
grep -q 'touchafm needs libglfw.so.3, which is neither bundled nor' "$made/said" || fail "not named: $(cat "$made/said")"
sed '$abundled libnothing.so.1' "$table" >"$made/long"
"$source/scripts/bundled-libraries" "$made/long" "$made/libraries" "$made/$name"/libexec/touchafm/* 2>"$made/said" &&
  fail "a library that nothing needs was not found"
grep -q 'nothing needs libnothing.so.1' "$made/said" || fail "not named: $(cat "$made/said")"
# each program has its C++ library inside, and the oldest glibc will do
for program in "$made/$name"/libexec/touchafm/*; do
  if objdump -p "$program" | grep -E 'NEEDED *(libstdc|libgcc|libfmt|libhdf5|libcurl)'; then fail "${program##*/} needs the above"; fi
done
newest=$(objdump -T "$made/$name"/libexec/touchafm/* "$made/$name"/lib/touchafm/* | grep -o 'GLIBC_2\.[0-9]*' | sort -uV | tail -n 1)
[ "$(printf '%s\n' GLIBC_2.35 "$newest" | sort -V | tail -n 1)" = GLIBC_2.35 ] || fail "it needs $newest"

mkdir -p "$cache"
mirror=$(sed -n -e 's/^URIs: *\([^ ]*\).*/\1/p' /etc/apt/sources.list.d/*.sources 2>/dev/null | head -n 1)
[ -n "$mirror" ] || mirror=$(sed -n -e 's/^deb  *\(\[[^]]*\] *\)\?\([^ ]*\).*/\2/p' /etc/apt/sources.list | head -n 1)
work=$(mktemp -d "$cache/tree.XXXXXX")
trap 'umount -R -l "$work"/*/* 2>/dev/null || true; rm -rf --one-file-system "$work"' EXIT

# In the tree $1, as its visitor, with the environment $2: in_tree.sh $3 ...
in_tree() {
  local tree=$1 environment=$2
  shift 2
  # shellcheck disable=SC2086  # a list of NAME=VALUE
  chroot --userspec=1000:1000 "$tree" /usr/bin/env -i PATH=/usr/bin:/bin LC_ALL=C.UTF-8 $environment bash /in_tree.sh "$@" </dev/null
}

for suite in bookworm trixie; do
  bare=$cache/$suite.tar
  if [ ! -s "$bare" ]; then
    step "a bare $suite"
    debootstrap --variant=minbase --include=mesa-vulkan-drivers,libvulkan1,xvfb "$suite" "$work/new" "$mirror" >"$cache/debootstrap.log" ||
      { tail -n 20 "$cache/debootstrap.log" >&2; fail "debootstrap made no $suite from $mirror"; }
    rm -rf "$work"/new/var/cache/apt/archives/*.deb
    tar -C "$work/new" -cf "$bare.part" .
    mv "$bare.part" "$bare"
    rm -rf --one-file-system "$work/new"
  fi
  step "$suite"
  tree=$work/$suite
  mkdir "$tree"
  tar -C "$tree" -xf "$bare"
  chmod 755 "$tree"
  cp "$here/in_tree.sh" "$tree/"
  # moved after it was unpacked, into a folder with a blank
  mkdir -p "$tree/opt/some folder" "$tree/home/visitor"
  tar -C "$tree/opt" -xf "$archive"
  mv "$tree/opt/$name" "$tree/opt/some folder/touchafm"
  ln -s "../../opt/some folder/touchafm/bin/touchafm" "$tree/home/visitor/touchafm"
  chown -h 1000:1000 "$tree/home/visitor" "$tree/home/visitor/touchafm"
  mount --rbind /dev "$tree/dev"
  mount -t tmpfs shm "$tree/dev/shm"
  [ -z "$(find "$tree/usr/share/fonts" -name '*.[ot]tf' 2>/dev/null)" ] || fail "the bare tree has fonts"

  step "$suite: without /proc, fonts and HOME"
  in_tree "$tree" "" alone
  mount -t proc proc "$tree/proc"
  step "$suite: as a visitor"
  in_tree "$tree" HOME=/home/visitor use
  python3 "$here/window_picture.py" "$tree/home/visitor/screen/Xvfb_screen0" "$cache/$suite.png"
done
step "other distributions"
for row in "fedora:sudo dnf install .* SDL2 espeak-ng" "arch:sudo pacman -S .* sdl2 espeak-ng" "opensuse-leap:sudo zypper install .* libSDL2-2_0-0 espeak-ng"; do
  rm -f "$work/trixie/etc/os-release"
  echo "ID=${row%%:*}" >"$work/trixie/etc/os-release"
  in_tree "$work/trixie" HOME=/home/visitor lacks "${row#*:}"
done
step "it works: $summary"

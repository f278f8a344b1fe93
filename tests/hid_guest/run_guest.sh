#!/usr/bin/env bash
# usage: run_guest.sh PROGRAM CACHE-FOLDER
# Boots Debian's kernel in a virtual machine without acceleration (a host's /dev/kvm is not to be trusted to run a
# guest), with PROGRAM in its initramfs, and returns 0 if it says "session passed". The kernel and busybox come from
# Debian's archive, once, into CACHE-FOLDER.
set -euo pipefail
program=$1
cache=$2
here=$(cd "$(dirname "$0")" && pwd)

for tool in qemu-system-x86_64 apt-get dpkg-deb gzip; do
  command -v "$tool" >/dev/null || { echo "error: $tool is missing; install qemu-system-x86, apt and dpkg" >&2; exit 1; }
done

mkdir -p "$cache"
cd "$cache"
if [ ! -f ready ]; then
  kernel=$(apt-cache depends linux-image-cloud-amd64 | sed -n 's/.*Depends: \(linux-image-[0-9].*\)/\1/p' | head -n 1)
  [ -n "$kernel" ] || { echo "error: apt knows no linux-image-cloud-amd64; run apt-get update" >&2; exit 1; }
  rm -rf root ./*.deb
  apt-get download "$kernel" busybox-static
  for package in ./*.deb; do dpkg-deb -x "$package" root; done
  touch ready
fi
kernel=$(echo root/boot/vmlinuz-*)
modules=$(echo root/lib/modules/*)

# the initramfs: busybox, three modules, the program and the libraries that it names
image=$(mktemp -d)
trap 'rm -rf "$image"' EXIT
mkdir -p "$image"/{bin,proc,sys,dev,run,modules}
cp root/bin/busybox "$image/bin/"
for module in hid/hid hid/hid-generic hid/uhid; do
  cp "$modules/kernel/drivers/$module.ko" "$image/modules/"
done
cp "$program" "$image/session"
cp "$here/init.sh" "$image/init"
chmod +x "$image/init"
ldd "$program" | grep -o '/[^ ]*' | while read -r library; do
  mkdir -p "$image$(dirname "$library")"
  cp -L "$library" "$image$library"
done
(cd "$image" && find . | "$OLDPWD/root/bin/busybox" cpio -o -H newc 2>/dev/null | gzip -1) >initramfs.gz

timeout 100 qemu-system-x86_64 -accel tcg,thread=multi -cpu max -m 256 -smp 1 -no-reboot -nographic -nodefaults \
  -serial file:guest.log -kernel "$kernel" -initrd initramfs.gz -append "console=ttyS0 quiet panic=-1" </dev/null ||
  echo "the virtual machine did not end by itself"
cat guest.log
grep -q '^session passed' guest.log

#!/bin/sh
# Installs the packages in a Debian 12 that has nothing else, takes the first steps there, and purges them:
# fresh_root.sh DEBS WORK. It needs root, debootstrap and a network, and leaves the root in WORK for the next time.
set -eux
here=$(dirname "$0") debs=$1 root=$2/root
test -d "$root" || debootstrap --variant=minbase bookworm "$root"
in_root() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive sh -euxc "$1"
}
rm -rf "$root/debs" "$root/work"
mkdir "$root/debs" "$root/work"
cp "$debs"/*.deb "$here/first_steps.sh" "$root/debs"
mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT
in_root 'apt-get update
apt-get install -y --no-install-recommends /debs/*.deb
dpkg --audit
apt-get install -y --no-install-recommends python3-matplotlib python3-pandas python3-pytest  # recommended or suggested
cd /work && sh /debs/first_steps.sh /usr
apt-get purge -y lobelia liblobelia0 liblobelia-dev python3-lobelia lobelia-doc
rm -r /debs /work'
left=$(find "$root" -xdev -name '*lobelia*' -not -path '*/apt/*')
test -z "$left"

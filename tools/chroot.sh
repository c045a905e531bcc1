#!/usr/bin/env bash
# Runs a command on current R (4.5), in a copy of the project inside a Debian trixie chroot:
#   tools/chroot.sh make test
#   CRESTLINE_SUITE=bookworm tools/chroot.sh make test     (R 4.2 on a bare machine)
# The chroot is made once and kept in $CRESTLINE_CACHE. It starts with make and git only: the project's own
# set-up does the rest. Everything is mounted in a private namespace, which dies with this script: nothing to unmount.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh

SUITE=${CRESTLINE_SUITE:-trixie}
CACHE=${CRESTLINE_CACHE:-/var/tmp/crestline}
ROOT=$CACHE/$SUITE

require_root() {
  [ "$(id -u)" -eq 0 ] || die "the chroot needs root"
  unshare --mount --pid --fork --kill-child true 2>/dev/null || die "this machine allows no mount namespace: no chroot"
}

install_debootstrap() {
  command -v debootstrap >/dev/null && return
  command -v apt-get >/dev/null || die "debootstrap is not here, and no apt-get to get it"
  apt-get -o DPkg::Lock::Timeout=600 update
  DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends -o DPkg::Lock::Timeout=600 debootstrap
}

mirror() {
  local uri
  uri=$(awk '/^URIs:/ { print $2; exit }' /etc/apt/sources.list.d/debian.sources 2>/dev/null || true)
  echo "${uri:-http://deb.debian.org/debian}"
}

# What the machine has to reach the network: names, certificates, apt's own settings.
carry_over() {
  local target=$1
  cp -L /etc/resolv.conf /etc/hosts "$target/etc/"
  mkdir -p "$target/usr/local/share/ca-certificates"
  cp /usr/local/share/ca-certificates/*.crt "$target/usr/local/share/ca-certificates/" 2>/dev/null || true
  cp /etc/apt/apt.conf.d/99* "$target/etc/apt/apt.conf.d/" 2>/dev/null || true
  printf '#!/bin/sh\nexit 101\n' > "$target/usr/sbin/policy-rc.d"
  chmod +x "$target/usr/sbin/policy-rc.d"
}

# One whose set-up was cut short is made anew: it may hold half-installed packages.
make_chroot() {
  local fresh=$ROOT.fresh
  rm -rf --one-file-system "$fresh" "$ROOT"
  step "debootstrap" install_debootstrap
  step "Debian $SUITE from $(mirror)" debootstrap --variant=minbase --include=make,git "$SUITE" "$fresh" "$(mirror)"
  mv "$fresh" "$ROOT"
}

mount_all() {
  mount -t proc proc "$ROOT/proc"
  for place in sys dev dev/pts dev/shm; do
    mkdir -p "$ROOT/$place"
    mount --bind "/$place" "$ROOT/$place"
  done
}

copy_project() {
  rm -rf --one-file-system "$ROOT/build"
  mkdir -p "$ROOT/build/crestline"
  copy_tree "$ROOT/build/crestline"
  if [ -d ../shared ]; then
    mkdir "$ROOT/build/shared"
    mount --bind -o ro "$(realpath ../shared)" "$ROOT/build/shared"
  fi
}

inside() {
  chroot "$ROOT" env -u R_LIBS -u R_LIBS_USER -u CRESTLINE_LIB -u CRESTLINE_SHARED -u MAKEFLAGS -u MAKELEVEL \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root TMPDIR=/tmp LC_ALL=C.UTF-8 \
    sh -c 'cd /build/crestline && exec "$@"' sh "$@" 9>&-
}

[ $# -gt 0 ] || die "usage: tools/chroot.sh COMMAND..."
if [ -z "${CRESTLINE_NAMESPACE:-}" ]; then
  require_root
  exec unshare --mount --propagation private --pid --fork --kill-child env CRESTLINE_NAMESPACE=yes tools/chroot.sh "$@"
fi
mkdir -p "$CACHE"
exec 9> "$CACHE/$SUITE.lock"
flock --nonblock 9 || { say "==> waiting for another run in $CACHE"; flock 9; }
[ -e "$ROOT/ready" ] || make_chroot
mount_all
carry_over "$ROOT"
copy_project
[ -e "$ROOT/ready" ] || { inside tools/setup.sh; touch "$ROOT/ready"; }
say "==> in Debian $SUITE: $*"
inside "$@"

# shellcheck shell=bash disable=SC2154 # root and cache are those of common.sh
# Bare Debian systems to build and test in: sourced after common.sh, not run. Needs root.
#
# They are kept in the cache; the system that the scripts run on gets no package but debootstrap.

# The mirror of Debian that the system is installed from.
debian_mirror()
{
    local mirror
    mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' 'Origin: Debian' |
        awk '$2 !~ /-/ {print $1; exit}')
    [ -n "$mirror" ] || die "apt has no source of Debian configured; 'apt-get update' may help"
    echo "$mirror"
}

# Makes a bare system of a release, unless it exists.
# usage: make_chroot DIRECTORY RELEASE LOG [APT_SOURCE_RELEASE...]
make_chroot()
{
    local directory=$1 release=$2 log=$3 mirror extra
    shift 3
    [ ! -e "$directory/complete" ] || return 0
    [ "$(id -u)" -eq 0 ] || die "a chroot needs root"
    install_packages "$log.install" debootstrap
    step "Making a bare Debian $release in $directory"
    mirror=$(debian_mirror)
    rm -rf --one-file-system "$directory"
    mkdir -p "$directory"
    logged "$log" debootstrap --variant=minbase --include=ca-certificates "$release" "$directory" "$mirror"
    : >"$directory/etc/apt/sources.list"
    for extra in "$release" "$@"; do
        echo "deb $mirror $extra main" >>"$directory/etc/apt/sources.list"
    done
    {
        echo 'APT::Install-Recommends "false";'
        echo 'Acquire::Languages "none";'
        # A mirror that is a snapshot of Debian has lists older than they say they may be: it is for the system to allow
        # that.
        apt-config dump --format 'Acquire::Check-Valid-Until "%v";%n' Acquire::Check-Valid-Until
    } >"$directory/etc/apt/apt.conf.d/bare"
    printf '#!/bin/sh\nexit 101\n' >"$directory/usr/sbin/policy-rc.d"
    chmod +x "$directory/usr/sbin/policy-rc.d"
    touch "$directory/complete"
}

# Runs a command in the system, with the checkout at /src, read-only. The mounts are seen by the command alone and go
# with it.
# usage: in_chroot DIRECTORY COMMAND...
in_chroot()
{
    local directory=$1
    shift
    mkdir -p "$directory/src"
    cp -L /etc/resolv.conf "$directory/etc/resolv.conf"
    unshare --mount --propagation private bash -c '
        set -e
        directory=$1 root=$2
        shift 2
        mount -t proc proc "$directory/proc"
        mount --rbind /dev "$directory/dev"
        mount --rbind /sys "$directory/sys" # has the processors, without which OpenCL finds no device
        mount --bind "$root" "$directory/src"
        mount -o remount,bind,ro "$directory/src"
        exec chroot "$directory" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
            TERM=dumb DEBIAN_FRONTEND=noninteractive \
            ${CMAKE_BUILD_PARALLEL_LEVEL:+CMAKE_BUILD_PARALLEL_LEVEL=$CMAKE_BUILD_PARALLEL_LEVEL} "$@"
    ' in_chroot "$directory" "$root" "$@"
}

#!/bin/bash
# Builds the module with a version of OpenCV, against an installed one and inside of its source, and runs the tests.
#
# The installed version is used as it is. Others are taken from the release of Debian that has them, in a bare system in
# the cache.
# Exit status: 0 all was built and has passed, 3 all that could be built has passed, but the mirror doesn't have
# OpenCV's source, so that there is no build inside of it and opencv_ts comes from another version; 1 otherwise.
# usage: build_with_opencv.sh VERSION

. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/chroot.sh"
[ $# -eq 1 ] || die "usage: build_with_opencv.sh VERSION, such as 4.10.0"
version=$1

installed=$(dpkg-query -W -f='${source:Upstream-Version}' libopencv-dev 2>/dev/null) || installed=
if [ "${installed%%+*}" = "$version" ]; then
    exec "$root/test/run_tests.sh" "$cache/build-$version"
fi

# The release of Debian, and the one that OpenCV comes from.
case $version in
    4.6.0) release=bookworm from=bookworm ;;
    4.10.0) release=trixie from=trixie ;;
    5.0.0) release=sid from=experimental ;;
    *) die "VERSION is $version; 4.6.0, 4.10.0 or 5.0.0 is expected: the versions that releases of Debian have" ;;
esac
system=$cache/debian-$from
logs=$cache/logs-$version
others=()
[ $from = $release ] || others=("$from")
make_chroot "$system" $release "$logs/debootstrap.log" "${others[@]}"
if [ $from != $release ]; then
    printf 'Package: src:opencv\nPin: release a=%s\nPin-Priority: 990\n' $from >"$system/etc/apt/preferences.d/opencv"
fi

step "Installing OpenCV in $system"
logged "$logs/apt-update.log" in_chroot "$system" apt-get update
logged "$logs/apt-install.log" in_chroot "$system" apt-get install -y "${packages_build[@]}" "${packages_test[@]}"
found=$(in_chroot "$system" dpkg-query -W -f='${source:Upstream-Version}' libopencv-dev)
[ "${found%%+*}" = "$version" ] || die "Debian $from has OpenCV $found, not $version"

if in_chroot "$system" /src/scripts/get_opencv_source.sh >"$logs/source.log" 2>&1; then
    in_chroot "$system" /src/test/run_tests.sh /build
    exit
fi
tail -n 1 "$logs/source.log" >&2

# The version of the package in sid.
step "Without the source of OpenCV $version: opencv_ts of another version, and no build inside of OpenCV"
ts=$(in_chroot "$system" /src/scripts/get_opencv_source.sh 4.10.0+dfsg-9)
in_chroot "$system" /src/test/run_tests.sh --ts-source="$ts" /build
exit 3

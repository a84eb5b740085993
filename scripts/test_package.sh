#!/bin/bash
# Makes the Debian packages, installs them in a bare system, uses them and removes them again. Needs root.
#
# The programs must run with what their packages depend on, test/consumer must build with CMake and with pkg-config, and
# after the removal no file may be left.
# usage: test_package.sh [RELEASE]    of the system that the packages are built on; default: its own one

. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/chroot.sh"
release=${1:-$(. /etc/os-release && echo "$VERSION_CODENAME")}
logs=$cache/logs-package
build=$cache/build-package

install_packages "$logs/apt-install.log" "${packages_build[@]}" dpkg-dev file
use_ccache "$root"
step "Making the packages in $build"
rm -rf "$build"
logged "$logs/configure.log" cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DCMAKE_INSTALL_PREFIX=/usr -DENABLE_WERROR=ON
logged "$logs/build.log" cmake --build "$build"
(cd "$build" && logged "$logs/cpack.log" cpack -G DEB)
for package in "$build"/*.deb; do
    echo "$(basename "$package"): $(dpkg-deb -f "$package" Depends)"
done

bare=$cache/debian-$release
make_chroot "$bare" "$release" "$logs/debootstrap.log"
system=$cache/package-$release
rm -rf --one-file-system "$system"
trap 'rm -rf --one-file-system "$system"' EXIT
cp -a --reflink=auto "$bare" "$system"
mkdir "$system/packages"
cp "$build"/*.deb "$system/packages"

step "Installing the programs in a bare Debian $release"
logged "$logs/update.log" in_chroot "$system" apt-get update
logged "$logs/install-programs.log" in_chroot "$system" sh -c \
    'apt-get install -y /packages/libopencv-rsackermann[0-9]*.deb /packages/rsackermann_*.deb'
logged "$logs/programs.log" in_chroot "$system" sh -ec '
    cd /tmp
    rsackermann_simulate --output=street --speed=60 --yaw_rate=40 --seed=3
    rsackermann_correct street/rolling.png --camera=street/camera.yml --output=corrected.png --report=report.jsonl
    grep "\"status\":\"ok\"" report.jsonl
    test -s corrected.png'

step "Building a project that uses the library"
logged "$logs/install-development.log" in_chroot "$system" sh -c \
    'apt-get install -y g++ cmake make pkg-config /packages/libopencv-rsackermann-dev_*.deb'
logged "$logs/consumer.log" in_chroot "$system" sh -ec '
    cmake -S /src/test/consumer -B /tmp/consumer
    cmake --build /tmp/consumer
    /tmp/consumer/rsackermann_consumer
    /src/test/consumer/build_with_pkg_config.sh c++ /tmp'

step "Removing the packages"
logged "$logs/remove.log" in_chroot "$system" sh -ec '
    packages=$(dpkg-query -W -f "\${Package}\n" | grep rsackermann)
    dpkg -L $packages | sort -u >/tmp/files
    apt-get purge -y $packages
    # A directory stays if another package has it, too.
    while read -r path; do
        [ ! -e "$path" ] || dpkg -S "$path" >/dev/null 2>&1 || echo "$path"
    done </tmp/files >/tmp/left
    cat /tmp/left
    test ! -s /tmp/left
    ! find / -xdev -name "*rsackermann*" -not -path "/packages/*" -not -path "/src/*" -not -path "/tmp/*" \
        -not -path "/proc/*" |
        grep .
    ! ldconfig -p | grep rsackermann'
echo "The packages install, work and go."

#!/bin/bash
# Builds the library, the programs and the tests for arm64 against Debian's arm64 packages of OpenCV and runs the tests
# with qemu's emulation of an arm64 processor. All of it is in a system of its own in the cache. Needs root.
# usage: test_arm64.sh [GTEST_FILTER]    default: all tests but those that take long

. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/chroot.sh"
filter=${1:-*}
release=bookworm
system=$cache/debian-arm64
logs=$cache/logs-arm64

make_chroot "$system" $release "$logs/debootstrap.log"
step "Installing the cross compiler, qemu and OpenCV for arm64"
logged "$logs/architecture.log" in_chroot "$system" dpkg --add-architecture arm64
logged "$logs/update.log" in_chroot "$system" apt-get update
logged "$logs/install.log" in_chroot "$system" apt-get install -y crossbuild-essential-arm64 qemu-user-static \
    cmake ninja-build ccache pkg-config dpkg-dev patch python3 libopencv-dev:arm64 libeigen3-dev nlohmann-json3-dev \
    libyaml-cpp-dev:arm64 zlib1g-dev:arm64
source=$(in_chroot "$system" /src/scripts/get_opencv_source.sh)

step "Building for arm64"
# OpenCV's CMake files for x86 name paths of x86: those of arm64 are in their own directory.
options=(
    -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
    -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++
    -DCMAKE_LIBRARY_ARCHITECTURE=aarch64-linux-gnu
    -DCMAKE_CROSSCOMPILING_EMULATOR=/usr/bin/qemu-aarch64-static
    -DENABLE_WERROR=ON -DBUILD_TESTING=ON "-DOPENCV_TS_SOURCE_DIR=$source"
)
logged "$logs/configure.log" in_chroot "$system" env CCACHE_NOHASHDIR=1 cmake -G Ninja -S /src -B /build "${options[@]}"
logged "$logs/build.log" in_chroot "$system" cmake --build /build

step "Testing with $(in_chroot "$system" qemu-aarch64-static --version | head -n 1)"
# The tests of the programs start them by name.
logged "$logs/wrappers.log" in_chroot "$system" sh -ec '
    cd /build/samples
    for program in $(find . -maxdepth 1 -type f -executable -not -name "*.arm64"); do
        if [ "$(head -c 2 $program)" != "#!" ]; then mv $program $program.arm64; fi
        printf "#!/bin/sh\nexec qemu-aarch64-static /build/samples/%s.arm64 \"\$@\"\n" $program >$program
        chmod +x $program
    done'
status=0
for program in /build/opencv_test_rsackermann /build/test/samples/rsackermann_test_samples; do
    name=$(basename $program)
    in_chroot "$system" sh -c "cd /build && qemu-aarch64-static $program --test_tag_skip=long '--gtest_filter=$filter'" \
        >"$logs/$name.log" 2>&1 || status=1
    grep -E '^\[ *(PASSED|FAILED) *\]' "$logs/$name.log" || { tail -n 20 "$logs/$name.log" >&2; status=1; }
done
exit $status

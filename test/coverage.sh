#!/bin/bash
# Which lines and branches of the module's sources its tests reach, measured with gcc and gcovr; branches that only an
# exception takes don't count. Fails below the shares that are asked for. It takes some minutes.
# usage: coverage.sh [BUILD_DIRECTORY]     default: build-coverage

. "$(dirname "$0")/../scripts/common.sh"
build=$(realpath -m "${1:-$root/build-coverage}")
lines=95 branches=85

install_packages "$build/apt-install.log" "${packages_build[@]}" "${packages_test[@]}" gcovr
use_ccache "$root"
step "Building in $build"
# Tests in several threads count at once: without atomic counters some become negative, which gcovr takes for errors.
logged "$build/configure.log" cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=None \
    "-DCMAKE_CXX_FLAGS=-O1 --coverage -fprofile-update=atomic" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DBUILD_SAMPLES=OFF -DBUILD_TESTING=ON "-DOPENCV_TS_SOURCE_DIR=$("$root/scripts/get_opencv_source.sh")"
logged "$build/build.log" cmake --build "$build" --target opencv_test_rsackermann
find "$build" -name '*.gcda' -delete

step "Testing"
cd "$build"
logged tests.log ./opencv_test_rsackermann --test_tag_skip=long
OPENCV_OPENCL_DEVICE=:CPU: logged opencl.log ./opencv_test_rsackermann '--gtest_filter=*OpenCL*'

step "Counting; line by line in $build/coverage.html"
gcovr --root "$root" --object-directory "$build" --filter "$root/modules/rsackermann/src/" \
    --exclude-throw-branches -j "$(nproc)" --html-details coverage.html --json-summary coverage.json \
    --print-summary --fail-under-line $lines --fail-under-branch $branches .

#!/bin/bash
# Installs the packages that are needed on Debian 12, builds what the demo needs and runs it.
# usage: run_demo.sh [BUILD_DIRECTORY]

. "$(dirname "$0")/../scripts/common.sh"
build=${1:-$root/build}
logs=$build/logs

install_packages "$logs/apt-install.log" "${packages_build[@]}"
step "Building in $build"
use_ccache "$root"
# Several sources are compiled as one, which takes less time.
logged "$logs/configure.log" cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DCMAKE_UNITY_BUILD=ON
show_progress "$logs/build.log" cmake --build "$build" \
    --target rsackermann_simulate rsackermann_correct rsackermann_evaluate
step "Running the demo"
"$root/samples/demo.sh" "$build"

#!/bin/bash
# Installs the packages that are needed on Debian 12, builds the library with its samples and runs the demo.
# usage: run_demo.sh [BUILD_DIRECTORY]

. "$(dirname "$0")/../scripts/common.sh"
build=${1:-$root/build}
logs=$build/logs

install_packages "$logs/apt-install.log" "${packages_build[@]}"
step "Building in $build"
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1
logged "$logs/configure.log" cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
logged "$logs/build.log" cmake --build "$build"
step "Running the demo"
"$root/samples/demo.sh" "$build"

#!/bin/sh
# Builds and runs the project that uses the installed library with the flags that pkg-config tells.
# usage: build_with_pkg_config.sh COMPILER DIRECTORY_FOR_THE_PROGRAM
set -e
libraries=$(pkg-config --variable=libdir rsackermann)
# shellcheck disable=SC2046  # flags are words
"$1" -std=c++17 "$(dirname "$0")/main.cpp" -o "$2/consumer_pkg_config" $(pkg-config --cflags --libs rsackermann)
LD_LIBRARY_PATH=$libraries "$2/consumer_pkg_config"

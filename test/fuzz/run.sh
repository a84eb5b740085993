#!/bin/bash
# Fuzzes what takes a caller's values, files and command lines, with clang's libFuzzer, AddressSanitizer and UndefinedBehaviorSanitizer.
# Prints for each fuzzer how often it ran; fails with the first input that crashes, isn't finite, or takes longer than ten seconds.
# usage: run.sh [--quick[=SECONDS] | --runs=N] [--build=DIRECTORY] [FUZZER...]
#   --quick    so many seconds for each fuzzer, 60 if none are told; this is the default
#   --runs     so many executions for each fuzzer
#   FUZZER     estimator, warp, files, command_line; all if none is told
# What is found goes to DIRECTORY/found, the inputs that reached something new to DIRECTORY/corpus, from which the next run goes on.

set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build-fuzz
limit=-max_total_time=60
fuzzers=()
for argument in "$@"; do
    case $argument in
        --quick) limit=-max_total_time=60 ;;
        --quick=*) limit=-max_total_time=${argument#*=} ;;
        --runs=*) limit=-runs=${argument#*=} ;;
        --build=*) build=$(realpath -m "${argument#*=}") ;;
        -*) echo "unknown option $argument" >&2; exit 2 ;;
        *) fuzzers+=("$argument") ;;
    esac
done
[ ${#fuzzers[@]} -gt 0 ] || fuzzers=(estimator warp files command_line)

mkdir -p "$build"
launcher=()
! command -v ccache >/dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS=-O1 -g" "${launcher[@]}" \
    -DBUILD_SHARED_LIBS=OFF -DBUILD_FUZZERS=ON >"$build/configure.log"
cmake --build "$build" --target "${fuzzers[@]/#/fuzz_}" >"$build/build.log" || { tail -n 40 "$build/build.log" >&2; exit 1; }

mkdir -p "$build/found"
export UBSAN_OPTIONS=print_stacktrace=1 OPENCV_LOG_LEVEL=ERROR
for fuzzer in "${fuzzers[@]}"; do
    mkdir -p "$build/corpus/$fuzzer"
    options=(-timeout=10 -rss_limit_mb=2048 -max_len=2000 -print_final_stats=1 "-artifact_prefix=$build/found/$fuzzer-")
    dictionary=$here/$fuzzer.dict
    [ ! -e "$dictionary" ] || options+=("-dict=$dictionary")
    log=$build/$fuzzer.log
    if ! "$build/test/fuzz/fuzz_$fuzzer" "$limit" "${options[@]}" "$build/corpus/$fuzzer" "$here/corpus/$fuzzer" >"$log" 2>&1; then
        tail -n 60 "$log" >&2
        echo "$fuzzer: failed, see $log" >&2
        exit 1
    fi
    echo "$fuzzer: $(sed -n 's/^Done \(.*\) runs in \(.*\) second(s)$/\1 executions in \2 s/p' "$log"), nothing found"
done

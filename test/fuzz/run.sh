#!/bin/bash
# Fuzzes what takes a caller's values, files and command lines, with clang's libFuzzer, AddressSanitizer and
# UndefinedBehaviorSanitizer. Prints for each fuzzer how often it ran; fails with the first input that crashes, isn't
# finite, or takes longer than ten seconds.
# usage: run.sh [--quick[=SECONDS] | --runs=N] [--plain] [--build=DIRECTORY] [FUZZER...]
#   --quick    so many seconds for each fuzzer, 60 if none are given, but not more executions than two processors manage
#              in 60 seconds, with the same inputs everywhere; this is the default
#   --runs     so many executions for each fuzzer
#   --plain    optimised and without sanitizers: some ten times as many executions, and an estimate must not take more
#              than 0.1 s of processor time
#   FUZZER     estimator, solvers, warp, files, command_line; all if none is given
# What is found goes to DIRECTORY/found, the inputs that reached something new to DIRECTORY/corpus, from which the next
# run goes on.

. "$(dirname "$0")/../../scripts/common.sh"
here=$root/test/fuzz
build=
limit=-max_total_time=60
seed=1 # a short run has the same inputs each time, a long one others
declare -A executions_of_short_run=([estimator]=8000 [solvers]=2000000 [warp]=40000 [files]=400000 [command_line]=5000)
sanitizers=address,undefined optimisation="-O1 -gline-tables-only"
fuzzers=()
for argument in "$@"; do
    case $argument in
        --quick) limit=-max_total_time=60 ;;
        --quick=*) limit=-max_total_time=${argument#*=} ;;
        --runs=*) limit=-runs=${argument#*=} seed=0 ;; # by the clock
        --plain) sanitizers='' optimisation=-O2 ;;
        --build=*) build=$(realpath -m "${argument#*=}") ;;
        -*) die "unknown option $argument" ;;
        *) fuzzers+=("$argument") ;;
    esac
done
[ ${#fuzzers[@]} -gt 0 ] || fuzzers=(estimator solvers warp files command_line)
[ -n "$build" ] || build=$root/build-fuzz${sanitizers:+-sanitized}

install_packages "$build/apt-install.log" "${packages_build[@]}" "${packages_clang[@]}"
use_ccache "$root"
logged "$build/configure.log" cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS=$optimisation" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DBUILD_SHARED_LIBS=OFF "-DSANITIZERS=$sanitizers" -DBUILD_FUZZERS=ON
logged "$build/build.log" cmake --build "$build" --target "${fuzzers[@]/#/fuzz_}"

# In memory, since some fuzzers write a file for each execution.
scratch=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# What is too large for the memory is refused by OpenCV, as without sanitizers.
export TMPDIR=$scratch ASAN_OPTIONS=allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1 \
    OPENCV_LOG_LEVEL=ERROR OPENCV_FOR_THREADS_NUM=1

# usage: fuzz NAME
fuzz()
{
    local name=$1 log=$build/$1.log executions
    local options=("$limit" "-seed=$seed" -timeout=10 -rss_limit_mb=2048 -max_len=1000 -print_final_stats=1
                   "-artifact_prefix=$build/found/$name-")
    [ ! -e "$here/$name.dict" ] || options+=("-dict=$here/$name.dict")
    [ "$seed" = 0 ] || options+=("-runs=${executions_of_short_run[$name]}")
    mkdir -p "$build/corpus/$name" "$build/found"
    local TIMEFORMAT="%U s of processor time"
    if ! { time "${fixed_addresses[@]}" "$build/test/fuzz/fuzz_$name" "${options[@]}" \
            "$build/corpus/$name" "$here/corpus/$name"; } >"$log" 2>&1; then
        tail -n 60 "$log" >&2
        echo "$name: failed, see $log"
        return 1
    fi
    executions=$(sed -n 's/^Done \(.*\) runs in \(.*\) second(s)$/\1 executions in \2 s/p' "$log")
    echo "$name: $executions, $(tail -n 1 "$log"), nothing found"
}

failures=0
for fuzzer in "${fuzzers[@]}"; do
    # One more than there are processors: some wait for files.
    [ "$(jobs -rp | wc -l)" -le "$(nproc)" ] || wait -n || failures=$((failures + 1))
    fuzz "$fuzzer" &
done
while [ -n "$(jobs -p)" ]; do
    wait -n || failures=$((failures + 1))
done
[ $failures -eq 0 ]

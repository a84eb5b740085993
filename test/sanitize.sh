#!/bin/bash
# Runs the tests of the module and of the sample programs with AddressSanitizer and UndefinedBehaviorSanitizer, and the
# tests about threads, detectors, estimator, maps and corrector with ThreadSanitizer and four threads. Fails if a test
# fails or a sanitizer reports anything.
# usage: sanitize.sh [--build=DIRECTORY] [address] [thread]     both if none is given
# The programs of a run are built in DIRECTORY-address and DIRECTORY-thread, build-sanitize-... if none is given.

. "$(dirname "$0")/../scripts/common.sh"
base=$root/build-sanitize
runs=()
for argument in "$@"; do
    case $argument in
        --build=*) base=$(realpath -m "${argument#*=}") ;;
        address | thread) runs+=("$argument") ;;
        *) die "unknown argument $argument" ;;
    esac
done
[ ${#runs[@]} -gt 0 ] || runs=(address thread)

# Left out, beside what takes long: OpenCL; what is limited by memory, which the sanitizer takes for itself.
without='*OpenCL*'
without_samples='CorrectResults.memory_of_a_large_image:Samples/UnevenStreet*'
# Of all those that run in several threads one for each way through the code.
threaded='*Threads*:*threads*:*Estimator.*:RSAckermann_Corrector.*:*CorrectorTypes*:*WarpContract.types*:*Detectors*'

# usage: build RUN SANITIZERS BUILD_FUZZERS TARGET...
build()
{
    local build=$base-$1 sanitizers=$2 fuzzers=$3
    shift 3
    logged "$build/configure.log" cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER=clang++ \
        -DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS=-O1 -gline-tables-only" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
        -DBUILD_SHARED_LIBS=OFF "-DSANITIZERS=$sanitizers" "-DBUILD_FUZZERS=$fuzzers" -DBUILD_TESTING=ON \
        "-DOPENCV_TS_SOURCE_DIR=$("$root/scripts/get_opencv_source.sh")"
    logged "$build/build.log" cmake --build "$build" --target "$@"
}

# Runs tests; what the sanitizers report goes to files, since the sample programs' own output is part of what is tested.
# usage: run NAME PROGRAM FILTER
run()
{
    local name=$1 program=$2 filter=$3 status=0
    (cd "$logs" && "${fixed_addresses[@]}" "$program" --test_tag_skip=long "--gtest_filter=$filter" \
        >"$logs/$name.log" 2>&1) || status=$?
    [ $status -eq 0 ] || tail -n 60 "$logs/$name.log" >&2
    echo "$name: $(grep -c '^\[       OK \]' "$logs/$name.log") tests passed, exit status $status"
    return $status
}

install_packages "$base-apt-install.log" "${packages_build[@]}" "${packages_test[@]}" "${packages_clang[@]}"
use_ccache "$root"
failures=0
for run in "${runs[@]}"; do
    logs=$base-$run/logs
    rm -rf "$logs"
    mkdir -p "$logs"
    options="log_path=$logs/report:abort_on_error=1:print_stacktrace=1"
    export ASAN_OPTIONS=$options UBSAN_OPTIONS=$options \
        LSAN_OPTIONS="suppressions=$root/test/sanitize/leaks.txt:print_suppressions=0"
    export TSAN_OPTIONS=$options
    case $run in
        address)
            step "AddressSanitizer and UndefinedBehaviorSanitizer"
            # As for the fuzzers, so that ccache has the library once for both.
            build address address,undefined ON opencv_test_rsackermann rsackermann_test_samples
            run module "$base-address/opencv_test_rsackermann" "-$without" &
            # The programs load what OpenCV reads videos with, which leaks and is gone in the end, so that no
            # suppression names it.
            ASAN_OPTIONS=$options:detect_leaks=0 \
                run samples "$base-address/test/samples/rsackermann_test_samples" "-$without_samples" ||
                failures=$((failures + 1))
            wait $! || failures=$((failures + 1))
            ;;
        thread)
            step "ThreadSanitizer"
            build thread thread OFF opencv_test_rsackermann
            run threads "$base-thread/opencv_test_rsackermann" "$threaded-$without:*very_wide*" ||
                failures=$((failures + 1))
            ;;
    esac
    if compgen -G "$logs/report.*" >/dev/null; then
        head -n 60 "$logs"/report.* >&2
        failures=$((failures + 1))
    fi
done
[ $failures -eq 0 ] || die "see the logs in $base-*/logs"
echo "nothing found"

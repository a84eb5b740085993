#!/bin/bash
# Installs the packages that are needed on Debian 12, builds everything in both ways and runs all tests:
# - the library against the installed OpenCV, with samples, the Python package, tests and performance tests (one sample
#   each),
# - the module inside of OpenCV's source tree, with its tests, performance tests (one sample each) and Python tests,
# - static analysis, the fuzzers for a minute each, and the tests with sanitizers.
# Prints the number of test cases as its last line and fails if one of them failed.
# usage: run_all.sh [--tests] [--ts-source=DIRECTORY] [BUILD_DIRECTORY]
#   --tests       no analysis, fuzzers and sanitizers, which are for the tools of Debian 12
#   --ts-source   take opencv_ts from this source of OpenCV, which may be of another version, and build nothing inside
#                 of OpenCV

. "$(dirname "$0")/../scripts/common.sh"
ts_source='' only_tests=no build=$root/build-test
for argument in "$@"; do
    case $argument in
        --tests) only_tests=yes ;;
        --ts-source=*) ts_source=${argument#*=} ;;
        -*) die "unknown option $argument" ;;
        *) build=$argument ;;
    esac
done
logs=$build/logs
results=$build/test-results

passed=0
failed=0
finished=no

closing_line()
{
    # An end on the way is a failure, too.
    [ $finished = yes ] || failed=$((failed + 1))
    echo "$passed passed, $failed failed"
    [ $failed -eq 0 ] || exit 1
}
trap closing_line EXIT

# Adds up the results of a program that has run.
# usage: count TITLE EXIT_STATUS LOG ARGUMENTS_OF_COUNT_RESULTS...
count()
{
    local title=$1 status=$2 log=$3 counts number skipped=0
    shift 3
    read -ra counts < <("$root/test/count_results.py" "$@") || counts=(0 0)
    if [ "${counts[1]}" -eq 0 ]; then
        if [ "$status" -ne 0 ]; then
            # It has crashed, or could not start.
            tail -n 60 "$log" >&2
            echo "$title: ended with exit status $status, see $log" >&2
            counts[1]=1
        elif [ "${counts[0]}" -eq 0 ]; then
            echo "$title: there is no test, see $log" >&2
            counts[1]=1
        fi
    fi
    # opencv_ts reports a test that skips itself as one that ran.
    while read -r number; do
        skipped=$((skipped + number))
    done < <(sed -n 's/.*\[ SKIPSTAT \] \([0-9]*\) tests skipped.*/\1/p' "$log")
    counts[0]=$((counts[0] - skipped))
    echo "$title: ${counts[0]} passed, ${counts[1]} failed, $skipped skipped"
    passed=$((passed + counts[0]))
    failed=$((failed + counts[1]))
}

# Runs a program of opencv_ts that was built inside of OpenCV.
# usage: run_in_tree NAME PROGRAM ARGUMENTS...
run_in_tree()
{
    local name=in-tree-$1 program=$in_tree/build/bin/$2 status=0
    local title="Inside of OpenCV, $1"
    shift 2
    "$program" "--gtest_output=xml:$results/$name.xml" "$@" >"$logs/$name.log" 2>&1 || status=$?
    count "$title" $status "$logs/$name.log" gtest "$results/$name.xml"
}

# A command that is one test.
# usage: check TITLE LOG COMMAND...
check()
{
    local title=$1 log=$2
    shift 2
    if "$@" >"$log" 2>&1; then
        echo "$title: passed"
        passed=$((passed + 1))
    else
        tail -n 60 "$log" >&2
        echo "$title: failed, see $log" >&2
        failed=$((failed + 1))
    fi
}

# A project that uses the module of an installed OpenCV that was built with it.
consumer_of_opencv()
{
    local prefix=$in_tree/installed build=$in_tree/consumer component
    rm -rf "$prefix" "$build"
    for component in libs dev; do
        cmake --install "$in_tree/build" --prefix "$prefix" --component $component || return
    done
    cmake -G Ninja -S "$root/test/consumer" -B "$build" -DMODULE_OF_OPENCV=ON "-DCMAKE_PREFIX_PATH=$prefix" || return
    cmake --build "$build" || return
    LD_LIBRARY_PATH=$prefix/lib "$build/rsackermann_consumer"
}

mkdir -p "$logs"
rm -rf "$results"
mkdir -p "$results"
install_packages "$logs/apt-install.log" "${packages_build[@]}" "${packages_test[@]}"
opencv_source=$ts_source
python=OFF # the package is made from OpenCV's source, too, of exactly the version that is installed
if [ -z "$ts_source" ]; then
    python=ON
    step "Getting the source of OpenCV"
    opencv_source=$("$root/scripts/get_opencv_source.sh")
fi

step "Building against the installed OpenCV in $build"
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1
logged "$logs/configure.log" cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DENABLE_WERROR=ON -DBUILD_SAMPLES=ON -DBUILD_TESTING=ON -DBUILD_PERF_TESTS=ON \
    "-DOPENCV_TS_SOURCE_DIR=$opencv_source" -DBUILD_PYTHON=$python -DPython3_EXECUTABLE=/usr/bin/python3 \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
logged "$logs/build.log" cmake --build "$build"

step "Testing"
status=0
ctest --test-dir "$build" --verbose --output-junit "$results/ctest.junit" >"$logs/ctest.log" 2>&1 || status=$?
count "Against the installed OpenCV" $status "$logs/ctest.log" ctest "$results/ctest.junit" "$results"

if [ -n "$ts_source" ]; then
    finished=yes
    exit
fi

# OpenCV itself is built once: this directory stays. One run at a time uses it.
in_tree=$cache/in-tree-$(basename "$opencv_source")
mkdir -p "$in_tree"
exec 9>"$in_tree/lock"
flock 9
step "Building inside of OpenCV in $in_tree"
"$root/scripts/build_in_tree.sh" "$in_tree/build" "$in_tree/checkout" "$logs"

step "Testing"
run_in_tree tests opencv_test_rsackermann
# OpenCV takes a CPU as an OpenCL device, which is what PoCL makes of it, only if it is told to.
OPENCV_OPENCL_DEVICE=:CPU: run_in_tree opencl opencv_test_rsackermann '--gtest_filter=*OpenCL*'
run_in_tree perf opencv_perf_rsackermann --perf_min_samples=1 --perf_force_samples=1 --perf_verify_sanity
status=0
PYTHONPATH=$in_tree/build/python_loader:$opencv_source/modules/python/test \
    /usr/bin/python3 -B -m unittest discover -v -s "$root/modules/rsackermann/misc/python/test" \
    >"$logs/in-tree-python.log" 2>&1 || status=$?
count "Inside of OpenCV, python" $status "$logs/in-tree-python.log" unittest "$logs/in-tree-python.log"
check "Inside of OpenCV, consumer" "$logs/in-tree-consumer.log" consumer_of_opencv
flock -u 9
finished=$only_tests
[ $only_tests = no ] || exit

step "Analysing"
check "Static analysis" "$logs/analyse.log" "$root/test/analyse.sh" "--tidy=$build"

step "Fuzzing"
check "Fuzzers" "$logs/fuzz.log" "$root/test/fuzz/run.sh" --quick "--build=$build-fuzz-sanitized"

step "Testing with sanitizers"
check "Sanitizers" "$logs/sanitize.log" "$root/test/sanitize.sh" "--build=$build-sanitize"

finished=yes

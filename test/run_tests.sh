#!/bin/bash
# The tests for every change: installs the packages that are needed on Debian 12, builds everything in both ways and
# runs all tests but those that take long (CV_TEST_TAG_LONG), beside each other:
# - the library against the installed OpenCV, with samples, the Python package, tests and performance tests (one sample
#   each),
# - the module inside of OpenCV's source tree, with its tests, performance tests (one sample each) and Python tests.
# Prints the number of test cases as its last line and fails if one of them failed. run_everything.sh has the rest.
# usage: run_tests.sh [--long | --browser | --ts-source=DIRECTORY] [BUILD_DIRECTORY]
#   --long        only the tests of the module against the installed OpenCV, with those that take long
#   --browser     only the test of pages in a browser, which is installed for it; without this option the test is
#                 skipped where there is none
#   --ts-source   take opencv_ts from this source of OpenCV, which may be of another version, and build nothing inside
#                 of OpenCV

. "$(dirname "$0")/../scripts/common.sh"
ts_source='' long=no browser=no build=$root/build-test
for argument in "$@"; do
    case $argument in
        --long) long=yes ;;
        --browser) browser=yes ;;
        --ts-source=*) ts_source=${argument#*=} ;;
        -*) die "unknown option $argument" ;;
        *) build=$argument ;;
    esac
done
logs=$build/logs

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

# Runs the tests of a build, as many at once as there are processors, and adds up their cases.
# usage: run_tests TITLE BUILD_DIRECTORY LOG OPTION_OF_CTEST...
run_tests()
{
    local title=$1 build=$2 log=$3 status=0 skipped counts
    local results=$build/test-results
    shift 3
    step "Testing"
    rm -rf "$results"
    mkdir -p "$results" # the programs don't make directories
    ctest --test-dir "$build" --parallel "$(nproc)" --verbose --output-junit "$results/ctest.junit" "$@" \
        >"$log" 2>&1 </dev/null || status=$?
    read -ra counts < <("$root/test/count_results.py" "$results/ctest.junit" "$results") || counts=(0 0)
    if [ $status -ne 0 ] && [ "${counts[1]}" -eq 0 ] || [ "${counts[0]}" -eq 0 ]; then
        tail -n 60 "$log" >&2
        echo "$title: ctest ended with exit status $status, see $log" >&2
        counts[1]=1
    fi
    # The results of opencv_ts have a test that skips itself as one that ran.
    skipped=$(grep -c '\[     SKIP \]' "$log") || true
    counts[0]=$((counts[0] - skipped))
    echo "$title: ${counts[0]} passed, ${counts[1]} failed, $skipped skipped"
    passed=$((passed + counts[0]))
    failed=$((failed + counts[1]))
}

install_packages "$logs/apt-install.log" "${packages_build[@]}" "${packages_test[@]}"
if [ $browser = yes ]; then
    install_packages "$logs/apt-install-browser.log" "${packages_browser[@]}"
fi
opencv_source=$ts_source
python=OFF # the package is made from OpenCV's source, too, of exactly the version that is installed
if [ -z "$ts_source" ]; then
    python=ON
    step "Getting the source of OpenCV"
    opencv_source=$("$root/scripts/get_opencv_source.sh")
fi

step "Building against the installed OpenCV in $build"
use_ccache "$root"
logged "$logs/configure.log" cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DENABLE_WERROR=ON -DBUILD_SAMPLES=ON -DBUILD_TESTING=ON -DBUILD_PERF_TESTS=ON \
    "-DOPENCV_TS_SOURCE_DIR=$opencv_source" -DBUILD_PYTHON=$python -DPython3_EXECUTABLE=/usr/bin/python3 \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
logged "$logs/build.log" cmake --build "$build"
if [ $long = yes ]; then
    run_tests "With those that take long" "$build" "$logs/ctest-long.log" --build-config Long --tests-regex _long
elif [ $browser = yes ]; then
    run_tests "In a browser" "$build" "$logs/ctest-browser.log" --tests-regex page_in_browser
else
    run_tests "Against the installed OpenCV" "$build" "$logs/ctest.log"
fi

if [ -n "$ts_source" ] || [ $long = yes ] || [ $browser = yes ]; then
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
rm -rf "$in_tree/tests"
logged "$logs/in-tree-tests.log" cmake -G Ninja -S "$root/test/in_tree" -B "$in_tree/tests" \
    "-DOPENCV_SOURCE_DIR=$opencv_source" "-DOPENCV_BUILD_DIR=$in_tree/build"
run_tests "Inside of OpenCV" "$in_tree/tests" "$logs/in-tree-ctest.log"
flock -u 9
finished=yes

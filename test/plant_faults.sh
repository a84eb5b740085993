#!/bin/bash
# Plants the faults of planted_faults.txt one at a time in a scratch copy of the tree, builds it and runs the tests that
# have to fail. Prints a page in Markdown, doc/planted_faults.md, and fails if a fault was missed. It takes hours, and
# may be interrupted: faults that SCRATCH_DIRECTORY/rows.txt has as caught aren't planted again.
# usage: plant_faults.sh SCRATCH_DIRECTORY [PATTERN]
#        plant_faults.sh --check BUILD_DIRECTORY
#   PATTERN: only the faults whose line matches this regular expression
#   --check: plants nothing; each fault has to change one line of its file, and the programs in this directory have to
#            have its tests. A part of ctest.

. "$(dirname "$0")/../scripts/common.sh"
if [ $# -eq 0 ] || [ "$*" = --check ]; then
    die "usage: plant_faults.sh SCRATCH_DIRECTORY [PATTERN], or plant_faults.sh --check BUILD_DIRECTORY"
fi

target_of()
{
    [ "$1" = samples ] && echo rsackermann_test_samples || echo opencv_test_rsackermann
}

# usage: split FAULT; sets file, expression, tests and the beginning of the row of the table
split()
{
    file=${1%% @ *} tests=${1##* @ }
    expression=${1#* @ } expression=${expression% @ *}
    file=${file/#M\//modules/rsackermann/}
    row="| \`$file\` | \`${expression//|/\\|}\` | ${tests%% *} \`${tests#* }\` |"
}

# usage: read_faults PATTERN; sets faults
read_faults()
{
    mapfile -t faults < <(grep -v '^\(#\|$\)' "$root/test/planted_faults.txt" | grep -E -- "$1")
    [ ${#faults[@]} -gt 0 ] || die "no fault matches $1"
}

# usage: check BUILD_DIRECTORY
check()
{
    local fault changed problems=0
    local -A programs found
    read_faults .
    for fault in "${faults[@]}"; do
        split "$fault"
        changed=$(sed "$expression" "$root/$file" | diff "$root/$file" - | grep -c '^>') || true
        if [ "$changed" -ne 1 ]; then
            echo "$file: $expression changes $changed lines"
            problems=$((problems + 1))
        fi
        program=$(target_of "${tests%% *}")
        [ -n "${programs[$program]:-}" ] || programs[$program]=$(find "$1" -type f -name "$program")
        [ -n "${programs[$program]}" ] || die "$1 has no $program"
        [ -n "${found[$program ${tests#* }]:-}" ] ||
            found[$program ${tests#* }]=$("${programs[$program]}" --gtest_list_tests "--gtest_filter=${tests#* }" |
                grep -c '^  ') || true
        if [ "${found[$program ${tests#* }]}" -eq 0 ]; then
            echo "$file: $expression has no test, $tests"
            problems=$((problems + 1))
        fi
    done
    echo "${#faults[@]} faults, $problems problems"
    [ $problems -eq 0 ]
}

if [ "$1" = --check ]; then
    check "$2"
    exit
fi

scratch=$(realpath -m "$1") pattern=${2:-.}
tree=$scratch/src build=$scratch/b log=$scratch/log.txt rows=$scratch/rows.txt
read_faults "$pattern"

rm -rf "$tree"
mkdir -p "$tree"
touch "$rows"
# The copies are newer than the objects of an interrupted run.
tar -C "$root" --exclude=./.git --exclude='./build*' -cf - . | tar -C "$tree" -xmf -
use_ccache "$tree"
logged "$scratch/configure.txt" cmake -G Ninja -S "$tree" -B "$build" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DBUILD_SAMPLES=ON -DBUILD_TESTING=ON "-DOPENCV_TS_SOURCE_DIR=$("$root/scripts/get_opencv_source.sh")"

# usage: run PROGRAM FILTER
run()
{
    local variables=()
    case $1 in
        opencl) variables=(OPENCV_OPENCL_DEVICE=:CPU:) ;;
        avx2) variables=(OPENCV_CPU_DISABLE=AVX512-SKX) ;;
        baseline) variables=("OPENCV_CPU_DISABLE=AVX512-SKX,AVX2") ;;
    esac
    # In a folder of its own: tests leave files there.
    (cd "$scratch" && env "${variables[@]}" timeout 900 \
        "$(find "$build" -type f -name "$(target_of "$1")")" "--gtest_filter=$2") >"$log" 2>&1
}

caught=0
echo "# Planted faults"
echo
echo "What \`test/plant_faults.sh\` does: each fault, a sed expression, is planted alone, and one of the tests has to \
fail. \`test/planted_faults.txt\` is the list."
echo
echo "| file | fault | tests | result |"
echo "|---|---|---|---|"
for fault in "${faults[@]}"; do
    split "$fault"
    if grep -qxF "$row caught |" "$rows"; then
        result=caught
    else
        sed -i "$expression" "$tree/$file"
        changed=$(diff "$root/$file" "$tree/$file" | grep -c '^>' || true)
        if [ "$changed" -ne 1 ]; then
            result="changes $changed lines"
        elif ! cmake --build "$build" --target "$(target_of "${tests%% *}")" >"$scratch/build.txt" 2>&1; then
            result="isn't built"
        elif run "${tests%% *}" "${tests#* }"; then
            result=missed
        else
            result=caught
        fi
        cp "$root/$file" "$tree/$file"
        echo "$row $result |" >>"$rows"
    fi
    [ "$result" != caught ] || caught=$((caught + 1))
    echo "$row $result |"
done
# The tests pass without a fault.
declare -A passes
for fault in "${faults[@]}"; do
    split "$fault"
    [ -z "${passes[$tests]:-}" ] || continue
    logged "$scratch/build.txt" cmake --build "$build" --target "$(target_of "${tests%% *}")"
    run "${tests%% *}" "${tests#* }" || die "without a fault, $tests fails: see $log"
    grep -q '\[  PASSED  \] [1-9]' "$log" || die "without a fault, $tests has no test"
    passes[$tests]=yes
done
echo
echo "$caught of ${#faults[@]} faults caught."
[ "$caught" -eq ${#faults[@]} ]

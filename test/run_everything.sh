#!/bin/bash
# run_tests.sh, and what takes longer: one after another, or the named parts alone. A part that has passed isn't run
# again until a file of the checkout changes. Ends with a table, and the number of tests that passed and failed.
# usage: run_everything.sh [--turn] [--minutes=N] [PART...]
#   --turn      only run_tests.sh and one part that takes some minutes, which the checkout's files choose
#   --minutes   ends then: what isn't finished is no failure, but for run_tests.sh

. "$(dirname "$0")/../scripts/common.sh"
build=$root/build-test
slow_parts=(versions-4.10.0 versions-5.0.0 arm64 package clone coverage faults)
quick_parts=(statistics browser analysis address thread fuzzers)
turn=no minutes='' parts=()
for argument in "$@"; do
    case $argument in
        --turn) turn=yes ;;
        --minutes=*) minutes=${argument#*=} ;;
        -*) die "unknown option $argument" ;;
        *) parts+=("$argument") ;;
    esac
done

# Not asked of git, which may not be there, and doesn't know of what isn't committed.
state=$(cd "$root" && find . \( -path ./.git -o -path './build*' -o -name __pycache__ \) -prune -o -type f -print0 |
    sort -z | xargs -0 sha1sum | sha1sum | cut -c 1-12)
done_parts=$build/everything/$state
mkdir -p "$done_parts"

if [ ${#parts[@]} -eq 0 ]; then
    parts=(tests "${quick_parts[@]}" "${slow_parts[@]}")
    if [ $turn = yes ]; then
        first=$((16#${state:0:6} % ${#quick_parts[@]}))
        parts=(tests "${quick_parts[first]}")
    fi
fi

# Sets command to that of a part.
command_of()
{
    case $1 in
        tests) command=("$root/test/run_tests.sh" "$build") ;;
        statistics) command=("$root/test/run_tests.sh" --long "$build") ;;
        browser) command=("$root/test/run_tests.sh" --browser "$build") ;;
        analysis) command=("$root/test/analyse.sh" --tidy) ;;
        address | thread) command=("$root/test/sanitize.sh" "--build=$build-sanitize" "$1") ;;
        fuzzers) command=("$root/test/fuzz/run.sh" --quick "--build=$build-fuzz-sanitized") ;;
        versions-*) command=("$root/scripts/build_with_opencv.sh" "${1#versions-}") ;;
        arm64) command=("$root/scripts/test_arm64.sh") ;;
        package) command=("$root/scripts/test_package.sh") ;;
        clone) command=("$root/scripts/test_from_clone.sh") ;;
        coverage) command=("$root/test/coverage.sh") ;;
        faults) command=("$root/test/plant_faults.sh" "$build-faults/$state") ;;
        *) die "there is no part $1; there are tests ${quick_parts[*]} ${slow_parts[*]}" ;;
    esac
}
for part in "${parts[@]}"; do
    command_of "$part"
done

# Runs a part; sets result, and counts to the numbers of tests.
run_part()
{
    local part=$1 log=$build/everything/$1.log status=0 limit=() left
    if [ -e "$done_parts/$part" ]; then
        read -ra counts <"$done_parts/$part"
        result="passed before"
        return
    fi
    counts=(0 0)
    if [ -n "$minutes" ] && [ "$part" != tests ]; then
        left=$((60 * minutes - SECONDS))
        result="not run: no time left"
        [ $left -gt 0 ] || return 0
        limit=(timeout --kill-after=10 "$left")
    fi
    step "Part $part"
    command_of "$part"
    "${limit[@]}" bash "${command[@]}" </dev/null 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
    # A part that counts its tests does so in its last line; another one is a test.
    read -ra counts < <(sed -n '$s/^\([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p' "$log") || counts=(1 0)
    result=passed
    if [ "$status" -eq 124 ] && [ ${#limit[@]} -gt 0 ]; then
        result="not finished in time"
        counts=(0 0)
    elif [ "$status" -ne 0 ] && ! { [ "$status" -eq 3 ] && [[ $part = versions-* ]]; }; then
        result=failed
        [ "${counts[1]}" -gt 0 ] || counts=(0 1)
    else
        echo "${counts[@]}" >"$done_parts/$part"
    fi
}

passed=0
failed=0
table=()
for part in "${parts[@]}"; do
    start=$SECONDS
    run_part "$part"
    table+=("$(printf '%-16s %-24s %6d s %6d passed %4d failed' "$part" "$result" $((SECONDS - start)) "${counts[@]}")")
    passed=$((passed + counts[0]))
    failed=$((failed + counts[1]))
done
step "State $state"
printf '%s\n' "${table[@]}"
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]

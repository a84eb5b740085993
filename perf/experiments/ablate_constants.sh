#!/bin/bash
# Halves and doubles each number that decides something, one at a time, and prints as a table in Markdown what that does
# to the experiments in their quick forms: rendered streets (residual, median), frames at random (residual, mean; worse
# frames), calibrations (line delay, 90 % of the errors) and, with folders of real drives, single images with nothing and
# with the yaw rate given, and sequences (residual over raw displacement). A number counts where its room is used.
#
# usage: ablate_constants.sh BUILD_DIRECTORY [--controls=FOLDER] [--only=REGEX] [DRIVE_FOLDER...]
#   BUILD_DIRECTORY   for a build of its own
#   --controls        frames of global-shutter cameras, see rsackermann_experiment_drives --help
#   --only            constants of which "file name" matches, as the first columns have them
# An hour on one core. Each line is printed as soon as it is measured.

. "$(dirname "$0")/../../scripts/common.sh"
controls='' only=. build='' drives=()
for argument in "$@"; do
    case $argument in
        --controls=*) controls=$argument ;;
        --only=*) only=${argument#*=} ;;
        -*) die "unknown option $argument" ;;
        *) if [ -z "$build" ]; then build=$argument; else drives+=("$(realpath "$argument")"); fi ;;
    esac
done
[ -n "$build" ] || die "the build directory is missing"
mkdir -p "$build"
build=$(realpath "$build")

# A copy of the sources in which each constant asks the environment for its factor.
python3 "$root/perf/experiments/instrument_constants.py" "$root" "$build/source" >"$build/constants.txt"
use_ccache "$build/source"
logged "$build/configure.log" cmake -G Ninja -S "$build/source" -B "$build/build" \
    -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DBUILD_SAMPLES=ON -DBUILD_PERF_TESTS=ON -DBUILD_TESTING=OFF \
    "-DOPENCV_TS_SOURCE_DIR=$("$root/scripts/get_opencv_source.sh")" "-DCMAKE_CXX_FLAGS=-include $build/source/ablated.hpp"
logged "$build/build.log" cmake --build "$build/build" --target rsackermann_experiment_streets \
    rsackermann_experiment_harm rsackermann_experiment_drives rsackermann_experiment_calibration
programs=$build/build/perf/experiments

street()
{
    "$programs/rsackermann_experiment_streets" --quiet --scenes=1 --speeds=40,100 --yaw_rates=-30,0,50 "$@" |
        awk '/^displacement left/ { print $4 }'
}

on_drives()
{
    [ ${#drives[@]} -eq 0 ] && return
    "$programs/rsackermann_experiment_drives" --quiet "$@" "${drives[@]}" |
        awk '/^all / { print $9, $11 } /^controls / { print $5, $8 }' | xargs
}

# Prints the values of all tables in which a room counts: its name and the value in each line.
measure()
{
    case $1 in
        calibration/* | optim/hac* | sequence/* | features/frame* | features/point* | factors/flow*)
            echo "calibration,_% $("$programs/rsackermann_experiment_calibration" --drives=2 |
                awk -F'|' '/line delay/ { printf "%s ", $5 }')" ;;
    esac
    case $1 in
        calibration/* | optim/hac*) return ;;
        sequence/* | features/frame* | features/point* | factors/flow* | factors/driving* | features/upright*)
            [ ${#drives[@]} -eq 0 ] || echo "sequence $(on_drives --drive --every=3)" ;;
    esac
    case $1 in
        sequence/* | features/frame* | features/point* | factors/flow*) return ;;
    esac
    echo "street $(street --gravity_sigma=0) $(street)"
    echo "random $("$programs/rsackermann_experiment_harm" --quiet --frames=20 |
        awk '/corrected: raw/ { print $9 } /^made worse/ { print $11 }' | xargs)"
    if [ ${#drives[@]} -gt 0 ]; then
        echo "nothing $(on_drives --every=8 ${controls:+"$controls"})"
        echo "yaw_rate $(on_drives --every=8 --given=yaw_rate)"
    fi
}

echo "| file | constant | value | plain | halved | doubled |"
echo "|---|---|---|---|---|---|"
declare -A plain
while read -r file name value; do
    [[ "$file ${name#*:}" =~ $only ]] || continue
    room=${file%/*}/$(basename "$file")
    [ -n "${plain[$room]:-}" ] || plain[$room]=$(measure "$room" | paste -s -d';')
    row="| $file | ${name#*:} | $value | ${plain[$room]} |"
    for factor in 0.5 2; do
        result=$(RSACKERMANN_ABLATE="$name=$factor" measure "$room" 2>/dev/null | paste -s -d';') || result=failed
        [ "$result" != "${plain[$room]}" ] || result="the same"
        row+=" $result |"
    done
    echo "$row"
done <"$build/constants.txt"

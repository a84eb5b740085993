#!/bin/bash
# Runs the experiments of doc/results.md and prints their table in Markdown: what is reached, with the goal if there is
# one. With a folder of photographs (see rsackermann_experiment_streets --help, option --photos) their rows follow those
# of the rendered streets. Options after -- are passed on to every experiment.
# usage: run_experiments.sh BUILD_DIRECTORY [PHOTO_FOLDER] [-- OPTION...]
# Exit code: 0 all goals are reached, 1 some aren't, 2 the command line isn't understood.
set -euo pipefail

arguments=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
    arguments+=("$1")
    shift
done
if [ ${#arguments[@]} -lt 1 ] || [ ${#arguments[@]} -gt 2 ]; then
    echo "usage: $0 BUILD_DIRECTORY [PHOTO_FOLDER] [-- OPTION...]" >&2
    exit 2
fi
program=${arguments[0]}/perf/experiments/rsackermann_experiment_streets
photos=${arguments[1]:-}
common=("${@:2}")
missed=0

# usage: row TITLE GOAL OPTIONS...
# GOAL is a list of comparisons as residual<=0.12 of the values that the awk program below reads; it may be empty.
row()
{
    local title=$1 goal=$2 options
    shift 2
    options="$*"
    [ -z "$photos" ] || options=${options//"$photos"/PHOTOS}
    "$program" --quiet "$@" ${common[@]+"${common[@]}"} |
        awk -v title="$title" -v goal="$goal" -v options="${options:+\`$options\`}" '
        /^[0-9]+ cases, / { cases = $1; worse = $7 }
        /^displacement raw/ { v["raw"] = $4 }
        /^displacement left/ { v["residual"] = $4; v["p90"] = $5; v["max"] = $7 }
        /^yaw rate error/ { v["yaw_rate"] = $5 }
        /^speed error/ { v["speed"] = $4 }
        /^yaw rate  .*sigma/ { v["yaw_rate_2_sigma"] = $8; v["yaw_rate_3_sigma"] = $14 }
        /^speed  .*sigma/ { v["speed_2_sigma"] = $7; v["speed_3_sigma"] = $13 }
        END {
            v["worse_percent"] = 100 * worse / cases
            reached = "yes"
            n = split(goal, parts, " ")
            for (i = 1; i <= n; i++) {
                upper = index(parts[i], "<=") > 0
                split(parts[i], sides, /<=|>=/)
                if (!(sides[1] in v) || v[sides[1]] == "nan" ||
                    (upper ? v[sides[1]] > sides[2] + 0 : v[sides[1]] < sides[2] + 0))
                    reached = "no"
            }
            printf "| %s | %s | %d | %s | %s | %s | %d | %s | %s | %s / %s | %s | %s |\n",
                   title, options, cases, v["raw"], v["residual"], v["p90"], worse, v["yaw_rate"], v["speed"],
                   v["yaw_rate_2_sigma"], v["yaw_rate_3_sigma"], goal, n ? reached : ""
            exit reached == "no"
        }' || missed=$((missed + 1))
}

echo "| data and knowledge | options | cases | raw, px | residual, px | residual p90, px | worse than raw | yaw rate, deg/s \
| speed, km/h | yaw rate within 2 / 3 sigma, % | goal | reached |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|"
exact=--gravity_sigma=0
row "rendered" "residual<=0.12 p90<=0.35 yaw_rate<=1.5 speed<=3" $exact
row "rendered, speed ± 2 km/h" "residual<=0.08 p90<=0.20" $exact --speed_sigma=2
row "rendered, yaw rate ± 1 deg/s" "" $exact --yaw_rate_sigma=1
row "rendered, both" "" $exact --speed_sigma=2 --yaw_rate_sigma=1
row "rendered, camera tilted" "residual<=0.15" $exact --roll=4 --pitch=-6
row "rendered, half of the lines slanted" "residual<=0.25" $exact --clutter=0.5
row "rendered, at rest" "max<=0.10" $exact --rest --scenes=24
row "rendered, camera looks to the left" "" $exact --direction=90
row "rendered, camera looks to the right" "" $exact --direction=-90
for error in -30 -20 -10 10 20 30; do
    row "rendered, focal length off by $error %" "" $exact --scenes=1 --focal_error=$error
done
uneven=(--stagger=1.5 --obstacles=15 --left=5 --right=6)
row "rendered, staggered facades, cars, posts and trees" "residual<=0.20 p90<=0.45" $exact "${uneven[@]}"
row "the same, gravity off by 0.3 degrees" "residual<=0.40 worse_percent<=5" --gravity_noise=0.3 "${uneven[@]}"
row "the same, gravity off by 0.3 degrees, prior yaw rates 30 deg/s" "residual<=0.40 worse_percent<=5" \
    --gravity_noise=0.3 --usual_yaw_rate=30 "${uneven[@]}"
row "the same, gravity off by 0.3 degrees, yaw rate ± 1 deg/s" "residual<=0.20 worse_percent<=5" \
    --gravity_noise=0.3 --yaw_rate_sigma=1 "${uneven[@]}"
row "rendered, gravity uncertain" "worse_percent<=5"
row "rendered, gravity uncertain, speed ± 2 km/h" "worse_percent<=5" --speed_sigma=2
row "rendered, gravity uncertain, yaw rate ± 1 deg/s" "worse_percent<=5" --yaw_rate_sigma=1
row "rendered, gravity uncertain, both" "worse_percent<=5" --speed_sigma=2 --yaw_rate_sigma=1
row "rendered, gravity off by 1 degree" "worse_percent<=5 yaw_rate_2_sigma>=90 yaw_rate_3_sigma>=98" --gravity_noise=1
for clutter in 0.3 0.5 0.65 1; do
    row "rendered, at rest, gravity uncertain, clutter $clutter" "max<=0.10" --rest --scenes=40 --clutter=$clutter
done
if [ -n "$photos" ]; then
    row "photographs" "residual<=0.80 p90<=1.2" --photos="$photos" $exact
    row "photographs, speed ± 2 km/h" "residual<=0.25 p90<=0.60" --photos="$photos" $exact --speed_sigma=2 --draws=10
    row "photographs, yaw rate ± 1 deg/s" "residual<=0.25 p90<=0.50" --photos="$photos" $exact --yaw_rate_sigma=1 --draws=10
    row "photographs, both" "residual<=0.10 p90<=0.50" \
        --photos="$photos" $exact --speed_sigma=2 --yaw_rate_sigma=1 --draws=10
    row "photographs, both and vanishing point, given without errors" "" \
        --photos="$photos" $exact --speed_sigma=2 --yaw_rate_sigma=1 --wall_direction_sigma=0.02 --exact_priors
    row "photographs, at rest" "max<=0.10" --photos="$photos" $exact --rest
    row "photographs, gravity ± 0.2 degrees" "residual<=0.65 p90<=1.2" --photos="$photos" --gravity_sigma=0.2
    row "photographs, gravity ± 0.2 degrees, prior yaw rates 30 deg/s" "residual<=0.65 p90<=1.2" \
        --photos="$photos" --gravity_sigma=0.2 --usual_yaw_rate=30
    row "photographs, gravity uncertain" "" --photos="$photos"
    row "photographs, gravity uncertain, both" "" --photos="$photos" --speed_sigma=2 --yaw_rate_sigma=1
fi
[ "$missed" = 0 ] || { echo "$missed goals aren't reached" >&2; exit 1; }

#!/bin/bash
# Makes the pictures of the README, of theory.md and of the tutorial; needs gnuplot and graphviz. (Those of the results are made by perf/experiments.)
# usage: make_images.sh BUILD_DIRECTORY, built with -DBUILD_PERF_TESTS=ON
set -euo pipefail

[ $# -eq 1 ] || { echo "usage: $0 BUILD_DIRECTORY" >&2; exit 2; }
programs=$1/samples
images=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# README: a street as a rolling shutter with a read-out of 33 ms sees it at 70 km/h and 60 deg/s, the corrected image and the segments.
street=$work/street
"$programs/rsackermann_simulate" --output="$street" --size=640x380 --focal=560 --readout=0.033 --speed=70 --yaw_rate=60 --seed=3
correct=("$programs/rsackermann_correct" "$street/rolling.png" "--camera=$street/camera.yml" --gravity_sigma=0 --overwrite)
"${correct[@]}" --model=none --output="$images/street_raw.jpg" # no motion: the image as it is
"${correct[@]}" --wall=2.5 --output="$images/street_corrected.jpg" --overlay="$images/street_segments.jpg"

# theory.md: sketches.
gnuplot -c "$images/top_view.gp" "$images/top_view.png"
gnuplot -c "$images/row_times.gp" "$images/row_times.png"
dot -Tsvg "$images/data_flow.dot" -o "$images/data_flow.svg"

# theory.md: roll and yaw rate.
"$1/perf/experiments/rsackermann_roll_valley" > "$work/valley.txt"
gnuplot -c "$images/roll_valley.gp" "$work/valley.txt" "$images/roll_valley.png"

# theory.md and the tutorial: a street with parked cars whose houses aren't in line.
uneven=$work/uneven
"$programs/rsackermann_simulate" --output="$uneven" --size=640x400 --focal=560 --readout=0.033 --speed=60 --yaw_rate=50 --left=5 --right=6 \
    --stagger=1.5 --obstacles=20 --seed=4 --noise=0
"$programs/rsackermann_correct" "$uneven/rolling.png" --camera="$uneven/camera.yml" --gravity_sigma=0 --wall=5 --maps="$uneven/maps.yml" \
    --report="$uneven/report.jsonl" --output="$uneven/corrected.png" --overlay="$uneven/overlay.png"
"$programs/rsackermann_evaluate" --truth="$uneven/truth.json" --maps="$uneven/maps.yml" --report="$uneven/report.jsonl"
gnuplot -c "$images/uneven_street.gp" "$uneven" "$images/../../modules/rsackermann/tutorials/correct_frame/images"

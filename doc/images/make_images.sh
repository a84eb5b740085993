#!/bin/bash
# Makes the pictures of the README, of theory.md and of the tutorials; needs gnuplot, graphviz and OpenCV's package for
# Python. (Those of the results are made by perf/experiments.)
# usage: make_images.sh BUILD_DIRECTORY, built with -DBUILD_PERF_TESTS=ON
set -euo pipefail

[ $# -eq 1 ] || { echo "usage: $0 BUILD_DIRECTORY" >&2; exit 2; }
programs=$1/samples
images=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# README: a street as a rolling shutter with a read-out of 33 ms sees it at 70 km/h and 60 deg/s, the corrected image
# and the segments.
street=$work/street
"$programs/rsackermann_simulate" --output="$street" --size=640x380 --focal=560 --readout=0.033 --speed=70 \
    --yaw_rate=60 --seed=3
correct=("$programs/rsackermann_correct" "$street/rolling.png" "--camera=$street/camera.yml" --gravity_sigma=0
         --overwrite)
"${correct[@]}" --model=none --output="$images/street_raw.jpg" # no motion: the image as it is
"${correct[@]}" --wall=2.5 --output="$images/street_corrected.jpg" --overlay="$images/street_segments.jpg"

# theory.md: sketches.
gnuplot -c "$images/top_view.gp" "$images/top_view.png"
gnuplot -c "$images/row_times.gp" "$images/row_times.png"
dot -Tsvg "$images/data_flow.dot" -o "$images/data_flow.svg"

# theory.md: roll and yaw rate.
"$1/perf/experiments/rsackermann_roll_valley" > "$work/valley.txt"
gnuplot -c "$images/roll_valley.gp" "$work/valley.txt" "$images/roll_valley.png"

# results.md and the tutorial: a street with parked cars whose houses aren't in line.
uneven=$work/uneven
"$programs/rsackermann_simulate" --output="$uneven" --size=640x400 --focal=560 --readout=0.033 --speed=60 \
    --yaw_rate=50 --left=5 --right=6 --stagger=1.5 --obstacles=20 --seed=4 --noise=0
"$programs/rsackermann_correct" "$uneven/rolling.png" --camera="$uneven/camera.yml" --gravity_sigma=0 --wall=5 \
    --maps="$uneven/maps.yml" --report="$uneven/report.jsonl" --output="$uneven/corrected.png" \
    --overlay="$uneven/overlay.png"
"$programs/rsackermann_evaluate" --truth="$uneven/truth.json" --maps="$uneven/maps.yml" --report="$uneven/report.jsonl"
gnuplot -c "$images/uneven_street.gp" "$uneven" "$images/../../modules/rsackermann/tutorials/correct_frame/images"

# The tutorial on lidars: a camera that looks to the side.
lidar=$work/lidar
"$programs/rsackermann_simulate" --output="$lidar" --size=640x400 --focal=400 --readout=0.033 --speed=40 --yaw_rate=10 \
    --heading=70 --left=7 --right=8 --stagger=1.5 --obstacles=20 --seed=5 --depth
"$images/lidar_points.py" "$lidar"
"$programs/rsackermann_correct" "$lidar/rolling.png" --camera="$lidar/camera.yml" --speed=40 --yaw_rate=10 \
    --report="$lidar/report.jsonl"
"$programs/rsackermann_export" --report="$lidar/report.jsonl" --camera="$lidar/camera.yml" --points="$lidar/cloud.csv" \
    --points_output="$lidar/places.csv"
"$images/lidar_points.py" "$lidar" --errors
gnuplot -c "$images/lidar_points.gp" "$lidar" \
    "$images/../../modules/rsackermann/tutorials/lidar_points/images/lidar_points.jpg"

# The tutorial on one's own camera: streets with unknown roll, with a read-out of 25 ms, at 50 km/h and 15 deg/s.
tilted=$work/tilted
for roll in -2 -1 -0.5 0 0.5 1 2; do
    for seed in 1 2 3 4 5; do
        "$programs/rsackermann_simulate" --output="$tilted" --overwrite --size=640x400 --focal=560 --readout=0.025 \
            --speed=50 --yaw_rate=15 --left=6 --right=7 --stagger=1 --seed=$seed --roll=$roll
        line=$roll
        for given in --gravity_sigma=0 --gravity_sigma=1 --yaw_rate=15; do
            "$programs/rsackermann_correct" "$tilted/rolling.png" --camera="$tilted/camera.yml" --roll=0 $given \
                --overwrite --maps="$tilted/maps.yml" --report="$tilted/report.jsonl"
            displacement=$(
                "$programs/rsackermann_evaluate" --truth="$tilted/truth.json" --maps="$tilted/maps.yml" \
                    --report="$tilted/report.jsonl" |
                    awk -v before="$([ "$line" = "$roll" ] && echo 1)" \
                        '/^mean displacement/ { print before ? $4 " " $5 : $5 }'
            )
            line="$line $displacement"
        done
        echo "$line"
    done
done >"$work/gravity.txt"
gnuplot -c "$images/gravity_error.gp" "$work/gravity.txt" \
    "$images/../../modules/rsackermann/tutorials/your_camera/images/gravity_error.png"

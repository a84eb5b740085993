#!/bin/bash
# Makes the pictures of the README: a street as a rolling shutter with a read-out of 33 ms sees it at 70 km/h and 60 deg/s, the
# corrected image and the segments.
# usage: make_images.sh BUILD_DIRECTORY
set -euo pipefail

[ $# -eq 1 ] || { echo "usage: $0 BUILD_DIRECTORY" >&2; exit 2; }
programs=$1/samples
images=$(dirname "$0")
street=$(mktemp -d)
trap 'rm -rf "$street"' EXIT

"$programs/rsackermann_simulate" --output="$street" --size=640x380 --focal=560 --readout=0.033 --speed=70 --yaw_rate=60 --seed=3
correct=("$programs/rsackermann_correct" "$street/rolling.png" "--camera=$street/camera.yml" --gravity_sigma=0 --overwrite)
"${correct[@]}" --model=none --output="$images/street_raw.jpg" # no motion: the image as it is
"${correct[@]}" --wall=2.5 --output="$images/street_corrected.jpg" --overlay="$images/street_segments.jpg"

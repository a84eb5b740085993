#!/bin/bash
# Renders a street as a car's rolling-shutter camera sees it, corrects the image and compares the result with the truth:
# a camera of 640x380 pixels and a focal length of 816 pixels, 1.2 m above the road, walls at 2.5 m and 3 m, 30 frames a
# second with a read-out of 40 %, 60 km/h and 40 deg/s. The rendered camera is exactly upright.
# usage: demo.sh BUILD_DIRECTORY [OUTPUT_DIRECTORY]
set -euo pipefail

if [ $# -lt 1 ] || [ $# -gt 2 ]; then
    echo "usage: $0 BUILD_DIRECTORY [OUTPUT_DIRECTORY]" >&2
    exit 2
fi
programs=$1/samples
out=${2:-$1/demo}

"$programs/rsackermann_simulate" --output="$out" --overwrite --size=640x380 --focal=816 --height=1.2 --left=2.5 \
    --right=3 --readout=0.0133333 --speed=60 --yaw_rate=40 --seed=3
"$programs/rsackermann_correct" "$out/rolling.png" --camera="$out/camera.yml" --wall=2.5 --gravity_sigma=0 --overwrite \
    --output="$out/corrected.png" --overlay="$out/overlay.png" --maps="$out/maps.yml" --report="$out/report.jsonl"
"$programs/rsackermann_evaluate" --truth="$out/truth.json" --maps="$out/maps.yml" --report="$out/report.jsonl"
echo
echo "Pictures in $out: rolling.png (before), corrected.png (after), global.png (truth), overlay.png (segments)"

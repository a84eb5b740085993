#!/bin/bash
# Plots the residual displacement on a rendered street against the error of the given focal length.
# usage: plot_focal_error.sh BUILD_DIRECTORY PICTURE.png
set -euo pipefail

[ $# -eq 2 ] || { echo "usage: $0 BUILD_DIRECTORY PICTURE.png" >&2; exit 2; }
program=$1/perf/experiments/rsackermann_experiment_streets
data=$(mktemp)
trap 'rm -f "$data"' EXIT

for error in -30 -20 -10 -5 0 5 10 20 30; do
    "$program" --quiet --gravity_sigma=0 --scenes=1 --focal_error=$error | awk -v error=$error '
        /^displacement raw/ { raw = $4 }
        /^displacement left/ { print error, raw, $4, $5 }' | tee -a "$data"
done
gnuplot <<GNUPLOT
set terminal pngcairo size 640,400 font "sans,11"
set output "$2"
set xlabel "error of the focal length, %"
set ylabel "mean displacement, px"
set yrange [0:*]
set grid
set key center right
plot "$data" using 1:2 with lines dashtype 2 linecolor rgb "black" title "raw image, median", \
     "$data" using 1:4 with linespoints pointtype 6 linecolor rgb "#d95f02" title "residual, 90 % quantile", \
     "$data" using 1:3 with linespoints pointtype 7 linecolor rgb "#1b9e77" title "residual, median"
GNUPLOT

# Draws the residual displacement over an error of the roll, for the tutorial on one's own camera.
# usage: gnuplot -c gravity_error.gp DATA PICTURE
# DATA has lines of roll, displacement before, and after: gravity taken for exact, the default, and the yaw rate given, too.

set terminal pngcairo size 560,320 font "DejaVuSans,9"
set output ARG2
set xlabel "unknown roll, degrees"
set ylabel "mean displacement, px"
set yrange [0:*]
set grid
set key outside right top
plot ARG1 using 1:2 smooth unique with lines dashtype 2 linecolor rgb "black" title "raw", \
     ARG1 using 1:3 smooth unique with linespoints pointtype 6 linecolor rgb "#d95f02" title "taken for exact", \
     ARG1 using 1:4 smooth unique with linespoints pointtype 7 linecolor rgb "#7570b3" title "default: ± 1°", \
     ARG1 using 1:5 smooth unique with linespoints pointtype 5 linecolor rgb "#1b9e77" title "yaw rate given"

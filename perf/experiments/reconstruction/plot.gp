# usage: gnuplot -c plot.gp DATA PICTURE.png; DATA as table.py writes it
set terminal pngcairo size 900,340 font "sans,10"
set output ARG2
set multiplot layout 1,2
set bmargin 4
set yrange [0:*]
set ylabel "error of camera centres, cm"
set xrange [-0.5:3.5]
set grid ytics
unset key
do for [view in "side forward"] {
    set title view eq "side" ? "camera looks to the side" : "camera looks ahead"
    plot sprintf("%s/%s", ARG1, view) using 1:2:xtic(3) with points pointtype 7 linecolor rgb "#1b9e77"
}
unset multiplot

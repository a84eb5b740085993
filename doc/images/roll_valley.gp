# Draws the valley of roll and yaw rate that rsackermann_roll_valley computes, for doc/theory.md.
# usage: gnuplot -c roll_valley.gp DATA PICTURE.png

set terminal pngcairo size 640,420 font "sans,11"
set output ARG2

# What the program renders by default, and the slope of "Roll and yaw rate": deg/s for each degree.
yaw_rate = 20
focal = 816.
line_delay = 0.4 / 30 / 380
slope = 1 / (focal * line_delay)

set xlabel "error of the given roll, degrees"
set ylabel "given yaw rate, deg/s"
set cblabel "median misfit of an upright segment, px"
set xrange [-2.5:2.5]
set yrange [-90:90]
set logscale cb
set cbrange [0.25:4]
set cbtics ("0.25" 0.25, "0.5" 0.5, "1" 1, "2" 2, "4" 4)
set palette defined (0 "#08519c", 1 "#3182bd", 2 "#6baed6", 3 "#c6dbef", 4 "#f4f8fc")
set tics out nomirror
set arrow 1 from -1, graph 0 to -1, graph 1 nohead front dashtype 2 linecolor rgb "#606060"
set arrow 2 from 1, graph 0 to 1, graph 1 nohead front dashtype 2 linecolor rgb "#606060"
set label 1 "default: ± 1 degree" at 0, -80 center front
set arrow 3 from -1, -70 to 1, -70 heads front linecolor rgb "#606060"
set key at graph 0.02, graph 0.97 left top reverse Left opaque samplen 2
plot ARG1 using 1:2:3 with image notitle, \
     yaw_rate + slope * x with lines dashtype 2 linewidth 2 linecolor rgb "#d95f02" title sprintf("%.0f deg/s for each degree", slope), \
     "+" using (0):(yaw_rate) every ::::0 with points pointtype 7 pointsize 1.4 linecolor rgb "black" title "truth"

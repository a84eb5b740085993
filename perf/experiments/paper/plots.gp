# Draws the plots of doc/paper.md.
# usage: gnuplot -c plots.gp DATA IMAGES SPEEDS
# SPEEDS are those of the files in the folder DATA, with spaces between.

data = ARG1."/"
images = ARG2."/"
speeds = ARG3
yaw_rates = "10 40 70"
contestants = "paper ours_gravity ours"
contestant_titles = "'paper' 'ours, gravity exact' 'ours'"

SMALL = "set terminal pngcairo size 560,380 font 'sans,10'"
WIDE = "set terminal pngcairo size 800,560 font 'sans,8'"
set linetype 1 linecolor rgb "#d95f02"
set linetype 2 linecolor rgb "#1b9e77"
set linetype 3 linecolor rgb "#7570b3"
set linetype 4 linecolor rgb "#666666"
set grid
set style fill solid 0.3
SAME = "with lines dashtype 2 linecolor rgb 'black'"

# Boxes from quartile to quartile with the median as a bar, whiskers at 5 % and 95 %, means as crosses: from the files of the names after
# the prefix, each w wide and beside one another.
file(i) = data.prefix.word(names, i).".dat"
shift(i) = (i - (words(names) + 1) / 2.) * w * 1.3
BOXES = "for [i=1:words(names)] file(i) using ($1 + shift(i)):3:2:6:5:(w) with candlesticks whiskerbars 0.5 linetype i title word(titles, i), \
    for [i=1:words(names)] file(i) using ($1 + shift(i)):4:4:4:4:(w) with candlesticks linetype i linewidth 2 notitle, \
    for [i=1:words(names)] file(i) using ($1 + shift(i)):7 with points linetype i pointtype 2 pointsize 0.5 notitle"

@SMALL
set key top left
YAW = "set xlabel 'simulated yaw rate, deg/s'; set ylabel 'estimated yaw rate, deg/s'; set xrange [0:80]; set yrange [-10:90]"
SPEED = "set xlabel 'simulated speed, km/h'; set ylabel 'estimated speed, km/h'; set xrange [0:160]; set yrange [0:220]"

set output images."figure5a.png"
@YAW
prefix = "figure5a_"
names = "paper_1la ours_1la"
titles = "'paper, 1-LA' 'ours, 1-LA'"
w = 1.8
plot x @SAME title "truth", @BOXES

set output images."figure5b.png"
@SPEED
prefix = "figure5b_"
names = "paper_3la ours_3la"
titles = "'paper, 3-LA' 'ours, 3-LA'"
w = 5
plot x @SAME title "truth", @BOXES

set output images."figure5c.png"
@YAW
prefix = "figure5c_"
names = speeds
titles = speeds
w = 1
set key title "paper, 1-LA; car at, km/h"
plot x @SAME title "truth", @BOXES

set output images."figure5d.png"
@SPEED
prefix = "figure5d_"
names = yaw_rates
titles = yaw_rates
w = 3.5
set key outside right title "paper, 3-LA;\nturning at,\ndeg/s"
plot x @SAME title "truth", @BOXES
set key inside top left title ""

@WIDE
set output images."figure5e.png"
@YAW
names = contestants
titles = contestant_titles
w = 1.5
set multiplot layout 2,2
do for [speed in speeds] {
    prefix = "figure5e_".speed."_"
    set title speed." km/h"
    plot x @SAME title "truth", @BOXES
}
unset multiplot
unset title

@SMALL
set output images."figure5f.png"
@SPEED
prefix = "figure5f_"
w = 5
plot x @SAME title "truth", @BOXES

set terminal pngcairo size 560,500 font 'sans,10'
set output images."figure5g.png"
set xlabel "read-out, ms"
set ylabel "yaw rate off by, deg/s for 1 degree"
set logscale xy
set xrange [4:60]
set yrange [0.05:200]
set key outside below maxrows 7 height 1.5
# A degree over the read-out of a length of image of one focal length.
law(readout) = 360 / (816 * 520 / 640.) / (readout * 1e-3)
plot law(x) @SAME title "1 degree / (focal length x line delay)", \
    for [i=1:3] data."figure5g_roll_".word(contestants, i).".dat" with linespoints linetype i pointtype 7 title word(contestant_titles, i).", roll", \
    for [i=1:3] data."figure5g_pitch_".word(contestants, i).".dat" with linespoints linetype i dashtype 3 pointtype 6 \
        title word(contestant_titles, i).", pitch"
unset logscale
set key inside top left maxrows auto
@SMALL

set output images."figure5h.png"
set xlabel "error of the wall's distance, cm"
set ylabel "error of the speed, km/h"
set xrange [-16:16]
set yrange [-80:80]
prefix = "figure5h_"
w = 2
plot 0 @SAME notitle, @BOXES

set output images."figure7.png"
set xlabel "error of the camera's height, cm"
set ylabel "displacement left, px"
set yrange [0.01:30]
set logscale y
prefix = "figure7_"
plot @BOXES
unset logscale

set output images."figure6.png"
unset xlabel
set ylabel "displacement, px"
set xrange [-0.6:6.6]
set yrange [0.01:100]
set logscale y
set xtics ("raw" 0, "paper,\n1-LA" 1, "paper,\n3-LA" 2, "paper" 3, "ours,\ngravity exact" 4, "ours" 5, "ours, yaw\nrate known" 6)
set bmargin 3
prefix = "figure6"
names = "''"
titles = "''"
w = 0.5
unset key
plot data."figure6.dat" using 1:3:2:6:5:(w) with candlesticks whiskerbars 0.5 linetype 1, \
    "" using 1:4:4:4:4:(w) with candlesticks linetype 1 linewidth 2, "" using 1:7 with points pointtype 2 linecolor rgb "black"
unset logscale
set xtics autofreq
set bmargin -1
set key top left

set output images."solver_errors.png"
set xlabel "log10 of the relative error on exact lines"
set ylabel "problems, %"
set xrange [-16:2]
set yrange [0:*]
set boxwidth 0.4
plot for [i=1:3] data."solver_histogram_".word("4la_rolling 4la_global 4la_exact", i).".dat" with boxes linetype i \
    title word("'cubic, as in the paper' 'cubic, depth at the global-shutter point' 'exact'", i)

set output images."solver_noise.png"
set xlabel "noise of the ends of the lines, px"
set ylabel "median relative error"
set xrange [-0.05:2.05]
set yrange [1e-3:10]
set logscale y
set key bottom right
plot for [i=1:4] data."solver_noise_".word("1la 3la 4la_rolling 4la_exact", i).".dat" with linespoints linetype i pointtype 7 \
    title word("1-LA 3-LA '4-LA, cubic' '4-LA, exact'", i)
unset logscale

@WIDE
set output images."conditions.png"
set ylabel "displacement left, px"
set yrange [0.02:20]
set xrange [*:*]
set logscale y
set key top left
set multiplot layout 2,3
factors = "segments outliers readout_ms focal_error_percent width_px known"
axis = "'vertical segments' 'share of outliers' 'read-out, ms' 'error of the focal length, %' 'width of the image, px' 'known'"
do for [f=1:6] {
    factor = word(factors, f)
    set xlabel word(axis, f)
    if (factor eq "segments") { set logscale x } else { unset logscale x }
    if (factor eq "known") { set xtics ("nothing" 0, "speed" 1, "yaw rate" 2, "both" 3) } else { set xtics autofreq }
    if (factor eq "width_px") { set xtics 500 }
    plot for [i=1:3] data."condition_".factor."_".word(contestants, i).".dat" with linespoints linetype i pointtype 7 pointsize 0.7 \
        title word(contestant_titles, i)
    unset key
}
unset multiplot
unset logscale
set xtics autofreq

@SMALL
set output images."bound.png"
set key bottom right
set xlabel "root mean square error over the Cramer-Rao bound"
set ylabel "share of the motions"
set xrange [0:4]
set yrange [0:1]
set arrow from 1.3,0 to 1.3,1 nohead dashtype 2
plot for [i=1:2] data."bound_yaw_rate_".word(contestants, i).".dat" with steps linetype i linewidth 2 title word(contestant_titles, i).", yaw rate", \
    for [i=1:2] data."bound_speed_".word(contestants, i).".dat" with steps linetype i dashtype 3 linewidth 2 title word(contestant_titles, i).", speed"

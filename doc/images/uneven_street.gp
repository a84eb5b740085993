# Draws a street before and after the correction, and what the overlay says, for doc/theory.md and the tutorial.
# usage: gnuplot -c uneven_street.gp FOLDER IMAGES
# FOLDER has rolling.png, corrected.png and overlay.png of 640 x 400 pixels, of which the road in front isn't shown.

folder = ARG1."/"
images = ARG2."/"
unset border
unset tics
unset key
set yrange [100:399]

set xrange [0:319]
set terminal jpeg size 644,318 font "DejaVuSans,9"
set output images."uneven_street.jpg"
set multiplot layout 1, 2 margins 0.005, 0.995, 0.008, 0.926 spacing 0.01
# The left half; the same columns in both, to compare edges with.
array column[3] = [71, 181, 252]
do for [i = 1:3] { set arrow i from column[i], 100 to column[i], 399 nohead front dashtype 2 linecolor rgb "#ffffff" }
set title "raw" offset 0, -0.6
plot folder."rolling.png" binary filetype=png with rgbimage
set title "corrected"
plot folder."corrected.png" binary filetype=png with rgbimage
unset multiplot

# The overlay with its legend below.
set terminal jpeg size 500,268 font "DejaVuSans,9"
set output images."uneven_street_segments.jpg"
unset title
do for [i = 1:3] { unset arrow i }
set margins 0, 0, 0, 0
set xrange [0:639]
set yrange [56:399]
array colour[4] = ["#ff0000", "#000000", "#0000ff", "#00ff00"]
array meaning[4] = ["agrees with the motion, far", "disagrees", "agrees, near", "edge of road and plane of a wall"]
do for [i = 1:4] {
    x = i % 2 == 1 ? 20 : 300
    y = i <= 2 ? 86 : 67
    set arrow i from x, y to x + 30, y nohead front linewidth 4 linecolor rgb colour[i]
    set label i meaning[i] at x + 38, y front
}
set object 1 rectangle from 0, 56 to 639, 98 front fillcolor rgb "white" fillstyle solid noborder
plot folder."overlay.png" binary filetype=png with rgbimage

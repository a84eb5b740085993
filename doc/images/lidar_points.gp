# Draws points and a box in a raw image, for the tutorial on lidars.
# usage: gnuplot -c lidar_points.gp FOLDER PICTURE.jpg
# FOLDER has rolling.png of 640 x 400 pixels, of which a part is shown, and places.csv.

folder = ARG1."/"
table = folder."places.csv"
unset border
unset tics
unset key
set datafile separator ","
left = 120
right = 505
top = 25
bottom = 314
set xrange [left:right]
set yrange [bottom:top]
set terminal jpeg size 700,282 font "DejaVuSans,9"
set output ARG2
set multiplot layout 1, 2 margins 0.004, 0.996, 0.008, 0.93 spacing 0.008

# Columns of the table: x, y, z, kind (1: point nearby, from 2: edge of the box), u0, v0, u, v.
do for [k = 0:1] {
    set title k == 0 ? "as a global shutter would see them" : "by the time of each row" offset 0, -0.6
    u = 5 + 2 * k
    v = 6 + 2 * k
    plot folder."rolling.png" binary filetype=png flipy with rgbimage, \
         table using ($4 == 1 ? column(u) : NaN):(column(v)) with points pointtype 7 pointsize 0.3 linecolor rgb "#ff4000", \
         for [edge = 2:13] table using ($4 == edge ? column(u) : NaN):(column(v)) with lines linewidth 2 linecolor rgb "#00e0ff"
}
unset multiplot

# Draws when the rows of an image are read, and what a vertical becomes by it, for doc/theory.md.
# usage: gnuplot -c row_times.gp PICTURE.png

set terminal pngcairo size 840,400 font "sans,10"
set output ARG1
set angles radians

# The camera of the paper, and a drive between walls.
rows = 380
reference = 189.5
focal = 816.
readout = 13.333 # ms
delay = readout / rows
unit = focal * delay / 1000     # seconds for one unit of row time
alpha = 60 * pi / 180 * unit / 2
slope = 60 / 3.6 * unit / 3     # B: 60 km/h, left and right wall at 3 m
row(t) = reference + t * focal

set yrange [rows:-10]
set ytics ("0" 0, "100" 100, "200" 200, "300" 300, "379" 379)
set tics nomirror out
set border 3
set multiplot layout 1, 2 margins 0.075, 0.985, 0.15, 0.9 spacing 0.09

set title "when each row is read (every 20th is shown)"
set ylabel "row of the raw image"
set xlabel "time, ms"
set xrange [-12:8.5]
set key at graph 1, graph 0.99 right top samplen 1
set arrow 1 from graph 0, first reference to graph 1, first reference nohead dashtype 3 linecolor rgb "#606060"
set label 1 "reference row, {/:Italic t} = 0" at -11.8, reference - 12 textcolor rgb "#404040"
set label 2 "{/:Italic t} = (row − reference row) / {/:Italic f_y}" at -11.8, 300
plot "+" using ((int($0) * 20 - reference) * delay):(int($0) * 20) every ::::19 with points pointtype 5 pointsize 0.8 linecolor rgb "#d95f02" \
         title "rolling shutter", \
     "+" using (0):(int($0) * 20) every ::::19 with points pointtype 7 pointsize 0.6 linecolor rgb "#1f78b4" title "global shutter"

# Column at which the row time t sees a vertical of the wall w(x) that a global shutter sees at x: "Warp" of doc/theory.md with heading 0.
tau(t) = sin(alpha * t) / alpha
wall(x) = slope * abs(x)
right_of(x, w, t) = x - tau(t) * w * sin(alpha * t)
ahead_of(x, w, t) = 1 - tau(t) * w * cos(alpha * t)
seen(x, t) = (cos(2 * alpha * t) * right_of(x, wall(x), t) - sin(2 * alpha * t) * ahead_of(x, wall(x), t)) / \
             (sin(2 * alpha * t) * right_of(x, wall(x), t) + cos(2 * alpha * t) * ahead_of(x, wall(x), t))
shift(x, t) = focal * (seen(x, t) - x)

set title "what becomes of verticals at 60 km/h and 60 deg/s"
unset ylabel
set xlabel "column in the raw image − in the corrected image, px"
set xrange [-12:14]
unset label 2
set label 1 at -11.6, reference - 12
set key at graph 1, graph 0.02 right bottom samplen 2
set parametric
set trange [-reference / focal:(rows - 1 - reference) / focal]
plot shift(-0.35, t), row(t) with lines linewidth 2 linecolor rgb "#d95f02" title "left wall, {/:Italic x} = −0.35", \
     shift(0.02, t), row(t) with lines linewidth 2 dashtype 2 linecolor rgb "#7570b3" title "far away, {/:Italic x} = 0.02", \
     shift(0.35, t), row(t) with lines linewidth 2 linecolor rgb "#1b9e77" title "right wall, {/:Italic x} = 0.35", \
     0, row(t) with lines linecolor rgb "#1f78b4" title "global shutter"
unset multiplot

# Draws the car, its camera and the walls from above, for doc/theory.md.
# usage: gnuplot -c top_view.gp PICTURE.png

set terminal pngcairo size 640,560 font "sans,11"
set output ARG1
set angles degrees
unset border
unset tics
unset key
set size ratio -1
set margins 0, 0, 0, 0
set xrange [-5.6:6.4]
set yrange [-3.4:7.1]

heading = 8.   # psi
azimuth = 20.  # kappa, of the walls
left = 3.      # distances
right = 3.6
yaw = 24.      # of the camera at the row time t
arc = 4.       # driven until then

# A place u along the walls and w to the right of the camera.
along_x(u, w) = u * sin(azimuth) + w * cos(azimuth)
along_z(u, w) = u * cos(azimuth) - w * sin(azimuth)

# Both walls as far as they are in the picture, and what is written on them.
array near[2] = [-left, right]
array far[2] = [-left - 0.45, right + 0.45]
array first[2] = [-4.6, -2.1]
array last[2] = [6.2, 7.5]
array name[2] = ["left wall", "right wall"]
do for [i = 1:2] {
    set object i polygon from along_x(first[i], near[i]), along_z(first[i], near[i]) to along_x(last[i], near[i]), along_z(last[i], near[i]) \
        to along_x(last[i], far[i]), along_z(last[i], far[i]) to along_x(first[i], far[i]), along_z(first[i], far[i]) \
        to along_x(first[i], near[i]), along_z(first[i], near[i]) fillstyle solid noborder fillcolor rgb "#d0d0d0"
    middle = (near[i] + far[i]) / 2
    set label i name[i] at along_x(1, middle), along_z(1, middle) center rotate by 90 - azimuth
}

# The distances of the walls.
set style arrow 1 heads filled size 0.18, 20 linecolor rgb "black" linewidth 1
set arrow from 0, 0 to along_x(0, -left), along_z(0, -left) arrowstyle 1
set arrow from 0, 0 to along_x(0, right), along_z(0, right) arrowstyle 1
set label "{/:Italic d}" at along_x(0.25, -1.6), along_z(0.25, -1.6) center
set label "{/:Italic d_r}" at along_x(0.28, 2.5), along_z(0.28, 2.5) center

# The car at the reference row: its camera stands 1.5 m behind its front.
car_x(u, w) = u * sin(heading) + w * cos(heading)
car_z(u, w) = u * cos(heading) - w * sin(heading)
set object 3 polygon from car_x(1.5, -0.85), car_z(1.5, -0.85) to car_x(1.5, 0.85), car_z(1.5, 0.85) to car_x(-2.7, 0.85), car_z(-2.7, 0.85) \
    to car_x(-2.7, -0.85), car_z(-2.7, -0.85) to car_x(1.5, -0.85), car_z(1.5, -0.85) \
    fillstyle solid 0.25 border linecolor rgb "#1f78b4" fillcolor rgb "#1f78b4"
set label "car" at car_x(-2.1, 0), car_z(-2.1, 0) center textcolor rgb "#1f5a88"

# Axes of the camera and the heading.
set style arrow 2 head filled size 0.2, 20 linecolor rgb "black" linewidth 1.5
set style arrow 3 head filled size 0.2, 20 linecolor rgb "#1f78b4" linewidth 2
set arrow from 0, 0 to 0, 6.3 arrowstyle 2
set arrow from 0, 0 to 1.5, 0 arrowstyle 2
set label "{/:Italic z}, optical axis" at -0.15, 6.6 center
set label "{/:Italic x}" at 1.7, 0.05
set arrow from 0, 0 to 2.6 * sin(heading), 2.6 * cos(heading) arrowstyle 3

# The angles from the optical axis: of the heading, and of the walls.
set object 4 circle at 0, 0 size 2.2 arc [90 - heading:90] nowedge fillstyle empty border linecolor rgb "#1f78b4" linewidth 1.5
set label "{/Symbol y}" at -0.12, 2.1 right textcolor rgb "#1f78b4"
wall_x = along_x(1.2, right)
wall_z = along_z(1.2, right)
set arrow from wall_x, wall_z to wall_x, wall_z + 2.3 nohead dashtype 3
set object 5 circle at wall_x, wall_z size 2 arc [90 - azimuth:90] nowedge fillstyle empty border linecolor rgb "black"
set label "{/Symbol k}" at wall_x + 0.32, wall_z + 1.6 center

# The way of the camera, a part of a circle, and the camera at the row time t.
half = yaw / 2
way_x(s) = s == 0 ? 0 : s * sin(half * s / arc) / (half * s / arc * pi / 180) * sin(heading + half * s / arc)
way_z(s) = s == 0 ? 0 : s * sin(half * s / arc) / (half * s / arc * pi / 180) * cos(heading + half * s / arc)
there_x = way_x(arc)
there_z = way_z(arc)
set arrow from there_x, there_z to there_x + 1.9 * sin(yaw), there_z + 1.9 * cos(yaw) arrowstyle 2
set arrow from there_x, there_z to there_x, there_z + 1.9 nohead dashtype 3
set object 6 circle at there_x, there_z size 1.35 arc [90 - yaw:90] nowedge fillstyle empty border linecolor rgb "black"
set label "{/Symbol q}({/:Italic t}) = 2{/Symbol a}{/:Italic t}" at there_x + 0.85, there_z + 1.45 left
set label "{/:Italic T}({/:Italic t}): camera at\nthe row time {/:Italic t}" at there_x + 0.25, there_z - 0.1 left
set label "camera\nat {/:Italic t} = 0" at car_x(-0.6, 0), car_z(-0.6, 0) center front

# A point of the left wall and its depth.
point_x = along_x(4.9, -left)
point_z = along_z(4.9, -left)
set arrow from 0, 0 to point_x, point_z nohead dashtype 2 linecolor rgb "#d95f02"
set arrow from point_x, 0 to point_x, point_z heads filled size 0.18, 20 linecolor rgb "#d95f02"
set arrow from point_x, 0 to 0, 0 nohead dashtype 3 linecolor rgb "#d95f02"
set label "depth {/:Italic s}" at point_x - 0.12, 1.75 right textcolor rgb "#b04d00"
set label "point of the scene" at point_x - 0.2, point_z + 0.1 right textcolor rgb "#b04d00"

set parametric
set trange [0:arc]
set samples 50
plot way_x(t), way_z(t) with lines linewidth 2 linecolor rgb "#1f78b4", \
     "+" using (0):(0):(0.12) every ::::0 with circles fillstyle solid linecolor rgb "black", \
     "+" using (there_x):(there_z):(0.12) every ::::0 with circles fillstyle solid linecolor rgb "#1f78b4", \
     "+" using (point_x):(point_z):(0.09) every ::::0 with circles fillstyle solid linecolor rgb "#d95f02"

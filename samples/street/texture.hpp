// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_TEXTURE_HPP
#define RSACKERMANN_SAMPLES_TEXTURE_HPP

namespace street {

//! A repeatable random number in [0, 1) for a cell of a grid.
double cellNoise(int a, int b);

//! How much of a detail of a given size is left if a pixel covers footprint metres.
double visibility(double size, double footprint);

//! Courses of bricks with light joints at u metres along a wall and v metres above the road; 0 on average.
double bricks(double u, double v, double footprint);

//! Stains of all sizes from 4 cm to a metre at a place in metres, without edges: a share of the brightness, 0 on
//! average.
double stains(double u, double v, double footprint);

} // namespace street

#endif // RSACKERMANN_SAMPLES_TEXTURE_HPP

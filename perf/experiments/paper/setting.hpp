// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_PAPER_SETTING_HPP
#define RSACKERMANN_PERF_PAPER_SETTING_HPP

#include "street_model.hpp"

namespace paper {

const double DEGREE = CV_PI / 180, KMH = 1 / 3.6;
const double READ_OUT = 0.4 / 30; //!< seconds: 40 % of the time between two frames at 30 frames/s

//! The paper's camera, with its field of view in images of 520 x 360 pixels or another width.
street::StreetCamera paperCamera(double readOut = READ_OUT, int width = 520);

//! A street with walls at 2.5 m and 3 m. Speed in km/h, yaw rate in deg/s.
street::StreetScene paperScene(double speed, double yawRate, unsigned seed);

/** Images of vertical lines on the walls, above the horizon.
@param count number of segments; fewer if the camera doesn't see them.
@param noise standard deviation of each coordinate of the ends in pixels.
@param outliers share of segments that lean by up to 14 degrees instead.
@param walls receives -1 (left) or 1 (right) for each segment.
@return N x 4 matrix CV_64F. */
cv::Mat verticalLines(const street::StreetRenderer& renderer, const street::StreetCamera& camera, int count,
                      double noise, double outliers, cv::RNG& rng, std::vector<int>& walls);

} // namespace paper

#endif // RSACKERMANN_PERF_PAPER_SETTING_HPP

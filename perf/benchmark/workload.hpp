// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_WORKLOAD_HPP
#define RSACKERMANN_PERF_WORKLOAD_HPP

#include "street_model.hpp"

namespace benchmark {

//! A car in a street at 54 km/h and 40 deg/s, with walls at 2.5 m and 3 m and a read-out of 40 % of a frame at 30
//! frames/s.
struct Drive
{
    street::StreetCamera view;
    street::StreetScene scene;
    cv::rsackermann::RollingShutterCamera camera;
    cv::rsackermann::AckermannMotion motion;

    //! @param lens coefficients of the lens.
    explicit Drive(const cv::Size& size, const std::vector<double>& lens = std::vector<double>());
};

//! The camera's image.
cv::Mat render(const Drive& drive);

/** Images of vertical lines on the walls, with noise of 0.2 px at their ends.
@param outliers share of segments that aren't, instead.
@param walls receives -1 (left) or 1 (right) for each segment.
@return N x 4 matrix CV_32F. */
cv::Mat verticalSegments(const Drive& drive, int count, double outliers, std::vector<int>& walls);

} // namespace benchmark

#endif // RSACKERMANN_PERF_WORKLOAD_HPP
